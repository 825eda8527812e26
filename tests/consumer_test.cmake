# Installs the build into a scratch prefix, then configures, builds and runs a project that knows only the prefix.
function(run what)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${what} failed (${status}):\n${out}")
  endif()
  set(out "${out}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${SCRATCH})
run("installing" ${CMAKE_COMMAND} --install ${BUILD} --config ${CONFIG} --prefix ${SCRATCH}/prefix)

# The package must work wherever it is moved to.
file(GLOB configs ${SCRATCH}/prefix/lib*/cmake/tinwright/*.cmake ${SCRATCH}/prefix/lib*/*/cmake/tinwright/*.cmake)
if(NOT configs)
  message(FATAL_ERROR "no package config was installed")
endif()
foreach(config IN LISTS configs)
  file(READ ${config} text)
  string(FIND "${text}" "${BUILD}" found)
  if(NOT found EQUAL -1)
    message(FATAL_ERROR "${config} mentions the build folder")
  endif()
endforeach()

foreach(component core io)
  set(folder ${SCRATCH}/${component})
  run("configuring with component ${component}"
      ${CMAKE_COMMAND} -S ${CONSUMER}/${component} -B ${folder} -G ${GENERATOR} -DCMAKE_BUILD_TYPE=${CONFIG}
      -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_FLAGS=${FLAGS} -DCMAKE_PREFIX_PATH=${SCRATCH}/prefix
      -DTINWRIGHT_EXPECTED_VERSION=${VERSION})
  run("building with component ${component}" ${CMAKE_COMMAND} --build ${folder} --config ${CONFIG})
  run("running with component ${component}" ${folder}/consumer)
  message(STATUS "${component}: ${out}")
endforeach()
