# Finds GeographicLib and makes the target GeographicLib::GeographicLib: by its own package config where there is one,
# which Debian's package lacks, else by its header and library.
find_package(GeographicLib ${GeographicLib_FIND_VERSION} CONFIG QUIET)

if(NOT TARGET GeographicLib::GeographicLib)
  find_path(GeographicLib_INCLUDE_DIR GeographicLib/Config.h)
  find_library(GeographicLib_LIBRARY GeographicLib)
  if(GeographicLib_INCLUDE_DIR)
    file(STRINGS ${GeographicLib_INCLUDE_DIR}/GeographicLib/Config.h version
         REGEX "define GEOGRAPHICLIB_VERSION_STRING")
    string(REGEX REPLACE ".*\"(.*)\".*" "\\1" GeographicLib_VERSION "${version}")
  endif()
  mark_as_advanced(GeographicLib_INCLUDE_DIR GeographicLib_LIBRARY)
endif()

include(FindPackageHandleStandardArgs)
if(TARGET GeographicLib::GeographicLib)
  set(GeographicLib_FOUND TRUE)
else()
  find_package_handle_standard_args(
    GeographicLib
    REQUIRED_VARS GeographicLib_LIBRARY GeographicLib_INCLUDE_DIR
    VERSION_VAR GeographicLib_VERSION)
  if(GeographicLib_FOUND)
    add_library(GeographicLib::GeographicLib UNKNOWN IMPORTED)
    set_target_properties(
      GeographicLib::GeographicLib PROPERTIES IMPORTED_LOCATION ${GeographicLib_LIBRARY}
                                              INTERFACE_INCLUDE_DIRECTORIES ${GeographicLib_INCLUDE_DIR})
  endif()
endif()
