#pragma once

#include "core/io/settings.hpp"

namespace wingbeat {

// [time]: the period as 2 harmonics + 1 instances.
struct TimeSettings {
  int harmonics = 1;

  void describe(SettingSection& keys);
};

}  // namespace wingbeat
