#pragma once

#include "core/io/settings.hpp"

namespace wingbeat {

// [partition]: how cells are shared among ranks.
struct PartitionSettings {
  double imbalance = 0.05;

  void describe(SettingSection& keys);
};

}  // namespace wingbeat
