// Bakes one after the other, without a disk cache, whose memory is what the system has counted; footprints of one plane
// and one bake, where the camera's width alone changes from row to row.
#include "bench/benchmarks.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <limits>
#include <vector>

#include "app/folders.hpp"
#include "experiments/studies/stage.hpp"
#include "methods/registry.hpp"
#include "renderer/core/disk_cache.hpp"
#include "renderer/core/error.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/gl/functions.hpp"
#include "renderer/pipeline/frame.hpp"
#include "renderer/pipeline/timing.hpp"
#include "renderer/scene/camera.hpp"
#include "scenes/surfaces/registry.hpp"

namespace footprint::bench {
namespace {

// The peak memory of the process so far, in units of 1e9 bytes.
double most_gigabytes() {
  rusage usage{};
  (void)getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024e-9;  // Linux counts kibibytes
}

struct Bake {
  double seconds = std::numeric_limits<double>::infinity();
  double cpu_seconds = 0.0;
  std::size_t bytes = 0;
};

Bake quickest(const MethodSpec& spec, const Scene& scene, const EffectSet& effects, int rounds) {
  Bake best;
  for (int i = 0; i < rounds; ++i) {
    const std::clock_t cpu = std::clock();
    const auto start = std::chrono::steady_clock::now();
    const std::size_t bytes = bake(find_method(spec), spec, scene, effects, no_progress).bytes;
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (seconds < best.seconds) best = {seconds, static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC, bytes};
  }
  return best;
}

void check_limit(const std::string& name, double value, double most, const char* unit) {
  if (most <= 0.0 || value <= most) return;
  throw Error(ErrorKind::check, name, fmt::format("its bake took {:.3g} {}, {:.3g} are allowed", value, unit, most));
}

constexpr const char* surface_name = "scratched_metal";
constexpr glm::ivec2 frame_pixels{512, 512};

// A plane of so many maps per side, one per metre, under a camera and a light that are infinitely far. The map is
// rotated, so that no footprint ends at the border of a tree's node.
Scene repeated_map(int resolution, int maps) {
  Scene scene = load_bench_scene("scratches").value();
  const Surface& surface = find_surface(all_surfaces(), surface_name);
  SurfaceSettings settings = surface_settings(surface, {});
  settings.resolution = resolution;
  Material& material = scene.materials.at(0);
  material.normal_map.value().image = std::make_shared<const Image>(surface_normals(surface, settings));
  material.normal_map->coordinates.wrap = {Wrap::repeat, Wrap::repeat};
  const auto half = 0.5F * static_cast<float>(maps);
  Mesh& mesh = scene.meshes.at(0);
  mesh.vertices.clear();
  for (const glm::vec2 corner : {glm::vec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
    Vertex vertex;
    vertex.position = glm::vec3(half * corner, 0.0F);
    vertex.normal = {0.0F, 0.0F, 1.0F};
    vertex.tangent = {1.0F, 0.0F, 0.0F, 1.0F};
    vertex.uv0 = vertex.uv1 =
        half * glm::vec2(0.96F * corner.x - 0.28F * corner.y, 0.28F * corner.x + 0.96F * corner.y);
    mesh.vertices.push_back(vertex);
  }
  mesh.indices = {0, 1, 2, 0, 2, 3};
  scene.lights = {
      DirectionalLight{.direction = glm::normalize(glm::vec3(-0.1F, 0.05F, -1.0F)), .illuminance = glm::vec3(1.0F)}};
  scene.bounds = {glm::vec3(-half, -half, 0.0F), glm::vec3(half, half, 0.0F)};
  scene.camera.orthographic = true;
  scene.camera.zfar = 20.0F;
  scene.camera.world = look_at({0.0, 0.0, 10.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
  return scene;
}

// The times and lookups of a method, by width of the camera.
struct Figures {
  std::vector<double> ms, lookups;
};

void add_figures(const Stage& stage, const View& view, int repeats, std::vector<Figures>& figures) {
  RepeatedTimes times(stage.methods().size());  // CPU time, which other load on the machine hardly moves
  std::vector<DrawFrame> candidates;
  for (std::size_t i = 0; i < times.size(); ++i) {
    candidates.emplace_back([&, i] {
      const std::clock_t start = std::clock();
      stage.methods()[i].frames().draw(view);
      gl::api().Finish();
      times[i].push_back(1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    });
  }
  (void)interleaved_times(stage.context().info(), candidates, repeats, no_progress);
  for (std::size_t i = 0; i < times.size(); ++i) {
    times[i].erase(times[i].begin(), times[i].end() - repeats);  // rounds that warm up
    figures[i].ms.push_back(quantile(times[i], 0.5));
    figures[i].lookups.push_back(pixel_work(stage.counting_frames(stage.methods()[i], Counting::work), view).lookups);
  }
}

// The greatest of some figures over their median.
double over_median(const std::vector<double>& figures) {
  return *std::ranges::max_element(figures) / quantile(figures, 0.5);
}

}  // namespace

void print_bake_table(const Scene& scene, const std::string& methods, int rounds, const BakeLimits& limits) {
  const EffectSet effects = effects_on(derive_effects(scene));
  std::string text = fmt::format("{:<44} {:>10} {:>10} {:>10} {:>10}\n", "bake", "wall, s", "CPU, s", "MB", "peak, GB");
  for (const MethodSpec& spec : parse_methods(methods)) {
    const Bake best = quickest(spec, scene, effects, rounds);
    const double gigabytes = most_gigabytes();
    fmt::print("{}{:<44} {:>10.2f} {:>10.2f} {:>10.1f} {:>10.2f}\n", text, spec.text, best.seconds, best.cpu_seconds,
               static_cast<double>(best.bytes) * 1e-6, gigabytes);
    (void)std::fflush(stdout);
    text.clear();
    check_limit(spec.text, best.seconds, limits.seconds, "s");
    check_limit(spec.text, gigabytes, limits.gigabytes, "GB");
  }
}

RunSettings bench_settings(const std::string& methods) {
  RunSettings settings;
  settings.view.size = frame_pixels;
  settings.cache = default_cache_folder();
  settings.methods = parse_methods(methods);
  if (std::ranges::find(settings.methods, "direct", &MethodSpec::text) == settings.methods.end())
    settings.methods.insert(settings.methods.begin(), {.text = "direct", .name = "direct", .options = {}});
  return settings;
}

void print_footprint_sizes(const std::string& methods, int resolution, int repeats, double most_ratio) {
  const RunSettings settings = bench_settings(methods);
  const Stage stage(repeated_map(resolution, frame_pixels.x + 1), settings, no_progress);
  fmt::print("{:<10}", "texels");
  for (const StagedMethod& method : stage.methods()) fmt::print(" {:>44}", method.baked().spec.text);
  std::vector<Figures> figures(stage.methods().size());
  for (int texels = 1; texels <= resolution; texels *= 2) {
    View view = stage.view(1.0);
    view.camera.ymag = 0.5F * static_cast<float>(view.size.y * texels) / static_cast<float>(resolution);
    add_figures(stage, view, repeats, figures);
    fmt::print("\n{:<10}", fmt::format("{}^2", texels));
    for (const auto& [ms, lookups] : figures)
      fmt::print(" {:>44}", fmt::format("{:.1f} ms, {:.1f} lookups", ms.back(), lookups.back()));
    (void)std::fflush(stdout);
  }
  fmt::print("\n{:<10}", "greatest");
  for (const auto& [ms, lookups] : figures)
    fmt::print(" {:>44}", fmt::format("{:.2f}, {:.2f} of the median", over_median(ms), over_median(lookups)));
  fmt::print("\n");
  for (std::size_t i = 0; i < figures.size(); ++i) {
    const double ratio = over_median(figures[i].ms);
    if (most_ratio > 0.0 && ratio > most_ratio)
      throw Error(ErrorKind::check, stage.methods()[i].baked().spec.text,
                  fmt::format("its most expensive footprint takes {:.3g} times the median, {:.3g} are allowed", ratio,
                              most_ratio));
  }
}

}  // namespace footprint::bench
