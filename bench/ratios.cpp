// Draws the pairs in turn and prints the quantiles of their ratios, by wall clock and by CPU time. CPU time is counted
// around each drawing and its glFinish, wall time by interleaved_times, whose warm-up is dropped.
#include "bench/benchmarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "renderer/gl/functions.hpp"

namespace footprint::bench {
namespace {

std::string row(const std::string& name, const std::vector<double>& a, const std::vector<double>& b) {
  const std::vector<double> ratios = paired_ratios(a, b);
  return fmt::format("{:<28} {:>8.3f} {:>8.3f} {:>8.3f} {:>8.3f} {:>8.3f} {:>11.3f} {:>11.3f}\n", name,
                     quantile(ratios, 0.5), quantile(ratios, 0.0), quantile(ratios, 0.1), quantile(ratios, 0.9),
                     quantile(ratios, 1.0), quantile(a, 0.5), quantile(b, 0.5));
}

std::string rows(const std::string& name, const WallAndCpu& times, std::size_t a, std::size_t b) {
  return row(name + ", wall", times.wall[a], times.wall[b]) + row(name + ", cpu", times.cpu[a], times.cpu[b]);
}

// The bare shader first, then the methods in the order of the registry.
std::string frame_rows(const BenchScene& scene, const std::string& over, int repeats) {
  std::vector<DrawFrame> candidates{[&scene] { scene.draw_bare(); }};
  std::size_t direct = 0;
  std::size_t base = 0;
  for (const StagedMethod& method : scene.stage().methods()) {
    if (&method == &scene.method("direct")) direct = candidates.size();
    if (&method == &scene.method(over)) base = candidates.size();
    candidates.emplace_back([&scene, &method] { scene.draw(method); });
  }
  const WallAndCpu times = side_by_side(scene.stage().context().info(), candidates, repeats);
  std::string text = rows("direct / bare", times, direct, 0);
  for (std::size_t i = 1; i < candidates.size(); ++i) {
    if (i == base) continue;
    text += rows(fmt::format("{} / {}", scene.stage().methods()[i - 1].baked().spec.text, over), times, i, base);
  }
  return text;
}

std::string reference_rows(const BenchScene& scene, int repeats) {
  const StagedMethod& direct = scene.method("direct");
  const std::vector<DrawFrame> candidates{[&scene] { scene.draw_reference(); },
                                          [&scene, &direct] {
                                            for (int i = 0; i < reference_spp; ++i) scene.draw(direct);
                                          }};
  return rows(fmt::format("reference / {} direct", reference_spp),
              side_by_side(scene.stage().context().info(), candidates, repeats), 0, 1);
}

}  // namespace

WallAndCpu side_by_side(const gl::ContextInfo& context, std::span<const DrawFrame> candidates, int repeats) {
  WallAndCpu times;
  times.cpu.resize(candidates.size());
  std::vector<DrawFrame> measured;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    measured.emplace_back([&, i] {
      const std::clock_t start = std::clock();
      candidates[i]();
      gl::api().Finish();
      times.cpu[i].push_back(1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    });
  }
  times.wall = interleaved_times(context, measured, repeats, no_progress);
  for (std::vector<double>& cpu : times.cpu) cpu.erase(cpu.begin(), cpu.end() - repeats);  // rounds that warm up
  return times;
}

std::string ratio_table(const BenchScene& scene, const std::string& over, int repeats) {
  std::string text = fmt::format("{:<28} {:>8} {:>8} {:>8} {:>8} {:>8} {:>11} {:>11}\n", "a / b, in the same round",
                                 "median", "min", "p10", "p90", "max", "a, ms", "b, ms");
  text += frame_rows(scene, over, repeats) + reference_rows(scene, std::max(5, repeats / 10));
  scene.stage().context().check("timing frames");
  return text;
}

}  // namespace footprint::bench
