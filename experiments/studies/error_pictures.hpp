// The error pictures of a comparison, which wait until all errors are known: the scale of each distance, the one that
// all share, and the strips of a distance side by side.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "experiments/settings/run_settings.hpp"
#include "experiments/studies/picture_files.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// A record whose error picture waits for the scale that all of them share.
struct Draft {
  Record record;
  Exhibit exhibit;
  std::string stem, name;  ///< of its files; the part of it that is the method's
};

/// What stands at the top of the pictures of some drafts: `asked`, else the largest 99th percentile over them, in two
/// digits, 0.01 at least.
[[nodiscard]] double error_scale(std::span<const Draft> drafts, const std::optional<double>& asked);

/// Writes the error pictures of the drafts of one distance on its own scale, and names them in the records; until
/// write_shared_error_pictures they are those on the shared scale, too.
void write_error_pictures(const std::filesystem::path& folder, std::span<Draft> drafts, double scale);

/// Writes the error pictures of some drafts on the scale that all distances share, and names them in the records.
void write_shared_error_pictures(const std::filesystem::path& folder, std::span<Draft> drafts, double shared);

/// Writes the strips of a distance, the reference first.
void write_distance_strips(const std::filesystem::path& folder, Exhibit reference, std::span<const Draft> drafts,
                           float exposure, double scale);

}  // namespace footprint
