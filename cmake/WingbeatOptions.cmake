# Language, optimisation and warning settings shared by every target.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

option(WINGBEAT_TESTS "Build the tests" ON)
option(WINGBEAT_BENCHMARKS "Build the benchmarks" ON)
option(WINGBEAT_WERROR "Treat warnings as errors" OFF)
set(WINGBEAT_ARCH "native" CACHE STRING "Value of -march: the building machine unless set")

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
endif()

add_library(wingbeat_options INTERFACE)
target_include_directories(wingbeat_options INTERFACE ${CMAKE_SOURCE_DIR})
# Finite-math stays off: NaN checks must survive optimisation.
target_compile_options(wingbeat_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  # GCC 12 reports its own AVX-512 headers as uninitialised.
  -Wno-uninitialized -Wno-maybe-uninitialized
  -fno-math-errno -fno-trapping-math
  $<$<NOT:$<STREQUAL:${WINGBEAT_ARCH},>>:-march=${WINGBEAT_ARCH}>
  $<$<BOOL:${WINGBEAT_WERROR}>:-Werror>)
