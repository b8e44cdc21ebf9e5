// Plain supersampling as a program without any method would do it: the mean of whole frames of `direct` whose samples
// lie elsewhere in the pixel, and the curve of its errors and times. Methods are compared with it at equal work: one
// sample per pixel is one frame, at pixel centres.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "experiments/studies/stage.hpp"
#include "renderer/image/image.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// The positions of the samples, from the pixel's centre, in pixels, -0.5 to 0.5: the first `count` points of a (0, 2)-
/// sequence (Sobol's, scrambled by the seed), so that more samples begin with those of fewer, and every power of two of
/// them has one sample in each cell of every grid of as many cells. A single frame is drawn at pixel centres.
[[nodiscard]] std::vector<glm::dvec2> frame_offsets(int count, std::uint64_t seed);

/// The mean of frames, which grows one by one.
class FrameMean {
 public:
  explicit FrameMean(const glm::ivec2& size);

  /// RGBA of that size.
  void add(const Image& frame);

  [[nodiscard]] int count() const { return count_; }

  /// RGBA: mean radiance over the frames that cover the pixel, and their share. At least one was added.
  [[nodiscard]] Image mean() const;

 private:
  glm::ivec2 size_;
  int count_ = 0;
  std::vector<double> sums_;
};

/// The reference of errors in one view.
struct ErrorTarget {
  const View& view;
  double distance;         ///< its name in the curve
  const Image& reference;  ///< RGBA
  const Image& interior;   ///< a mask
  float exposure = 1;
};

/// A point for each count of frames that the settings name. The stage's first method is `direct`.
[[nodiscard]] std::vector<SupersamplingPoint> measured_curve(const Stage& stage, const ReferenceSettings& settings,
                                                             const ErrorTarget& target, ProgressParts& progress);

/// The curve's weight in progress, in samples per pixel.
[[nodiscard]] double curve_weight(std::span<const int> counts);

}  // namespace footprint
