# Build rules shared by every module: options, flags, and the functions sazare_module and sazare_test.

include(GNUInstallDirs)
include(GoogleTest)
include(CheckCXXCompilerFlag)

option(SAZARE_NATIVE "Compile for the processor of this machine (-march=native)" ON)
set(SAZARE_MPI "AUTO" CACHE STRING "Build with MPI, for runs on several ranks: ON, OFF, or AUTO where it is installed")
set(SAZARE_METIS "AUTO" CACHE STRING "Build with METIS, to distribute work over ranks by a graph: ON, OFF, or AUTO where it is installed")
option(SAZARE_TESTS "Build the C++ tests" ON)
option(SAZARE_WARNINGS_AS_ERRORS "Treat compiler warnings as errors" ON)
option(SAZARE_PRECOMPILE "Read the headers that most sources need once for all of them" ON)
set(SAZARE_SANITIZE "" CACHE STRING "Comma-separated sanitizers, such as address,undefined or thread")

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug or Release" FORCE)
endif()

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -g1 -DNDEBUG")
set(CMAKE_CXX_FLAGS_DEBUG "-O1 -g -fno-omit-frame-pointer")

# Flags that reach every source, those that change how memory is laid out (Eigen's alignment) included.
# -ffp-contract=off: a law compiled into two loops must give the same bits in both, so the compiler may not fuse
# a multiplication with an addition in one of them only. No flag here lets it reorder arithmetic.
# -fno-semantic-interposition: functions of one source may be inlined into each other although all code can be moved.
add_library(sazare_options INTERFACE)
add_library(sazare::options ALIAS sazare_options)
target_include_directories(sazare_options INTERFACE
  "${PROJECT_SOURCE_DIR}" "${PROJECT_BINARY_DIR}/generated")
target_link_libraries(sazare_options INTERFACE Eigen3::Eigen fmt::fmt OpenMP::OpenMP_CXX)
target_compile_options(sazare_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wno-psabi -ffp-contract=off -fno-math-errno -fno-semantic-interposition)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # Warnings of GCC 12 that are off because it gives them for its own headers: those of uninitialized values for vector
  # intrinsics (GCC bug 105593, on some processors only), -Wrestrict and -Wstringop-overflow for the sum of two strings (GCC bug
  # 105651).
  target_compile_options(sazare_options INTERFACE
    -Wno-uninitialized -Wno-maybe-uninitialized -Wno-restrict -Wno-stringop-overflow)
elseif(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  target_compile_options(sazare_options INTERFACE -Wno-deprecated-declarations)  # which it gives for std::stable_sort of GCC 12
endif()
if(SAZARE_WARNINGS_AS_ERRORS)
  target_compile_options(sazare_options INTERFACE -Werror)
endif()
if(SAZARE_NATIVE)
  target_compile_options(sazare_options INTERFACE -march=native)
endif()
if(SAZARE_SANITIZE)
  # With line numbers alone (-g1) a source compiles in a third of the time that it takes with everything a debugger knows.
  target_compile_options(sazare_options INTERFACE -fsanitize=${SAZARE_SANITIZE} -fno-omit-frame-pointer -g1)
  target_link_options(sazare_options INTERFACE -fsanitize=${SAZARE_SANITIZE})
  if(SAZARE_SANITIZE MATCHES "undefined")
    # What is read or written through a null pointer stops the program without a check of its own.
    target_compile_options(sazare_options INTERFACE -fno-sanitize-recover=undefined -fno-sanitize=null)
  endif()
  target_compile_definitions(sazare_options INTERFACE EIGEN_INITIALIZE_MATRICES_BY_NAN)  # what nobody has set shows in results
endif()

# The version header holds the commit, so it is brought up to date by every build and rewritten only when it changed.
add_custom_target(sazare_version
  COMMAND ${CMAKE_COMMAND}
    -DSOURCE=${PROJECT_SOURCE_DIR} -DVERSION=${PROJECT_VERSION}
    -DTEMPLATE=${PROJECT_SOURCE_DIR}/sazare/core/version.hpp.in
    -DHEADER=${PROJECT_BINARY_DIR}/generated/sazare/core/version.hpp
    -P ${CMAKE_CURRENT_LIST_DIR}/version.cmake
  BYPRODUCTS "${PROJECT_BINARY_DIR}/generated/sazare/core/version.hpp"
  COMMENT "Checking the version header"
  VERBATIM)

# Headers that most sources need are read once: half of what compiling a small source costs is reading them. What is compiled
# with them must be compiled as they were, which is why all of it gets Eigen, fmt and OpenMP by sazare::options.
set(sazare_common_headers
  <algorithm> <array> <atomic> <chrono> <cmath> <cstdint> <cstring> <filesystem> <fstream> <functional> <limits> <map> <memory>
  <mutex> <numbers> <numeric> <optional> <random> <set> <span> <sstream> <stdexcept> <string> <string_view> <thread> <utility>
  <variant> <vector> <Eigen/Core> <Eigen/Geometry> <fmt/format.h>)

# sazare_precompile(<target> HEADERS header ... [LIBRARIES target ...]): headers for targets that sazare_reuse_headers names.
function(sazare_precompile target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "HEADERS;LIBRARIES")
  if(SAZARE_PRECOMPILE)
    set(source "${PROJECT_BINARY_DIR}/generated/${target}.cpp")
    file(CONFIGURE OUTPUT "${source}" CONTENT "// Only the precompiled headers of this library are wanted.\n")
    add_library(${target} OBJECT "${source}")
    target_link_libraries(${target} PRIVATE sazare::options ${arg_LIBRARIES})
    target_precompile_headers(${target} PRIVATE ${arg_HEADERS})
  endif()
endfunction()

function(sazare_reuse_headers target from)
  if(SAZARE_PRECOMPILE)
    target_precompile_headers(${target} REUSE_FROM ${from})
  endif()
endfunction()

# sazare_by_hand(file ...): sources written in lanes by hand. Vectors of addresses, which the compiler would make besides, cost
# more than they bring. Without the common headers, whose optimization flags GCC takes for those of the source. Vectors of eight
# numbers are copied whole: GCC 12 copies 256 bits at a time unless it is told otherwise, and who reads a vector that was written
# in halves waits until both are in the cache.
check_cxx_compiler_flag("-mmove-max=512 -mstore-max=512" SAZARE_COPIES_WHOLE_VECTORS)
function(sazare_by_hand)
  set(options -fno-tree-vectorize)
  if(SAZARE_COPIES_WHOLE_VECTORS)
    list(APPEND options -mmove-max=512 -mstore-max=512)
  endif()
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "${options}" SKIP_PRECOMPILE_HEADERS ON)
endfunction()

