#include "partition/partition_settings.hpp"

namespace wingbeat {

void PartitionSettings::describe(SettingSection& keys) {
  keys.add("imbalance", &imbalance,
           {.help = "allowed excess of the heaviest rank over the mean, as a fraction of the mean",
            .range = between(0.001, 10)});
}

}  // namespace wingbeat
