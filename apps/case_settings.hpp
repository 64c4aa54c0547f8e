#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "adjoint/design_settings.hpp"
#include "adjoint/gradient_settings.hpp"
#include "apps/checkpoint_settings.hpp"
#include "apps/sweep/sweep_settings.hpp"
#include "core/algebra/solver_settings.hpp"
#include "core/io/settings.hpp"
#include "core/mesh/mesh_settings.hpp"
#include "core/spectral/time_settings.hpp"
#include "flow/flow_settings.hpp"
#include "flow/pitch_settings.hpp"
#include "flow/pseudo_time_settings.hpp"
#include "optimize/optimize_settings.hpp"
#include "partition/partition_settings.hpp"
#include "structure/flutter_settings.hpp"
#include "structure/lco_settings.hpp"
#include "structure/march_settings.hpp"
#include "structure/modal_settings.hpp"
#include "structure/pk_settings.hpp"
#include "structure/staggered_settings.hpp"
#include "structure/structure_settings.hpp"

namespace wingbeat {

// Every section of a case. Parts of the program are given the section they need.
struct CaseSettings {
  MeshSettings mesh;
  PartitionSettings partition;
  FlowSettings flow;
  PitchSettings pitch;
  TimeSettings time;
  StructureSettings structure;
  ModalSettings modal;
  FlutterSettings flutter;
  LcoSettings lco;
  MarchSettings march;
  PkSettings pk;
  DesignSettings design;
  GradientSettings gradient;
  OptimizeSettings optimize;
  SweepSettings sweep;
  SolverSettings solver;
  PseudoTimeSettings pseudo_time;
  StaggeredSettings staggered;
  CheckpointSettings checkpoint;

  void describe(SettingRegistry& registry);
};

// Where the case gives its keys: "section.key" -> "case.toml:7" or "command line".
using KeySources = std::map<std::string, std::string>;

// A case as read, and as text that reads back to the same values.
struct ResolvedCase {
  CaseSettings settings;
  std::string text;
  KeySources sources;
};

// Reads a case from its text, its path as the user gave it, and `section.key=value` overrides.
// Throws InputError listing all faults, those of overrides under `override_place`; required keys are those of
// the sections that `used_sections` names for the values read.
using UsedSections = std::function<std::vector<std::string>(const CaseSettings&)>;
ResolvedCase resolve_case(const std::string& text, const std::string& path,
                          const std::vector<std::string>& overrides, const UsedSections& used_sections,
                          const std::string& reader, const std::string& override_place = "command line");

}  // namespace wingbeat
