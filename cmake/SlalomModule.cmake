# The module structure: one static library a folder of src/, all of them gathered into the one
# library that is installed.

# -Wrestrict of g++ 12 warns falsely of std::string's own code.
set(SLALOM_WARNINGS -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  list(APPEND SLALOM_WARNINGS -Wno-restrict)
endif()

# Half of a build is reading headers, so sources are compiled in batches (tools/batches.py says which
# go together). Without Python, or with SLALOM_BATCHES off, each is compiled alone.
find_package(Python3 QUIET COMPONENTS Interpreter)
option(SLALOM_BATCHES "Compile sources in batches" ${Python3_Interpreter_FOUND})

# slalom_batches(TARGET): puts the target's sources into batches.
function(slalom_batches target)
  if(NOT SLALOM_BATCHES)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "\\.cpp$")
  execute_process(COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/tools/batches.py ${sources}
    WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}
    OUTPUT_VARIABLE lines OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # To g++ a source in a batch is a header, of which it would warn for having an unnamed namespace.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  string(REPLACE "\n" ";" batches "${lines}")
  foreach(batch IN LISTS batches)
    string(REPLACE "|" ";" files "${batch}")
    list(LENGTH files count)
    if(count GREATER 1)
      list(GET files 0 first)
      string(REPLACE ${PROJECT_SOURCE_DIR}/ "" name ${first})
      string(MAKE_C_IDENTIFIER ${name} name)
      set_source_files_properties(${files} PROPERTIES UNITY_GROUP ${name})
    endif()
  endforeach()
endfunction()

# What most sources include is read once a build, not once a batch. `make tidy` looks at sources
# without it, so that one that forgets an include is found.
option(SLALOM_PRECOMPILE "Precompile the headers of libraries" ON)
set(SLALOM_PRECOMPILED <algorithm> <array> <cmath> <filesystem> <functional> <limits> <map> <memory>
    <numbers> <numeric> <optional> <set> <span> <string> <utility> <vector> <fmt/format.h>)

# slalom_precompile(TARGET OWNER [HEADER...]): the target takes the precompiled headers of OWNER, which
# was compiled with the same options; OWNER itself makes them, of HEADERs besides the usual ones.
function(slalom_precompile target owner)
  if(NOT SLALOM_PRECOMPILE)
    return()
  endif()
  if(target STREQUAL owner)
    target_precompile_headers(${target} PRIVATE ${SLALOM_PRECOMPILED} ${ARGN})
  else()
    target_precompile_headers(${target} REUSE_FROM ${owner})
  endif()
endfunction()

# What runs once a drive or a command, not once an iteration: optimised less, for it compiles in half
# the time.
set(SLALOM_SELDOM_RUN $<$<CONFIG:Release>:-O1>)

