#include "apps/verbs.hpp"

#include <array>

namespace wingbeat {

std::span<const Verb> verbs() {
  static const std::array table{
      Verb{"mesh", "write the mesh as CGNS and print its quality", {"mesh"}, run_mesh},
      Verb{"partition",
           "print what a partition for any number of ranks would cost",
           {"mesh", "partition", "time"},
           run_partition},
  };
  return table;
}

}  // namespace wingbeat
