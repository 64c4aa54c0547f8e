#pragma once

#include <fmt/format.h>

#include <array>
#include <string>

// What solution.cgns calls its parts: shared by writing it and restarting from it.
namespace wingbeat::solution_names {

inline constexpr std::array<const char*, 4> state_names{"Density", "MomentumX", "MomentumY",
                                                        "EnergyStagnationDensity"};
inline constexpr const char* y_name = "y";  // structural states, instance by instance
inline constexpr const char* omega_name = "omega";
inline constexpr const char* freestream_parameter_name = "freestream_parameter";
inline constexpr const char* reduced_velocity_name = "reduced_velocity";
inline constexpr const char* mach_name = "mach";
// Of a march.
inline constexpr const char* time_step_name = "time_step";
inline constexpr const char* rest_name = "rest";
inline constexpr const char* record_name = "record";
inline constexpr const char* rows_name = "rows";
inline constexpr const char* search_name = "search";
inline constexpr const char* entries_name = "entries";
// What it was solved as: text.
inline constexpr const char* case_name = "case";
inline constexpr const char* version_name = "version";
inline constexpr const char* commit_name = "commit";
inline constexpr const char* verb_name = "verb";
// Of an iteration that had not ended: the stage, numbers, and fields in the order of the file's cells.
inline constexpr const char* stage_name = "stage";
inline constexpr const char* memory_name = "memory";
inline std::string memory_field_name(int i) { return fmt::format("memory_field_{}", i); }

}  // namespace wingbeat::solution_names
