# Runs layering_test.cmake on small trees that each break one rule, and on one that breaks none.
function(expect_outcome case file line expected)
  set(root ${SCRATCH}/${case})
  file(REMOVE_RECURSE ${root})
  file(WRITE ${root}/lib/CMakeLists.txt "tinwright/geometry/point.hpp tinwright/mesh/mesh.cpp\n")
  file(WRITE ${root}/lib/tinwright/geometry/point.hpp "#include <cmath>\n")
  file(WRITE ${root}/lib/tinwright/mesh/tin.hpp "#include \"tinwright/geometry/point.hpp\"\n")
  file(APPEND ${root}/${file} "${line}\n")
  execute_process(
    COMMAND ${CMAKE_COMMAND} -DROOT=${root} -P ${SCRIPT}
    RESULT_VARIABLE status
    ERROR_VARIABLE said
    OUTPUT_QUIET)
  if(expected STREQUAL "")
    if(NOT status EQUAL 0)
      message(SEND_ERROR "${case}: refused, but breaks no rule: ${said}")
    endif()
  elseif(status EQUAL 0 OR NOT said MATCHES "${expected}")
    message(SEND_ERROR "${case}: expected \"${expected}\", got status ${status}: ${said}")
  endif()
endfunction()

expect_outcome(clean lib/tinwright/mesh/tin.hpp "#include <vector>" "")
expect_outcome(tools_may_see_all tools/main.cpp "#include <gdal.h>" "")
expect_outcome(climb lib/tinwright/geometry/point.hpp "#include \"tinwright/mesh/tin.hpp\"" "higher rank")
expect_outcome(climb_spaced lib/tinwright/geometry/point.hpp "  # include  <tinwright/mesh/tin.hpp>" "higher rank")
expect_outcome(missing lib/tinwright/mesh/tin.hpp "#include \"tinwright/mesh/gone.hpp\"" "not there")
expect_outcome(relative lib/tinwright/mesh/tin.hpp "#include \"point.hpp\"" "does not start at tinwright/")
expect_outcome(gdal lib/tinwright/mesh/tin.hpp "#include <gdal_priv.h>" "only lib/tinwright/io and tools")
expect_outcome(oracle lib/tinwright/mesh/tin.hpp "#include <boost/rational.hpp>" "only tests may use")
expect_outcome(position lib/tinwright/mesh/triangle_mesh.hpp "#include \"tinwright/geometry/point.hpp\"" "knows no position")
expect_outcome(unranked lib/tinwright/extras/thing.hpp "#include <vector>" "has no rank")
expect_outcome(orphan lib/tinwright/mesh/orphan.cpp "#include <vector>" "in no target")
