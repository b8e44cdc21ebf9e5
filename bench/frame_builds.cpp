// At each map size, builds and frames are drawn in turn with a frame of `direct` and a few samples of the reference.
#include "bench/frame_builds.hpp"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <vector>

#include "bench/bench_scene.hpp"
#include "bench/side_by_side.hpp"
#include "renderer/core/error.hpp"
#include "scenes/surfaces/registry.hpp"

namespace footprint::bench {
namespace {

constexpr int few_spp = 16;
constexpr const char* built_surface = "bumps";

Scene scene_with_map(int resolution) {
  Scene scene = load_bench_scene(built_surface).value();
  const Surface& surface = find_surface(all_surfaces(), built_surface);
  SurfaceSettings settings = surface_settings(surface, {});
  settings.resolution = resolution;
  scene.materials.at(0).normal_map.value().image = std::make_shared<const Image>(surface_normals(surface, settings));
  return scene;
}

// Medians of the rounds: of ratios pair by pair.
double over(const WallAndCpu& times, std::size_t a, std::size_t b) {
  return quantile(paired_ratios(times.cpu[a], times.cpu[b]), 0.5);
}

std::string rows_for(int resolution, const std::string& methods, int repeats) {
  const BenchScene scene(scene_with_map(resolution), bench_settings(methods));
  const View& view = scene.view();
  std::vector<DrawFrame> candidates{[&] { scene.draw(scene.method("direct")); },
                                    [&] { scene.stage().reference().draw(view, few_spp, reference_seed); }};
  std::vector<const StagedMethod*> building;
  for (const StagedMethod& method : scene.stage().methods()) {
    if (!method.gpu().has_frame_build()) continue;
    if (!method.gpu().keeps_builds())
      throw Error(ErrorKind::usage, "--methods", method.baked().spec.text + " builds in every frame",
                  "give it rebuild=changed, so that building and shading are timed apart");
    building.push_back(&method);
    candidates.emplace_back([&method, &view] { method.gpu().rebuild(view); });
    candidates.emplace_back([&scene, &method] { scene.draw(method); });
  }
  const WallAndCpu times = side_by_side(scene.stage().context().info(), candidates, repeats);
  std::string text;
  for (std::size_t i = 0; i < building.size(); ++i) {
    const std::size_t build = 2 + 2 * i;
    const double ms = quantile(times.cpu[build], 0.5);
    text += fmt::format("{:<44} {:>6} {:>10.1f} {:>10.1f} {:>10.2f} {:>10.2f}\n", building[i]->baked().spec.text,
                        resolution, ms, 1e6 * ms / (static_cast<double>(resolution) * resolution),
                        over(times, build + 1, 0), over(times, build, 1) + over(times, build + 1, 1));
  }
  return text;
}

}  // namespace

std::string frame_build_table(const std::string& methods, int repeats) {
  std::string text = fmt::format("{:<44} {:>6} {:>10} {:>10} {:>10} {:>10}\n", "CPU time", "map", "build, ms",
                                 "ns/texel", "shading", "both");
  for (const int resolution : {512, 1024, 2048}) text += rows_for(resolution, methods, repeats);
  return text +
         fmt::format("shading: over a frame of `direct`; both: build and shading over {} samples per pixel\n", few_spp);
}

}  // namespace footprint::bench
