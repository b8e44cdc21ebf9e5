// One stage, one bake; only the camera's distance changes from row to row.
#include "bench/zoom_frames.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/side_by_side.hpp"

namespace footprint::bench {
namespace {

std::size_t index_of_direct(const Stage& stage) {
  const auto found =
      std::ranges::find(stage.methods(), "direct", [](const StagedMethod& method) { return method.baked().spec.text; });
  return static_cast<std::size_t>(found - stage.methods().begin());
}

std::string zoom_row(const Stage& stage, double distance, int rounds) {
  const View view = stage.view(distance);
  std::vector<DrawFrame> candidates;
  for (const StagedMethod& method : stage.methods())
    candidates.emplace_back([&method, &view] { method.frames().draw(view); });
  const WallAndCpu times = side_by_side(stage.context().info(), candidates, rounds);
  std::string text = fmt::format("{:<10g}", distance);
  for (const std::vector<double>& cpu : times.cpu) {
    text += fmt::format(" {:>44}", fmt::format("{:.1f} ms, {:.2f} x direct", quantile(cpu, 0.5),
                                               quantile(paired_ratios(cpu, times.cpu[index_of_direct(stage)]), 0.5)));
  }
  return text + "\n";
}

}  // namespace

std::string zoom_table(Scene scene, const std::string& methods, const std::vector<double>& distances, int rounds) {
  const Stage stage(std::move(scene), bench_settings(methods), no_progress);
  std::string text = fmt::format("{:<10}", "distance");
  for (const StagedMethod& method : stage.methods()) text += fmt::format(" {:>44}", method.baked().spec.text);
  text += "\n";
  for (const double distance : distances) text += zoom_row(stage, distance, rounds);
  stage.context().check("timing frames over a zoom");
  return text;
}

}  // namespace footprint::bench