# slalom_module(NAME [SELDOM_RUN] DEPENDS ...): a static library of the .cpp files under src/NAME. Each
# may link only modules above it; tools/check_layers.py holds the includes to the same order.
# A folder without sources becomes an interface library.
#
# Files named *_avx2.cpp are compiled for AVX2 with FMA, *_avx512.cpp for AVX-512 too, all others for the
# baseline processor.
# Files named knitro*.cpp are left out when SLALOM_WITH_KNITRO is off.
function(slalom_module name)
  cmake_parse_arguments(ARG "SELDOM_RUN" "" "DEPENDS" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${name}/*.cpp)
  if(NOT SLALOM_WITH_KNITRO)
    list(FILTER sources EXCLUDE REGEX "/knitro[^/]*\\.cpp$")
  endif()
  if(sources)
    add_library(slalom_${name} STATIC ${sources})
    target_compile_options(slalom_${name} PRIVATE ${SLALOM_WARNINGS})
    set(scope PUBLIC)
    set(avx2 -mavx2 -mfma)
    set(avx512 ${avx2} -mavx512f -mavx512dq -mavx512vl)
    foreach(set avx2 avx512)
      set(kernels ${sources})
      list(FILTER kernels INCLUDE REGEX "_${set}\\.cpp$")
      if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
        set_source_files_properties(${kernels} PROPERTIES COMPILE_OPTIONS "${${set}}")
      endif()
      set_source_files_properties(${kernels} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
    endforeach()
    if(ARG_SELDOM_RUN)
      target_compile_options(slalom_${name} PRIVATE ${SLALOM_SELDOM_RUN})
    endif()
    slalom_batches(slalom_${name})
    slalom_precompile(slalom_${name} slalom_base)
    set_property(GLOBAL APPEND PROPERTY SLALOM_MODULES_WITH_SOURCES ${name})
  else()
    add_library(slalom_${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  set_property(GLOBAL APPEND PROPERTY SLALOM_MODULES ${name})
  target_include_directories(slalom_${name} ${scope} ${PROJECT_SOURCE_DIR}/include)
  target_link_libraries(slalom_${name} ${scope} ${ARG_DEPENDS})
endfunction()

# slalom_module_definitions(NAME DEFINITION...): private definitions of a module, none while the
# module has no sources.
function(slalom_module_definitions name)
  get_target_property(type slalom_${name} TYPE)
  if(NOT type STREQUAL "INTERFACE_LIBRARY")
    target_compile_definitions(slalom_${name} PRIVATE ${ARGN})
  endif()
endfunction()

# slalom_library(DEPENDS ...): the target slalom (slalom::slalom), all modules' objects in one
# static library. DEPENDS are what the objects need at link time; public headers need none of it.
function(slalom_library)
  cmake_parse_arguments(ARG "" "" "DEPENDS" ${ARGN})
  get_property(modules GLOBAL PROPERTY SLALOM_MODULES_WITH_SOURCES)
  set(objects)
  foreach(module IN LISTS modules)
    list(APPEND objects $<TARGET_OBJECTS:slalom_${module}>)
  endforeach()
  add_library(slalom STATIC ${objects})
  add_library(slalom::slalom ALIAS slalom)
  set_target_properties(slalom PROPERTIES LINKER_LANGUAGE CXX)
  target_compile_features(slalom INTERFACE cxx_std_20)
  target_include_directories(slalom INTERFACE
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>)
  target_link_libraries(slalom PRIVATE ${ARG_DEPENDS})
endfunction()

# slalom_test_module(NAME [LIBRARIES ...]): GoogleTest programs of tests/NAME.
#   *_test.cpp       test_NAME, label `unit`: run with sanitizers too
#   *_slow_test.cpp  test_NAME_slow, label `slow`: whole drives and the like, run in Release only
#   */*.cpp          a library for both, such as a collection of problems
# LIBRARIES are what these need besides the module itself.
function(slalom_test_module name)
  cmake_parse_arguments(ARG "" "" "LIBRARIES" ${ARGN})
  set(libraries slalom_${name} ${ARG_LIBRARIES})
  file(GLOB support CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tests/${name}/*/*.cpp)
  if(support)
    add_library(test_${name}_support STATIC EXCLUDE_FROM_ALL ${support})
    target_compile_options(test_${name}_support PRIVATE ${SLALOM_WARNINGS} ${SLALOM_SELDOM_RUN})
    slalom_batches(test_${name}_support)
    target_include_directories(test_${name}_support PRIVATE ${PROJECT_SOURCE_DIR}/tests)
    target_link_libraries(test_${name}_support PUBLIC ${libraries})
    list(PREPEND libraries test_${name}_support)
  endif()
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tests/${name}/*_test.cpp)
  set(slow_sources ${sources})
  list(FILTER slow_sources INCLUDE REGEX "_slow_test\\.cpp$")
  list(FILTER sources EXCLUDE REGEX "_slow_test\\.cpp$")
  slalom_test_program(test_${name} "${libraries}" unit ${sources})
  slalom_test_program(test_${name}_slow "${libraries}" slow ${slow_sources})
endfunction()

# slalom_sanitizer_defaults(TARGET): what the address sanitizer does in a program unless a user's
# ASAN_OPTIONS say otherwise; after slalom_batches().
function(slalom_sanitizer_defaults target)
  if(SLALOM_SANITIZE AND NOT SLALOM_SANITIZE MATCHES "^(thread|fuzzer)$")
    target_sources(${target} PRIVATE ${PROJECT_SOURCE_DIR}/tests/support/sanitizer_defaults.cpp)
  endif()
endfunction()

function(slalom_test_program target libraries label)
  if(NOT ARGN)
    return()
  endif()
  add_executable(${target} EXCLUDE_FROM_ALL ${ARGN})
  slalom_batches(${target})
  slalom_sanitizer_defaults(${target})
  target_link_libraries(${target} PRIVATE ${libraries} GTest::gtest GTest::gtest_main)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(${target} PRIVATE SLALOM_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_compile_options(${target} PRIVATE ${SLALOM_SELDOM_RUN})
  slalom_precompile(${target} test_support <gtest/gtest.h>)
  add_dependencies(${label}_tests ${target})
  if(SLALOM_SANITIZE)
    # In halves, for with sanitizers the start of a program takes longer than most tests, and one
    # whole program longer than several others.
    foreach(half 0 1)
      add_test(NAME ${target}_${half} COMMAND ${target} --gtest_brief=1)
      set_tests_properties(${target}_${half} PROPERTIES LABELS ${label} TIMEOUT 1800
        ENVIRONMENT "GTEST_TOTAL_SHARDS=2;GTEST_SHARD_INDEX=${half}")
    endforeach()
    return()
  endif()
  # Listed when ctest runs, so that a build of the unit tests alone needs no slow test.
  gtest_discover_tests(${target} DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60
    PROPERTIES LABELS ${label} TIMEOUT 600)
endfunction()
