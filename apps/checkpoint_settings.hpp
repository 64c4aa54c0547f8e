#pragma once

#include "core/io/settings.hpp"

namespace wingbeat {

// [checkpoint]: how often a run writes what it can go on from.
struct CheckpointSettings {
  double interval = 300.0;  // seconds
  double largest_share = 0.02;

  void describe(SettingSection& keys);
};

}  // namespace wingbeat
