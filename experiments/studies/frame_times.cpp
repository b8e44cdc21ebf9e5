// Candidates and their times; every ratio is formed between neighbours of one process. Supersampling: frames at moved
// pixel centres, points of the reference's kind of sequence that share no random number with its samples, and sums in
// double.
#include "experiments/studies/frame_times.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <map>
#include <memory>
#include <set>

#include "experiments/studies/reference.hpp"
#include "experiments/studies/view_path.hpp"
#include "renderer/core/process.hpp"
#include "renderer/image/metrics.hpp"
#include "renderer/pipeline/sample_sequence.hpp"
#include "renderer/pipeline/timing.hpp"

namespace footprint {
namespace {

// The times of one candidate over all processes.
std::vector<double> pooled(std::span<const DistanceTimes> processes, std::size_t candidate) {
  std::vector<double> times;
  for (const DistanceTimes& process : processes) {
    const auto& own = process.at(candidate);
    times.insert(times.end(), own.begin(), own.end());
  }
  return times;
}

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr TimeRatio unknown_ratio{unknown, unknown, unknown};

TimeRatio ratio_between(const std::vector<double>& times, const std::vector<double>& unit) {
  const std::vector<double> ratios = paired_ratios(times, unit);
  const auto [low, high] = median_interval(ratios);
  return {.median = quantile(ratios, 0.5), .low = low, .high = high};
}

void set_frame_times(Record& record, const std::vector<double>& times) {
  record.frame_ms = {.median = quantile(times, 0.5), .min = std::ranges::min(times), .p90 = quantile(times, 0.9)};
  record.fps = 1000.0 / record.frame_ms.median;
}

// The view before the path begins, and its first frame, which all have the same camera.
void restart(std::optional<History>& history, const StagedMethod& method, View view) {
  if (!history) history.emplace(view.size, method.history());
  history->restart();
  for (int i = 0; i < method.history().frames; ++i) {
    view.frame = static_cast<std::uint32_t>(i);
    history->add(method.frames(), view);
  }
}

// The image of a history, whose frames have no emitted light.
Image picture_of_history(const History& history, const StagedMethod& method, const View& view) {
  Image picture = history.image();
  method.frames().add_emitted(picture, view);
  return picture;
}

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
std::map<int, Image> render_pictures(const Stage& stage, const View& view, std::span<const int> counts,
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

void set_no_times(Record& record) {
  record.frame_ms = {unknown, unknown, unknown};
  record.fps = unknown;
  record.ratio_to_direct = unknown_ratio;
}

// Fewer rounds have no interval (median_interval).
bool is_ratio_known(const std::vector<double>& times, const std::vector<double>& unit) {
  constexpr std::size_t fewest = 6;
  constexpr double narrow = 0.03;
  if (times.size() < fewest) return false;
  const TimeRatio ratio = ratio_between(times, unit);
  return ratio.high - ratio.low < narrow * ratio.median;
}

// A history's camera turns by a fraction of a pixel in each frame, so that the history follows the surface.
DrawFrame next_frame(const StagedMethod& staged, const View& view) {
  if (staged.refusal()) return [] {};
  if (staged.history().frames == 0) return [&] { staged.frames().draw(view); };
  constexpr float turn = 1e-4F;  // radians
  View turned = view;
  turned.camera.world = glm::rotate(view.camera.world, turn, {0.0F, 1.0F, 0.0F});
  const auto history = std::make_shared<History>(view.size, staged.history());
  return [&staged, &view, turned, history, is_turned = false]() mutable {
    is_turned = !is_turned;
    history->add(staged.frames(), is_turned ? turned : view);
  };
}

DistanceTimes time_methods(const Stage& stage, const View& view, int repeats, const Progress& progress) {
  std::vector<DrawFrame> draws;
  for (const StagedMethod& staged : stage.methods()) draws.push_back(next_frame(staged, view));
  for (const StagedMethod& staged : stage.methods()) {
    if (!staged.refusal() && staged.gpu().has_frame_build())
      draws.emplace_back([&staged, &view] { staged.gpu().rebuild(view); });
  }
  const auto is_enough = [&](const RepeatedTimes& times) {
    const std::span<const std::vector<double>> frames = std::span(times).first(stage.methods().size());
    return std::ranges::all_of(frames, [&](const auto& own) { return is_ratio_known(own, times[stage.unit()]); });
  };
  return interleaved_times(stage.context().info(), draws, repeats, progress, is_enough);
}

void set_times(std::span<Record> records, const Stage& stage, std::span<const DistanceTimes> processes) {
  const bool has_unit = stage.unit() >= records.size() || !records[stage.unit()].failure;
  const std::vector<double> unit_times = pooled(processes, stage.unit());
  std::size_t build = stage.methods().size();  // the candidate that is the next method's frame build
  for (std::size_t m = 0; m < records.size(); ++m) {
    Record& record = records[m];
    const StagedMethod& staged = stage.methods()[m];
    const bool is_built = !staged.refusal() && staged.gpu().has_frame_build();
    const std::size_t own_build = is_built ? build++ : 0;
    record.node = host_name();
    if (record.failure) {
      set_no_times(record);
      continue;
    }
    const std::vector<double> times = pooled(processes, m);
    set_frame_times(record, times);
    record.ratio_to_direct = has_unit ? ratio_between(times, unit_times) : unknown_ratio;
    if (!is_built) continue;
    record.frame_build_ms = quantile(pooled(processes, own_build), 0.5);
    record.frame_build = staged.gpu().reuses_build() ? BuildTiming::reused : BuildTiming::every_frame;
  }
}

Image render_image(const StagedMethod& method, const View& view) {
  if (method.history().frames == 0) return method.frames().render(view);
  std::optional<History> history;
  restart(history, method, view);
  return picture_of_history(*history, method, view);
}

MethodFrames::MethodFrames(Stage& stage, std::vector<PlannedView> views)
    : stage_(stage), views_(std::move(views)), sequences_(stage.methods().size()) {}

void MethodFrames::add_view(Sequence& sequence, const StagedMethod& method, View view) {
  if (sequence.views++ == 0) return restart(sequence.history, method, view);
  view.frame += static_cast<std::uint32_t>(method.history().frames) - 1;
  sequence.history->add(method.frames(), view);
}

Image MethodFrames::render(std::size_t method, const PlannedView& place, const View& view) {
  const StagedMethod& staged = stage_.methods()[method];
  if (place.kind == RunKind::comparison || staged.history().frames == 0) return render_image(staged, view);
  const std::size_t index = place.index;
  Sequence& sequence = sequences_[method];
  if (sequence.views > index) sequence.views = 0;
  const bool goes_back = sequence.views < index;
  while (sequence.views < index) add_view(sequence, staged, stage_.move_to(views_[sequence.views].at));
  add_view(sequence, staged, goes_back ? stage_.move_to(place.at) : view);
  return picture_of_history(*sequence.history, staged, view);
}

std::vector<glm::dvec2> frame_offsets(int count, std::uint64_t seed) {
  const std::uint32_t folded = static_cast<std::uint32_t>(seed) ^ static_cast<std::uint32_t>(seed >> 32U);
  const auto in_pixel = [&](std::uint32_t digits, std::uint32_t dimension) {
    return double{unit_interval(scrambled(digits, combined_seed(folded, dimension)))} - 0.5;
  };
  std::vector<glm::dvec2> offsets;
  for (int i = 0; i < count; ++i) {
    const glm::uvec2 digits = sample_digits(SamplePair::pixel, static_cast<std::uint32_t>(i));
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
                                               const Reference& target, float exposure, const Progress& progress) {
  if (settings.supersampling.empty() || stage.methods()[stage.unit()].refusal()) return {};
  const View& view = target.view;
  const std::span<const int> counts = settings.supersampling;
  ProgressParts parts(progress, curve_weight(counts));
  const std::vector<glm::dvec2> offsets = frame_offsets(most_frames(counts), settings.seed ^ curve_seed);
  const std::map<int, Image> pictures =
      render_pictures(stage, view, counts, offsets, parts.next(most_frames(counts), "supersampling, "));
  const std::map<int, double> ms = measured_ms(stage, view, counts, offsets, parts.next(timing_weight(counts), ""));
  std::vector<SupersamplingPoint> curve;
  for (const int spp : counts) {
    const Image& picture = pictures.at(spp);
    const int timed = timed_frames(spp);
    curve.push_back({.distance = target.place.at.distance,
                     .spp = spp,
                     .normalized_color = normalized_color(picture, target.reference.mean, exposure),
                     .shading = normalized_color(picture, target.reference.mean, exposure, target.parts.interior),
                     .ms = ms.at(timed) * spp / timed,
                     .node = host_name()});
  }
  return curve;
}

double curve_weight(std::span<const int> counts) { return most_frames(counts) + timing_weight(counts); }

}  // namespace footprint
