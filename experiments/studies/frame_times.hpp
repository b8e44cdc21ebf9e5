// The frames of a run's methods: their images, single or as histories, and their times. Also plain supersampling as a
// program without any method would do it: the mean of whole frames of `direct` whose samples lie elsewhere in the
// pixel, and the curve of its errors and times. Methods are compared with it at equal work.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

#include "experiments/studies/stage.hpp"
#include "experiments/studies/view_path.hpp"
#include "renderer/image/image.hpp"
#include "renderer/pipeline/history.hpp"
#include "results/report/records.hpp"

namespace footprint {

struct Reference;

/// Frame times of one process at one distance: [candidate][repeat], milliseconds; first the
/// stage's methods (whole frames), then the frame builds alone of those that have one, in the same order.
using DistanceTimes = std::vector<std::vector<double>>;

/// The frame times of one process at all distances.
using FrameTimes = std::vector<DistanceTimes>;

/// Whether more rounds would say little more of the ratio of `times` to `unit`, taken in the same rounds: the 95%
/// interval of its median is narrower than 3% of it.
[[nodiscard]] bool is_ratio_known(const std::vector<double>& times, const std::vector<double>& unit);

/// Times all candidates at one distance, in turn.
/// repeats: of each candidate; fewer where its ratio to the unit is known before.
[[nodiscard]] DistanceTimes time_methods(const Stage& stage, const View& view, int repeats, const Progress& progress);

/// Fills in frame times, ratios and frame builds of the records of one distance.
/// records: one per method of the stage's settings, in their order.
/// processes: the times of each process. Medians are over all of them, and every ratio is formed within one process, to
/// the stage's unit, which costs 1. If the unit failed, ratios are unknown.
void set_times(std::span<Record> records, const Stage& stage, std::span<const DistanceTimes> processes);

/// Marks the times of a record as not measured.
void set_no_times(Record& record);

/// Draws a stage's methods, each as the settings of its history say.
class MethodFrames {
 public:
  /// Keeps the stage's address.
  /// views: all of the run.
  MethodFrames(Stage& stage, std::vector<PlannedView> views);

  /// The image of a method in a view, which the stage is at. On a path its history has all frames before it, which are
  /// drawn again unless the last call for this method was the view before.
  [[nodiscard]] Image render(std::size_t method, const PlannedView& place, const View& view);

 private:
  // The history of a method, and the number of views on the path that it contains.
  struct Sequence {
    std::optional<History> history;
    std::size_t views = 0;
  };

  void add_view(Sequence& sequence, const StagedMethod& method, View view);

  Stage& stage_;
  std::vector<PlannedView> views_;
  std::vector<Sequence> sequences_;  // of each method
};

/// Renders a frame of a method in a view, or what a history of that view alone shows.
[[nodiscard]] Image render_image(const StagedMethod& method, const View& view);

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

/// A point for each count of frames that the settings name. The stage's first method is `direct`.
[[nodiscard]] std::vector<SupersamplingPoint> measured_curve(const Stage& stage, const ReferenceSettings& settings,
                                                             const Reference& target, float exposure,
                                                             const Progress& progress);

/// The curve's weight in progress, in samples per pixel.
[[nodiscard]] double curve_weight(std::span<const int> counts);

}  // namespace footprint
