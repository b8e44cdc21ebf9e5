// Joins views: their records in order, the worst of their errors, and all warnings.
#include "experiments/studies/distance_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "experiments/studies/picture_files.hpp"
#include "results/report/ranking.hpp"

namespace footprint {
namespace {

void append(std::vector<std::string>& texts, const std::vector<std::string>& more) {
  texts.insert(texts.end(), more.begin(), more.end());
}

std::vector<std::string> warnings_of(const DistanceResult& result) {
  std::vector<std::string> warnings;
  for (const Record& record : result.records) {
    if (record.failure)
      warnings.push_back(fmt::format("distance {:g}: {} failed: {}", record.distance, record.method, *record.failure));
  }
  append(warnings, result.warnings);
  if (auto warning = linear_measures_warning(result.distance, result.standard_error))
    warnings.push_back(std::move(*warning));
  return warnings;
}

// The scales of false-colour images, which an animation has none of.
void set_error_scales(Results& results, const ComparisonHead& head, const std::vector<DistanceResult>& views) {
  if (head.way) return;
  double largest_error = 0;
  for (const DistanceResult& result : views) {
    largest_error = std::max(largest_error, result.largest_error);
    results.error_scales.push_back(
        {.distance = result.distance, .error = error_scale(result.largest_error, head.error_scale)});
  }
  results.error_scale = error_scale(largest_error, head.error_scale);
}

}  // namespace

std::string frame_name(std::size_t index) { return fmt::format("frame_{:04}", index); }

Results results_of(const ComparisonHead& head, const std::vector<DistanceResult>& views) {
  Results results;
  results.backend = head.backend;
  results.scene = head.scene;
  results.footprint = head.footprint;
  results.way = head.way;
  const Exposure& exposure = views.front().exposure;
  results.scene.exposure = exposure.factor;
  results.scene.exposure_source = word_for(exposure_sources, exposure.source);
  results.reference = head.reference;
  results.timing = {.frames = head.timed_frames, .processes = views.back().processes};
  append(results.scene.warnings, head.first_warnings);
  for (const DistanceResult& result : views) {
    results.reference.standard_errors.push_back(result.standard_error);
    results.reference.samples += result.samples;
    results.reference.seconds += result.seconds;
    std::ranges::copy(result.records, std::back_inserter(results.records));
    std::ranges::copy(result.pairs, std::back_inserter(results.pairs));
    std::ranges::copy(result.curve, std::back_inserter(results.supersampling));
    if (!head.way) append(results.scene.warnings, warnings_of(result));  // ranking_warnings has one for all frames
  }
  append(results.scene.warnings, head.last_warnings);
  results.reference.samples /= static_cast<double>(views.size());
  set_error_scales(results, head, views);
  return results;
}

Results joined_animation(const FinishedWork& finished, const std::string& run, const std::filesystem::path& folder) {
  const auto damaged = [&](const std::string& what) {
    return Error(ErrorKind::usage, finished.folder().string(), what + " is missing or damaged",
                 "run the part that has it again");
  };
  const auto head = finished.find<ComparisonHead>(run + "/head", folder);
  if (!head) throw damaged("the description of the animation");
  std::vector<DistanceResult> frames;
  for (std::size_t i = 0; i < head->frames; ++i) {
    auto frame = finished.find<DistanceResult>(run + "/" + frame_name(i), folder);
    if (!frame) throw damaged(fmt::format("frame {} of {}", i + 1, head->frames));
    frames.push_back(std::move(*frame));
  }
  return results_of(*head, frames);
}

}  // namespace footprint
