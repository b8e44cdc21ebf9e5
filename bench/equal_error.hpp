// How many samples of the reference come as close to the truth as a method's frame does.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/studies/stage.hpp"

namespace footprint::bench {

/// The error of a method's frame, that of a second reference of as many samples as the truth's own, below which errors
/// tell nothing, and the fewest samples a pixel of the reference, a power of two, whose error is no larger than the
/// frame's; none: all that were tried have a larger one.
struct EqualError {
  double error = 0.0;
  double noise = 0.0;
  std::optional<int> samples;
};

/// Pictures of one view by the reference at 1, 2, 4... samples, and their errors against one of `truth_samples` that
/// shares no random number with them. Tried are up to a quarter of those: beyond, the truth's own noise is what an
/// error tells.
class EqualErrors {
 public:
  /// Errors (usage): truth_samples outside 4 to 4096, or no pixel of the view shows the object.
  EqualErrors(const Stage& stage, const View& view, int truth_samples);

  [[nodiscard]] EqualError of(const StagedMethod& method) const;
  [[nodiscard]] int most_samples() const;

 private:
  [[nodiscard]] double error_of(const Image& picture) const;

  const Stage* stage_;
  View view_;
  Image truth_;
  float exposure_ = 1.0F;
  std::vector<double> errors_;  ///< [i]: of 2^i samples
  double noise_ = 0.0;
};

/// One entry of a table: error, samples and, with their times in milliseconds, what a frame takes of those samples'.
[[nodiscard]] std::string described(const EqualError& found, int most_samples, const std::vector<double>& frame_ms,
                                    const std::vector<double>& samples_ms);

}  // namespace footprint::bench
