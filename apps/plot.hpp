#pragma once

#include <filesystem>

namespace wingbeat {

// Draws the results of a folder with apps/plots/plot.py. Needs Python with matplotlib at run time.
// Throws InputError where the folder, the script, Python or matplotlib is missing, or the script fails.
void plot_results(const std::filesystem::path& folder);

}  // namespace wingbeat
