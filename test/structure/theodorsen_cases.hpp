#pragma once

#include <vector>

#include "structure/aerodynamic_table.hpp"
#include "structure/theodorsen.hpp"
#include "structure/typical_section.hpp"

namespace wingbeat::testing {

// Incompressible flutter of a typical section.
struct TheodorsenCase {
  TypicalSection section;
  double speed;      // U/(b omega_alpha) = 2 V
  double frequency;  // omega/omega_alpha
};

// Computed to 30 digits by an independent program.
inline const std::vector<TheodorsenCase> theodorsen_cases = {
    {{-0.6, .25, .75, .5, 75.0}, 6.895666081, .8145281754},
    {{-0.5, .25, .75, .5, 75.0}, 6.090320747, .8046441358},
    {{0.0, .25, .75, .5, 75.0}, 4.513328461, .7303411102},
    {{-0.6, .25, .75, .8, 75.0}, 4.183222398, .9679284154},
    {{-0.2, .2, .25, .4, 20.0}, 2.036571372, .6786771979},
    {{-0.2, .1, .25, .5, 10.0}, 1.563414969, .7315138716},
    {{-0.4, .2, .25, .5, 10.0}, 1.732623505, .7546201740},
    {{-0.5, .25, .25, .3185, 100.0}, 5.6404552, .56989778},
};

inline AerodynamicTable flat_plate_samples(double elastic_axis, int samples) {
  return tabulate([elastic_axis](double k) { return theodorsen_matrix(elastic_axis, k); },
                  spread_reduced_frequencies(0.02, 1.5, samples));
}

}  // namespace wingbeat::testing
