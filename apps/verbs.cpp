#include "apps/verbs.hpp"

#include <array>

namespace wingbeat {

std::span<const Verb> verbs() {
  static const std::array table{
      Verb{"steady",
           "steady flow and its loads",
           {"mesh", "partition", "flow", "pitch", "solver"},
           run_steady,
           true},
      Verb{"pitch",
           "loads in a prescribed periodic pitch and plunge",
           {"mesh", "partition", "flow", "pitch", "time", "solver"},
           run_pitch,
           true,
           pitch_faults},
      Verb{"flutter",
           "flutter boundary: the speed and frequency at which small motion neither grows nor decays",
           {"mesh", "partition", "flow", "pitch", "time", "structure", "flutter", "solver"},
           run_flutter,
           true},
      Verb{"lco",
           "limit cycles of given energies, or at a given speed",
           {"mesh", "partition", "flow", "pitch", "time", "structure", "flutter", "lco", "solver"},
           run_lco,
           true,
           lco_faults},
      Verb{"march",
           "flow and section marched in time: growth, decay or limit cycle at a speed, or the flutter speed",
           {"mesh", "partition", "flow", "pitch", "structure", "march", "solver"},
           run_march,
           true},
      Verb{"pk",
           "aerodynamic matrix Q(k), and frequency and damping against speed by the p-k method",
           {},
           run_pk,
           false,
           pk_faults,
           pk_sections},
      Verb{"gradient",
           "derivatives of loads, flutter and limit cycles with respect to shape, flow and structure",
           {},
           run_gradient,
           true,
           gradient_faults,
           gradient_sections},
      Verb{"optimize",
           "the shape with the best flutter boundary, limit cycle or loads under constraints",
           {},
           run_optimize,
           true,
           optimize_faults,
           optimize_sections},
      Verb{"mesh", "write the mesh as CGNS and print its quality", {"mesh"}, run_mesh},
      Verb{"partition",
           "print what a partition for any number of ranks would cost",
           {"mesh", "partition", "time"},
           run_partition},
  };
  return table;
}

}  // namespace wingbeat
