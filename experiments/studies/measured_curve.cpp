// Frames at moved pixel centres; their samples share no random number with the reference's.
#include "experiments/studies/measured_curve.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/studies/plain_supersampling.hpp"
#include "renderer/image/metrics.hpp"
#include "renderer/pipeline/timing.hpp"

namespace footprint {
namespace {

constexpr std::uint64_t curve_seed = 0x9e3779b97f4a7c15;  // keeps the curve's samples apart from the reference's

// Of so many frames those that are timed: more of them take as many times longer.
int timed_frames(int spp) { return std::min(spp, 8); }

// How often they are timed: few of them, which a passing disturbance would spoil, more often.
int curve_repeats(int spp) { return std::clamp(16 / spp, 2, 5); }

// Median milliseconds of all `offsets`' frames.
double measured_ms(const Stage& stage, const View& view, std::span<const glm::dvec2> offsets,
                   const Progress& progress) {
  const int spp = static_cast<int>(offsets.size());
  const FrameRenderer& direct = stage.methods().front().frames();
  const DrawFrame draw = [&] {
    for (const glm::dvec2& offset : offsets.first(static_cast<std::size_t>(timed_frames(spp))))
      direct.draw(view, offset);
  };
  const std::vector<double> times = repeated_times(stage.context().info(), draw, curve_repeats(spp), progress);
  return quantile(times, 0.5) * spp / timed_frames(spp);
}

}  // namespace

std::vector<SupersamplingPoint> measured_curve(const Stage& stage, const ReferenceSettings& settings, double distance,
                                               const ErrorTarget& target, ProgressParts& progress) {
  const View view = stage.view(distance);
  const std::string prefix = fmt::format("distance {:g}: ", distance);
  std::vector<SupersamplingPoint> curve;
  for (const int spp : settings.supersampling) {
    const std::uint64_t seed = settings.seed ^ (curve_seed * static_cast<std::uint64_t>(spp));
    const std::vector<glm::dvec2> offsets = frame_offsets(spp, seed);
    const Image picture =
        mean_of_frames(stage.methods().front().frames(), view, offsets, progress.next(spp, prefix + "supersampling, "));
    curve.push_back(
        {.distance = distance,
         .spp = spp,
         .normalized_color = normalized_color(picture, target.reference, target.exposure),
         .shading = normalized_color_over(picture, target.reference, target.exposure, target.interior),
         .ms = measured_ms(stage, view, offsets, progress.next(timed_frames(spp) * curve_repeats(spp), prefix))});
  }
  return curve;
}

double curve_weight(std::span<const int> counts) {
  double samples = 0.0;
  for (const int spp : counts) samples += spp + timed_frames(spp) * curve_repeats(spp);
  return samples;
}

}  // namespace footprint
