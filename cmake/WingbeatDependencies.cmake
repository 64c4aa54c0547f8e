# Debian 12 packages.
# The C interface is what is used: MPI's own C++ classes would cost every file a second of compiling.
set(MPI_CXX_SKIP_MPICXX TRUE)
find_package(MPI REQUIRED COMPONENTS CXX)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(tomlplusplus REQUIRED)

# wingbeat_find_library(<target> HEADER <h> LIBRARIES <names...> [PATHS <dirs...>])
function(wingbeat_find_library target)
  cmake_parse_arguments(ARG "" "HEADER" "LIBRARIES;PATHS" ${ARGN})
  add_library(${target} INTERFACE IMPORTED)
  find_path(${target}_INCLUDE ${ARG_HEADER} PATH_SUFFIXES ${ARG_PATHS} REQUIRED)
  set_target_properties(${target} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${${target}_INCLUDE}")
  foreach(name ${ARG_LIBRARIES})
    find_library(${target}_${name} ${name} REQUIRED)
    target_link_libraries(${target} INTERFACE ${${target}_${name}})
  endforeach()
endfunction()

wingbeat_find_library(suitesparse::umfpack HEADER umfpack.h LIBRARIES umfpack cholmod amd suitesparseconfig openblas PATHS suitesparse)
wingbeat_find_library(metis::metis HEADER metis.h LIBRARIES metis)
wingbeat_find_library(cgns::cgns HEADER cgnslib.h LIBRARIES cgns)
# Debian's Ipopt solves with a sequential MUMPS whose libraries define MPI calls that do nothing. They must stay
# out of the link line, where pkg-config would put them: every MPI call then finds the MPI that is linked.
wingbeat_find_library(ipopt::ipopt HEADER IpIpoptApplication.hpp LIBRARIES ipopt PATHS coin)
