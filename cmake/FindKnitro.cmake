# Finds KNITRO's header and library, in $KNITRODIR or where compilers look, and defines
# Knitro::Knitro.
find_path(Knitro_INCLUDE_DIR knitro.h HINTS ENV KNITRODIR PATH_SUFFIXES include)
find_library(Knitro_LIBRARY NAMES knitro knitro1600 knitro1500 knitro1400 knitro1300
  HINTS ENV KNITRODIR PATH_SUFFIXES lib)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Knitro REQUIRED_VARS Knitro_LIBRARY Knitro_INCLUDE_DIR)
mark_as_advanced(Knitro_INCLUDE_DIR Knitro_LIBRARY)

if(Knitro_FOUND AND NOT TARGET Knitro::Knitro)
  add_library(Knitro::Knitro UNKNOWN IMPORTED)
  set_target_properties(Knitro::Knitro PROPERTIES
    IMPORTED_LOCATION "${Knitro_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${Knitro_INCLUDE_DIR}")
endif()
