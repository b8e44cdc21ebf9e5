// One stage, one bake; only the camera's distance changes from block to block of rows.
#include "bench/zoom_frames.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/equal_error.hpp"
#include "bench/side_by_side.hpp"

namespace footprint::bench {
namespace {

std::size_t index_of_direct(const Stage& stage) {
  const auto found =
      std::ranges::find(stage.methods(), "direct", [](const StagedMethod& method) { return method.baked().spec.text; });
  return static_cast<std::size_t>(found - stage.methods().begin());
}

std::vector<EqualError> equal_errors(const Stage& stage, const EqualErrors& errors) {
  std::vector<EqualError> found;
  for (const StagedMethod& method : stage.methods()) found.push_back(errors.of(method));
  return found;
}

// Every method's frame, then for each of `equal` the samples that it is as good as.
WallAndCpu times_of(const Stage& stage, const View& view, const std::vector<EqualError>& equal, int most_samples,
                    int rounds) {
  std::vector<DrawFrame> candidates;
  for (const StagedMethod& method : stage.methods())
    candidates.emplace_back([&method, &view] { method.frames().draw(view); });
  for (const EqualError& found : equal) {
    candidates.emplace_back(
        [&, samples = found.samples.value_or(most_samples)] { stage.reference().draw(view, samples, reference_seed); });
  }
  return side_by_side(stage.context().info(), candidates, rounds);
}

std::string zoom_rows(const Stage& stage, double distance, int rounds, const std::optional<int>& truth_samples) {
  const View view = stage.view(distance);
  std::optional<EqualErrors> errors;
  if (truth_samples) errors.emplace(stage, view, *truth_samples);
  const std::vector<EqualError> equal = errors ? equal_errors(stage, *errors) : std::vector<EqualError>{};
  const int most_samples = errors ? errors->most_samples() : 0;
  const WallAndCpu times = times_of(stage, view, equal, most_samples, rounds);
  std::string text;
  for (std::size_t i = 0; i < stage.methods().size(); ++i) {
    text += fmt::format("{:<10g} {:<44} {:>10.1f} {:>10.2f}", distance, stage.methods()[i].baked().spec.text,
                        quantile(times.cpu[i], 0.5),
                        quantile(paired_ratios(times.cpu[i], times.cpu[index_of_direct(stage)]), 0.5));
    if (errors) {
      text += "   " + described(equal[i], most_samples, times.cpu[i], times.cpu[stage.methods().size() + i]);
    }
    text += "\n";
  }
  return text;
}

}  // namespace

std::string zoom_table(Scene scene, const std::string& methods, const std::vector<double>& distances, int rounds,
                       const std::optional<int>& truth_samples) {
  const Stage stage(std::move(scene), bench_settings(methods), no_progress);
  std::string text = fmt::format("{:<10} {:<44} {:>10} {:>10}", "distance", "method", "CPU, ms", "x direct");
  if (truth_samples) text += "   as good as the reference at";
  text += "\n";
  for (const double distance : distances) text += zoom_rows(stage, distance, rounds, truth_samples);
  stage.context().check("timing frames over a zoom");
  return text;
}

}  // namespace footprint::bench
