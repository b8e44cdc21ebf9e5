// Milliseconds are nanoseconds per pixel times the pixels that the object covers: an estimate has no fixed costs of a
// frame.
#include "experiments/runner/estimated_times.hpp"

#include <algorithm>
#include <limits>

namespace footprint {
namespace {

constexpr double not_estimated = std::numeric_limits<double>::quiet_NaN();

void set_times(Record& record, const std::string& gpu) {
  const auto cost = std::ranges::find(record.gpu_costs, gpu, &GpuCost::gpu);
  const bool is_known = cost != record.gpu_costs.end() && !cost->failure;
  const double ms_per_ns = 1e-6 * static_cast<double>(record.pixels.object);
  const double ms = is_known ? ms_per_ns * cost->cost_ns : not_estimated;
  record.frame_ms = FrameTime{.median = ms, .minimum = ms, .p90 = ms};
  record.fps = 1000.0 / ms;
  if (!record.frame_build_ms) return;
  record.frame_build_ms = is_known ? ms_per_ns * cost->passes_ns : not_estimated;
  record.frame_build = BuildTiming::every_frame;
}

double direct_ms(const std::vector<Record>& records, double distance) {
  const auto direct = std::ranges::find_if(
      records, [&](const Record& record) { return record.method == "direct" && record.distance == distance; });
  return direct == records.end() ? not_estimated : direct->frame_ms.median;
}

}  // namespace

std::vector<std::string> estimated_gpus(const Results& results) {
  std::vector<std::string> gpus;
  if (results.records.empty()) return gpus;
  for (const GpuCost& cost : results.records.front().gpu_costs) gpus.push_back(cost.gpu);
  return gpus;
}

Results with_estimated_times(Results results, const std::string& gpu) {
  for (Record& record : results.records) set_times(record, gpu);
  for (SupersamplingPoint& point : results.supersampling)
    point.ms = point.spp * direct_ms(results.records, point.distance);
  return results;
}

}  // namespace footprint
