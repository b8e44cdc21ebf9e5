// Candidates and their times; every ratio is formed between neighbours of one process.
#include "experiments/studies/frame_times.hpp"

#include <algorithm>
#include <limits>

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

void set_frame_times(Record& record, const std::vector<double>& times, const std::vector<double>& direct) {
  const std::vector<double> ratios = paired_ratios(times, direct);
  record.frame_ms = {.median = quantile(times, 0.5), .minimum = std::ranges::min(times), .p90 = quantile(times, 0.9)};
  record.fps = 1000.0 / record.frame_ms.median;
  const auto [low, high] = median_interval(ratios);
  record.ratio_to_direct = {.median = quantile(ratios, 0.5), .low = low, .high = high};
}

void set_no_times(Record& record) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  record.frame_ms = {unknown, unknown, unknown};
  record.fps = unknown;
  record.ratio_to_direct = {unknown, unknown, unknown};
}

}  // namespace

DistanceTimes time_methods(const Stage& stage, const View& view, int repeats, const Progress& progress) {
  std::vector<DrawFrame> draws;
  for (const StagedMethod& staged : stage.methods()) {
    draws.emplace_back([&staged, &view] {
      if (!staged.refusal()) staged.frames().draw(view);
    });
  }
  for (const StagedMethod& staged : stage.methods()) {
    if (!staged.refusal() && staged.gpu().has_frame_build())
      draws.emplace_back([&staged, &view] { staged.gpu().rebuild(view); });
  }
  return interleaved_times(stage.context().info(), draws, repeats, progress);
}

std::vector<std::optional<BuildTiming>> build_timings(const Stage& stage) {
  std::vector<std::optional<BuildTiming>> builds;
  for (const StagedMethod& staged : std::span(stage.methods()).subspan(1)) {
    builds.emplace_back();
    if (staged.refusal()) continue;
    const GpuMethod& gpu = staged.gpu();
    if (gpu.has_frame_build()) builds.back() = gpu.keeps_builds() ? BuildTiming::reused : BuildTiming::every_frame;
  }
  return builds;
}

void set_times(std::span<const std::reference_wrapper<Record>> records,
               std::span<const std::optional<BuildTiming>> builds, std::span<const DistanceTimes> processes) {
  const std::vector<double> direct = pooled(processes, 0);
  std::size_t build = records.size() + 1;  // the candidate that is the next method's frame build
  for (std::size_t m = 0; m < records.size(); ++m) {
    Record& record = records[m];
    const std::size_t own_build = builds[m] ? build++ : 0;
    if (record.failure) {
      set_no_times(record);
      continue;
    }
    set_frame_times(record, pooled(processes, m + 1), direct);
    if (builds[m])
      record.frame_build = FrameBuildTime{.ms = quantile(pooled(processes, own_build), 0.5), .timing = *builds[m]};
  }
}

}  // namespace footprint
