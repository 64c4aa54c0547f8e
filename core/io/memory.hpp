#pragma once

#include <filesystem>

namespace wingbeat {

// Of this process, in bytes: what it holds now, and the most that it ever held. 0 where the system does not
// tell.
double resident_bytes();
double peak_resident_bytes();

// Gives memory that was freed back to the system, so that it no longer counts as held.
void return_freed_memory();

// Bytes that this node still has for new processes and this one: what the kernel deems available, or less
// where a control group (of a job or a container) is limited. Infinite where the system does not tell.
// `root`: where the system's files lie, for tests.
double available_bytes(const std::filesystem::path& root = "/");

// Bytes that this process may still ask for by its limit of address space (ulimit -v); infinite without one.
double allowed_bytes();

}  // namespace wingbeat
