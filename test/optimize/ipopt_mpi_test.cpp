#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "core/parallel/comm.hpp"
#include "test/optimize/toy_programs.hpp"

// Ipopt's linear solver comes with MPI calls that do nothing: none may take the place of the real ones.
namespace wingbeat {
namespace {

std::string library_of(const void* address) {
  Dl_info info{};
  return dladdr(address, &info) && info.dli_fname ? info.dli_fname : "";
}

void expect_real_mpi(const std::string& library) {
  EXPECT_NE(library.find("libmpi."), std::string::npos) << library;
  EXPECT_EQ(library.find("seq"), std::string::npos) << library;
}

TEST(IpoptBesideMpi, CallsOfMpiReachTheRealLibrary) {
  expect_real_mpi(library_of(reinterpret_cast<const void*>(&MPI_Init)));
  for (const char* name : {"MPI_Init", "MPI_Comm_rank", "MPI_Comm_size", "MPI_Allreduce", "MPI_Finalize"})
    expect_real_mpi(library_of(dlsym(RTLD_DEFAULT, name)));
}

TEST(IpoptBesideMpi, ASolveLeavesTheRanksTogether) {
  const Comm before;
  ToyProgram program = hock_schittkowski_71();
  EXPECT_EQ(minimize(program).status, OptimizerStatus::converged);
  const Comm after;
  EXPECT_EQ(after.size(), before.size());
  EXPECT_EQ(after.sum(1L), before.size());
  // The launcher's own count; a program started without it is alone.
  const char* launched = std::getenv("OMPI_COMM_WORLD_SIZE");
  EXPECT_EQ(after.size(), launched ? std::atoi(launched) : 1);
}

TEST(IpoptBesideMpi, OneRankMayOptimiseWhileTheOthersWait) {
  const Comm comm;
  double objective = 0.0;
  if (comm.is_root()) {
    ToyProgram program = hock_schittkowski_71();
    objective = minimize(program).objective;
  }
  comm.broadcast(objective);
  EXPECT_NEAR(objective, 17.0140173, 11 * IpoptOptions{}.tolerance);
}

}  // namespace
}  // namespace wingbeat
