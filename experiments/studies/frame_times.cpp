// Candidates and their times; every ratio is formed between neighbours of one process.
#include "experiments/studies/frame_times.hpp"

#include <algorithm>

#include "renderer/pipeline/timing.hpp"

namespace footprint {
namespace {

// The times of one candidate at one distance, over all processes.
std::vector<double> pooled(std::span<const FrameTimes> processes, std::size_t distance, std::size_t candidate) {
  std::vector<double> times;
  for (const FrameTimes& process : processes) {
    const auto& own = process.at(distance).at(candidate);
    times.insert(times.end(), own.begin(), own.end());
  }
  return times;
}

void set_frame_times(Record& record, const std::vector<double>& times, const std::vector<double>& direct) {
  const std::vector<double> ratios = paired_ratios(times, direct);
  record.frame_ms = {.median = quantile(times, 0.5), .minimum = std::ranges::min(times), .p90 = quantile(times, 0.9)};
  record.fps = 1000.0 / record.frame_ms.median;
  record.ratio_to_direct = {
      .median = quantile(ratios, 0.5), .minimum = std::ranges::min(ratios), .maximum = std::ranges::max(ratios)};
}

}  // namespace

std::vector<std::vector<double>> time_methods(const Stage& stage, const View& view, int repeats,
                                              const Progress& progress) {
  std::vector<DrawFrame> draws;
  for (const StagedMethod& staged : stage.methods())
    draws.emplace_back([&staged, &view] { staged.frames().draw(view); });
  for (const StagedMethod& staged : stage.methods()) {
    if (staged.gpu().has_frame_build()) draws.emplace_back([&staged, &view] { staged.gpu().rebuild(view); });
  }
  return interleaved_times(stage.context().info(), draws, repeats, progress);
}

void set_times(std::span<const std::reference_wrapper<Record>> records, const Stage& stage,
               std::span<const FrameTimes> processes, std::size_t distance) {
  const std::vector<double> direct = pooled(processes, distance, 0);
  std::size_t build = records.size() + 1;  // the candidate that is the next method's frame build
  for (std::size_t m = 0; m < records.size(); ++m) {
    Record& record = records[m];
    set_frame_times(record, pooled(processes, distance, m + 1), direct);
    const GpuMethod& gpu = stage.methods()[m + 1].gpu();
    if (!gpu.has_frame_build()) continue;
    record.frame_build = FrameBuildTime{.ms = quantile(pooled(processes, distance, build++), 0.5),
                                        .timing = gpu.keeps_builds() ? BuildTiming::reused : BuildTiming::every_frame};
  }
}

}  // namespace footprint
