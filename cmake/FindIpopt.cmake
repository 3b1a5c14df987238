# Finds Ipopt's shared library and defines Ipopt::Ipopt. Found through pkg-config, but linked alone:
# the .pc file also names the development files of BLAS, LAPACK and MUMPS, which a program that
# calls Ipopt does not need and which may be absent.
find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_check_modules(PC_IPOPT QUIET ipopt)
endif()

find_path(Ipopt_INCLUDE_DIR IpIpoptApplication.hpp
  HINTS ${PC_IPOPT_INCLUDE_DIRS} PATH_SUFFIXES coin coin-or)
find_library(Ipopt_LIBRARY ipopt HINTS ${PC_IPOPT_LIBRARY_DIRS} ${PC_IPOPT_LIBDIR})
set(Ipopt_VERSION ${PC_IPOPT_VERSION})

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Ipopt
  REQUIRED_VARS Ipopt_LIBRARY Ipopt_INCLUDE_DIR VERSION_VAR Ipopt_VERSION)
mark_as_advanced(Ipopt_INCLUDE_DIR Ipopt_LIBRARY)

if(Ipopt_FOUND AND NOT TARGET Ipopt::Ipopt)
  add_library(Ipopt::Ipopt UNKNOWN IMPORTED)
  set_target_properties(Ipopt::Ipopt PROPERTIES
    IMPORTED_LOCATION "${Ipopt_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${Ipopt_INCLUDE_DIR}"
    INTERFACE_COMPILE_OPTIONS "${PC_IPOPT_CFLAGS_OTHER}")
endif()
