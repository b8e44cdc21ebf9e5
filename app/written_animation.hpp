// An animation's report, written whole and printed: of one run, or of merged parts.
#pragma once

#include <filesystem>
#include <functional>

#include "results/report/animation_report.hpp"

namespace footprint {

/// Lets `make` fill a folder out of sight, signs what it made, writes the report beside the pictures, moves all of it
/// to `output` and prints the table. Errors: those of `make`; nothing is left of the folder then.
void write_and_print(const std::filesystem::path& output,
                     const std::function<Animation(const std::filesystem::path& folder)>& make);

}  // namespace footprint
