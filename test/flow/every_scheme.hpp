#pragma once

#include <string>
#include <vector>

#include "flow/scheme/scheme.hpp"

namespace wingbeat::testing {

struct NamedScheme {
  std::string name;
  Scheme scheme;
};

// Every scheme, with each of its limiters.
inline std::vector<NamedScheme> every_scheme() {
  return {{"jst", JstScheme{}},
          {"matrix", MatrixScheme{}},
          {"cusp", CuspScheme{}},
          {"roe", RoeScheme{}},
          {"roe, venkatakrishnan", RoeScheme{Limiter::venkatakrishnan}},
          {"van leer", VanLeerScheme{}},
          {"van leer, venkatakrishnan", VanLeerScheme{Limiter::venkatakrishnan}}};
}

}  // namespace wingbeat::testing
