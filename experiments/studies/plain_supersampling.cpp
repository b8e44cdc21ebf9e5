// Frames at moved pixel centres, points of the reference's kind of sequence that share no random number with its
// samples, and sums in double.
#include "experiments/studies/plain_supersampling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "renderer/core/process.hpp"
#include "renderer/image/metrics.hpp"
#include "renderer/pipeline/sample_sequence.hpp"
#include "renderer/pipeline/timing.hpp"

namespace footprint {
namespace {

constexpr std::uint64_t curve_seed = 0x9e3779b97f4a7c15;  // keeps the curve's samples apart from the reference's

constexpr int most_timed = 4;  // frames at once; more of them take as many times longer

int timed_frames(int spp) { return std::min(spp, most_timed); }

constexpr int curve_rounds = 5;

// The counts that are timed, each once, even if several points of the curve share it.
std::set<int> timed_counts(std::span<const int> counts) {
  std::set<int> timed;
  for (const int spp : counts) timed.insert(timed_frames(spp));
  return timed;
}

double timing_weight(std::span<const int> counts) {
  double frames = 0.0;
  for (const int spp : timed_counts(counts)) frames += spp * (curve_rounds + 1);
  return frames;
}

// Median milliseconds by the count of frames.
std::map<int, double> measured_ms(const Stage& stage, const View& view, std::span<const int> counts,
                                  std::span<const glm::dvec2> offsets, const Progress& progress) {
  const FrameRenderer& direct = stage.methods()[stage.unit()].frames();
  const std::set<int> timed = timed_counts(counts);
  std::vector<DrawFrame> draws;
  for (const int spp : timed) {
    draws.emplace_back([&direct, &view, frames = offsets.first(static_cast<std::size_t>(spp))] {
      for (const glm::dvec2& offset : frames) direct.draw(view, offset);
    });
  }
  const RepeatedTimes times = interleaved_times(stage.context().info(), draws, curve_rounds, progress);
  std::map<int, double> ms;
  std::size_t draw = 0;
  for (const int spp : timed) ms[spp] = quantile(times[draw++], 0.5);
  return ms;
}

int most_frames(std::span<const int> counts) { return counts.empty() ? 0 : std::ranges::max(counts); }

// The means of the first so many frames, for each count: one pass over the longest.
std::map<int, Image> pictures_of(const Stage& stage, const View& view, std::span<const int> counts,
                                 std::span<const glm::dvec2> offsets, const Progress& progress) {
  const FrameRenderer& direct = stage.methods()[stage.unit()].frames();
  std::map<int, Image> pictures;
  FrameMean mean(view.size);
  for (const glm::dvec2& offset : offsets) {
    progress(fmt::format("{} frames", offsets.size()), mean.count() / static_cast<double>(offsets.size()));
    mean.add(direct.render(view, offset));
    if (std::ranges::find(counts, mean.count()) != counts.end()) pictures.emplace(mean.count(), mean.mean());
  }
  pictures[1] = direct.render(view);  // at pixel centres, as a program without any method has it
  return pictures;
}

}  // namespace

std::vector<glm::dvec2> frame_offsets(int count, std::uint64_t seed) {
  const std::uint32_t folded = static_cast<std::uint32_t>(seed) ^ static_cast<std::uint32_t>(seed >> 32U);
  const auto in_pixel = [&](std::uint32_t digits, std::uint32_t dimension) {
    return double{unit_interval(scrambled(digits, combined_seed(folded, dimension)))} - 0.5;
  };
  std::vector<glm::dvec2> offsets;
  for (int i = 0; i < count; ++i) {
    const SampleDigits digits = sample_digits(SamplePair::pixel, static_cast<std::uint32_t>(i));
    offsets.emplace_back(in_pixel(digits.x, 0), in_pixel(digits.y, 1));
  }
  return offsets;
}

FrameMean::FrameMean(const glm::ivec2& size)
    : size_(size), sums_(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * 4, 0.0) {}

void FrameMean::add(const Image& frame) {
  for (std::size_t t = 0; t < sums_.size(); ++t) sums_[t] += frame.texels[t];  // 0 where a pixel is not covered
  ++count_;
}

Image FrameMean::mean() const {
  Image mean(size_.x, size_.y, 4);
  for (std::size_t t = 0; t < sums_.size(); t += 4) {
    const double covered = sums_[t + 3];
    for (std::size_t c = t; c < t + 3; ++c) mean.texels[c] = static_cast<float>(covered > 0 ? sums_[c] / covered : 0.0);
    mean.texels[t + 3] = static_cast<float>(covered / count_);
  }
  return mean;
}

std::vector<SupersamplingPoint> measured_curve(const Stage& stage, const ReferenceSettings& settings,
                                               const ErrorTarget& target, ProgressParts& progress) {
  if (settings.supersampling.empty() || stage.methods()[stage.unit()].refusal()) return {};
  const View& view = target.view;
  const std::string prefix = fmt::format("distance {:g}: ", target.distance);
  const std::span<const int> counts = settings.supersampling;
  const std::vector<glm::dvec2> offsets = frame_offsets(most_frames(counts), settings.seed ^ curve_seed);
  const std::map<int, Image> pictures =
      pictures_of(stage, view, counts, offsets, progress.next(most_frames(counts), prefix + "supersampling, "));
  const std::map<int, double> ms =
      measured_ms(stage, view, counts, offsets, progress.next(timing_weight(counts), prefix));
  std::vector<SupersamplingPoint> curve;
  for (const int spp : counts) {
    const Image& picture = pictures.at(spp);
    const int timed = timed_frames(spp);
    curve.push_back({.distance = target.distance,
                     .spp = spp,
                     .normalized_color = normalized_color(picture, target.reference, target.exposure),
                     .shading = normalized_color_over(picture, target.reference, target.exposure, target.interior),
                     .ms = ms.at(timed) * spp / timed,
                     .node = host_name()});
  }
  return curve;
}

double curve_weight(std::span<const int> counts) { return most_frames(counts) + timing_weight(counts); }

}  // namespace footprint
