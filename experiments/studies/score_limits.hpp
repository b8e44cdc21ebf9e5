// Limits on the figures of a score, for continuous integration.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/studies/score.hpp"
#include "results/report/check_outcomes.hpp"

namespace footprint {

/// A limit as `--max NAME=VALUE` writes it. NAME is a measure of score_metrics() (its absolute value; not `psnr`), `pN`
/// (the Nth percentile of the normalised colour error over object pixels, 0 to 100), `share_above:E` (the share of
/// object pixels whose error is above E), or `rejected` (pixels that the test per pixel rejects).
struct ScoreLimit {
  std::string text;  ///< as written
  std::string name;
  double most = 0;
  double parameter = 0;  ///< N or E
};

/// Errors (usage): not that form, an unknown measure with the nearest one, a number out of range.
[[nodiscard]] ScoreLimit parse_score_limit(const std::string& text);

/// The figure that a limit is about; none where the image has none, as measures of radiance of displayed colours.
[[nodiscard]] std::optional<double> figure_of(const ScoreLimit& limit, const PictureScore& score);

/// An outcome per limit, in the suite of the image. A figure that the image does not have fails.
[[nodiscard]] std::vector<CheckOutcome> limit_outcomes(std::span<const ScoreLimit> limits, const PictureScore& score);

}  // namespace footprint
