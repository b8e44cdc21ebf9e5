// See ratios.hpp.
#include "bench/ratios.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "renderer/pipeline/timing.hpp"

namespace footprint::bench {
namespace {

std::string row(const std::string& name, const std::vector<double>& a, const std::vector<double>& b) {
  const std::vector<double> ratios = paired_ratios(a, b);
  return fmt::format("{:<28} {:>8.3f} {:>8.3f} {:>8.3f} {:>8.3f} {:>8.3f} {:>11.3f}\n", name, quantile(ratios, 0.5),
                     quantile(ratios, 0.0), quantile(ratios, 0.1), quantile(ratios, 0.9), quantile(ratios, 1.0),
                     quantile(a, 0.5));
}

// The bare shader first, then the methods in the order of the registry.
std::string frame_rows(const BenchScene& scene, int repeats) {
  std::vector<DrawFrame> candidates{[&] { scene.draw_bare(); }};
  std::size_t direct = 0;
  for (const StagedMethod& method : scene.stage().methods()) {
    if (&method == &scene.method("direct")) direct = candidates.size();
    candidates.emplace_back([&] { scene.draw(method); });
  }
  const auto times = interleaved_times(scene.stage().context().info(), candidates, repeats, no_progress);
  std::string text = row("direct / bare", times[direct], times[0]);
  for (std::size_t i = 1; i < times.size(); ++i) {
    const std::string& name = scene.stage().methods()[i - 1].baked().spec.name;
    if (i != direct) text += row(name + " / direct", times[i], times[direct]);
  }
  return text;
}

std::string reference_row(const BenchScene& scene, int repeats) {
  const StagedMethod& direct = scene.method("direct");
  const std::vector<DrawFrame> candidates{[&] { scene.draw_reference(); },
                                          [&] {
                                            for (int i = 0; i < reference_spp; ++i) scene.draw(direct);
                                          }};
  const auto times = interleaved_times(scene.stage().context().info(), candidates, repeats, no_progress);
  return row(fmt::format("reference / {} direct", reference_spp), times[0], times[1]);
}

}  // namespace

std::string ratio_table(const BenchScene& scene, int repeats) {
  std::string text = fmt::format("{:<28} {:>8} {:>8} {:>8} {:>8} {:>8} {:>11}\n", "frames in the same round", "median",
                                 "min", "p10", "p90", "max", "median ms");
  text += frame_rows(scene, repeats) + reference_row(scene, std::max(5, repeats / 10));
  scene.stage().context().check("timing frames");
  return text;
}

}  // namespace footprint::bench
