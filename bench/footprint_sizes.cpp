// One plane, one bake; the camera's width alone changes from row to row.
#include "bench/benchmarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "bench/bench_scene.hpp"
#include "renderer/core/error.hpp"
#include "renderer/pipeline/frame.hpp"
#include "renderer/scene/camera.hpp"
#include "scenes/surfaces/registry.hpp"

namespace footprint::bench {
namespace {

constexpr const char* surface_name = "scratched_metal";

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

// The times and lookups of the methods at one width of the camera.
struct Row {
  std::vector<double> ms, lookups;
};

Row row_at(const Stage& stage, const View& view, int repeats) {
  std::vector<DrawFrame> candidates;
  for (const StagedMethod& method : stage.methods())
    candidates.emplace_back([&method, &view] { method.frames().draw(view); });
  const WallAndCpu times = side_by_side(stage.context().info(), candidates, repeats);
  Row row;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    row.ms.push_back(quantile(times.cpu[i], 0.5));
    row.lookups.push_back(pixel_work(stage.counting_frames(stage.methods()[i], Counting::work), view).lookups);
  }
  return row;
}

// The greatest of some figures over their median.
double over_median(const std::vector<double>& figures) {
  return *std::ranges::max_element(figures) / quantile(figures, 0.5);
}

}  // namespace

void print_footprint_sizes(const std::string& methods, int resolution, int repeats, double most_ratio) {
  const RunSettings settings = bench_settings(methods);
  const Stage stage(repeated_map(resolution, frame_pixels.x + 1), settings, no_progress);
  fmt::print("{:<10}", "texels");
  for (const StagedMethod& method : stage.methods()) fmt::print(" {:>44}", method.baked().spec.text);
  std::vector<std::vector<double>> ms(stage.methods().size()), lookups(stage.methods().size());
  for (int texels = 1; texels <= resolution; texels *= 2) {
    View view = stage.view(1.0);
    view.camera.ymag = 0.5F * static_cast<float>(view.size.y * texels) / static_cast<float>(resolution);
    const Row row = row_at(stage, view, repeats);
    fmt::print("\n{:<10}", fmt::format("{}^2", texels));
    for (std::size_t i = 0; i < row.ms.size(); ++i) {
      fmt::print(" {:>44}", fmt::format("{:.1f} ms, {:.1f} lookups", row.ms[i], row.lookups[i]));
      ms[i].push_back(row.ms[i]);
      lookups[i].push_back(row.lookups[i]);
    }
    (void)std::fflush(stdout);
  }
  fmt::print("\n{:<10}", "greatest");
  for (std::size_t i = 0; i < ms.size(); ++i)
    fmt::print(" {:>44}", fmt::format("{:.2f}, {:.2f} of the median", over_median(ms[i]), over_median(lookups[i])));
  fmt::print("\n");
  for (std::size_t i = 0; i < ms.size(); ++i) {
    if (most_ratio <= 0.0 || over_median(ms[i]) <= most_ratio) continue;
    throw Error(ErrorKind::check, stage.methods()[i].baked().spec.text,
                fmt::format("its most expensive footprint takes {:.3g} times the median, {:.3g} are allowed",
                            over_median(ms[i]), most_ratio));
  }
}

}  // namespace footprint::bench