# sazare_few_registers(file ...): after sazare_by_hand, for kernels that hold more numbers than there are registers: GCC then
# works numbers out nearer to where they are needed.
check_cxx_compiler_flag("-flive-range-shrinkage" SAZARE_SHRINKS_RANGES)
function(sazare_few_registers)
  if(SAZARE_SHRINKS_RANGES)
    set_property(SOURCE ${ARGN} APPEND PROPERTY COMPILE_OPTIONS -flive-range-shrinkage)
  endif()
endfunction()

# The name of a module's library: levels/terms -> terms, methods/blocks -> blocks, methods/blocks/run -> blocks_run.
function(sazare_module_name module result)
  string(REGEX REPLACE "^(methods|levels)/" "" name "${module}")
  string(REPLACE "/" "_" name "${name}")
  set(${result} "${name}" PARENT_SCOPE)
endfunction()

# Sets `result` to those of `modules` that have no target; empty when all are there.
function(sazare_missing_modules modules result)
  set(missing "")
  foreach(module IN LISTS modules)
    sazare_module_name("${module}" name)
    if(NOT TARGET sazare::${name})
      list(APPEND missing "${module}")
    endif()
  endforeach()
  set(${result} "${missing}" PARENT_SCOPE)
endfunction()

# sazare_module(<module> [SOURCES file ...] [DEPENDS module ...] [LIBRARIES target ...])
# A static library sazare_<module>, alias sazare::<module>; without SOURCES an interface (header-only) library.
function(sazare_module module)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;DEPENDS;LIBRARIES")
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "sazare_module(${module}): unknown arguments ${arg_UNPARSED_ARGUMENTS}")
  endif()
  sazare_missing_modules("${arg_DEPENDS}" missing)
  if(missing)
    message(FATAL_ERROR "module ${module} needs ${missing}, which is not there; modules stand in order in sazare/CMakeLists.txt")
  endif()
  sazare_module_name("${module}" name)
  set(target sazare_${name})
  if(arg_SOURCES)
    add_library(${target} STATIC ${arg_SOURCES})
    sazare_reuse_headers(${target} sazare_headers)
    set(scope PUBLIC)
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(sazare::${name} ALIAS ${target})
  add_dependencies(${target} sazare_version)
  target_link_libraries(${target} ${scope} sazare::options ${arg_LIBRARIES})
  foreach(depends IN LISTS arg_DEPENDS)
    sazare_module_name("${depends}" depends_name)
    target_link_libraries(${target} ${scope} sazare::${depends_name})
  endforeach()
endfunction()

# How long a test may take [s]; what sanitizers watch takes many times as long.
set(SAZARE_TEST_SECONDS 1800)
if(SAZARE_SANITIZE)
  set(SAZARE_TEST_SECONDS 7200)
endif()

# sazare_test(<name> SOURCES file ... DEPENDS module ... [LIBRARIES target ...])
# One GoogleTest program <name>_test; each of its tests is a test of ctest, run in the source folder's root.
# Idle threads wait passively: several tests run at a time, and threads that spin would take the others' cores.
function(sazare_test module)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;DEPENDS;LIBRARIES")
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "sazare_test(${module}): unknown arguments ${arg_UNPARSED_ARGUMENTS}")
  endif()
  sazare_missing_modules("${arg_DEPENDS}" missing)
  if(missing)
    message(FATAL_ERROR "test ${module} needs ${missing}, which is not there; modules stand in order in sazare/CMakeLists.txt")
  endif()
  sazare_module_name("${module}" name)
  set(target ${name}_test)
  add_executable(${target} ${arg_SOURCES})
  sazare_reuse_headers(${target} sazare_test_headers)
  target_link_libraries(${target} PRIVATE sazare_test_options ${arg_LIBRARIES})
  foreach(depends IN LISTS arg_DEPENDS)
    sazare_module_name("${depends}" depends_name)
    target_link_libraries(${target} PRIVATE sazare::${depends_name})
  endforeach()
  gtest_discover_tests(${target}
    TEST_PREFIX "${name}."
    WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}"
    DISCOVERY_MODE PRE_TEST
    PROPERTIES TIMEOUT ${SAZARE_TEST_SECONDS} ENVIRONMENT OMP_WAIT_POLICY=passive)
endfunction()
