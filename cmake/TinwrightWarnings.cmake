# Warnings of our own targets only: never part of what a consumer inherits.
function(tinwright_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor -Wold-style-cast
                                           -Woverloaded-virtual -Wnull-dereference -Wimplicit-fallthrough)
  if(TINWRIGHT_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
    # GCC 12 sees null pointers in system headers that it has inlined (strings, CLI11), depending on the level of
    # optimisation: still told, but no error. Clang's is one.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-error=null-dereference>)
  endif()
endfunction()
