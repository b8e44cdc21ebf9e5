// The material that the NDF inspector looks into: of a normal map alone, or of a scene.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "experiments/studies/ndf_inspection.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/names.hpp"
#include "renderer/scene/assembly/load_scene.hpp"
#include "renderer/scene/assembly/surface_maps.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 3> scene_extensions{".toml", ".gltf", ".glb"};
constexpr std::array<std::string_view, 10> map_extensions{".exr",  ".png", ".jpg",  ".jpeg", ".tif",
                                                          ".tiff", ".bmp", ".webp", ".hdr",  ".tga"};
constexpr double default_exponent = 64.0;

// By its extension, or because it is a file and not a scene.
bool names_a_map(const std::string& path) {
  const std::string extension = lower_extension(path);
  if (std::ranges::find(map_extensions, extension) != map_extensions.end()) return true;
  std::error_code ignored;
  return fs::is_regular_file(path, ignored) && std::ranges::find(scene_extensions, extension) == scene_extensions.end();
}

NdfSource load_map(const std::string& path) {
  NdfSource source{path, true, {}, {}};
  source.material.name = fs::path(path).stem().string();
  source.material.brdf = {NormalDistribution::blinn_phong, GeometryTerm::none, FresnelTerm::none, false};
  source.material.normal_map = {
      fs::path(path).filename().string(), read_normal_map(path, 1.0, NormalChannels::xyz, source.notes), {}};
  source.material = with_lobe(std::move(source.material), {NormalDistribution::blinn_phong, default_exponent});
  return source;
}

std::vector<std::string> material_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const Material& material : scene.materials) names.push_back(material.name);
  return names;
}

std::size_t material_index(const Scene& scene, const std::string& wanted) {
  const std::vector<std::string> names = material_names(scene);
  if (wanted.empty() && names.size() == 1) return 0;
  if (wanted.empty()) {
    throw Error(ErrorKind::usage, scene.source, fmt::format("it has {} materials", names.size()),
                fmt::format("name one with --material: {}, or a number from 0", fmt::join(names, ", ")));
  }
  if (const auto found = find_entry(wanted, names)) return *found;
  throw Error(ErrorKind::usage, "--material", fmt::format("{} has no material `{}`", scene.source, wanted),
              suggestion(wanted, names));
}

}  // namespace

Material with_lobe(Material material, const Lobe& lobe) {
  material.brdf.distribution = lobe.distribution;
  material.lobes.clear();
  material.lobe_parameter = static_cast<float>(lobe.parameter);
  return material;
}

NdfSource load_ndf_source(const std::string& path, const std::string& material, const SceneLibrary& library) {
  if (names_a_map(path)) {
    if (material.empty()) return load_map(path);
    throw Error(ErrorKind::usage, "--material", fmt::format("{} is a map and has no materials", path), "leave it out");
  }
  const Scene scene = load_scene(path, library);
  NdfSource source{path, false, scene.materials.at(material_index(scene, material)), scene.warnings};
  if (source.material.layer_map) source.notes.emplace_back("the detail layer is left out: one normal map is inspected");
  return source;
}

}  // namespace footprint
