#pragma once

#include <string>
#include <vector>

#include "core/parallel/comm.hpp"

namespace wingbeat {

// The lines of a text, without their ends; what follows the last end is a line if it is not empty.
std::vector<std::string> lines_of(const std::string& text);

// Texts of all ranks, in rank order, on every rank. Collective.
std::string joined(const Comm& comm, const std::string& text);

// The first line of the first rank that has one, on every rank; empty where none has. Collective.
std::string first_line(const Comm& comm, const std::string& text);

}  // namespace wingbeat
