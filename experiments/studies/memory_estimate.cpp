// Adds up texels: a mip chain has four thirds of its finest level's.
#include "experiments/studies/memory_estimate.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

namespace footprint {
namespace {

constexpr std::uint64_t float_bytes = sizeof(float);

std::uint64_t texels_of(const std::optional<TextureMap>& map) { return map ? map->image.texel_count() : 0; }

std::uint64_t chain_bytes(std::uint64_t texels, std::uint64_t channels) {
  return texels * channels * float_bytes * 4 / 3;
}

// What is made of a normal map while its chain is: a copy of it, its levels, and these as they are uploaded.
constexpr std::uint64_t copies_in_a_bake = 3;

// What a method keeps lies in memory twice before it is on the GPU: as it is baked, and as it is written to the cache
// or handed to the driver.
constexpr std::uint64_t copies_of_what_is_baked = 2;

// Of normals: the moments of slope take five, the mean normal three (bake_slopes).
constexpr int channels_kept_by_lean = 8;

// What lies on the GPU of a material's maps, once for all materials that are looked up in the same ones.
class OnGpu {
 public:
  explicit OnGpu(std::span<const std::optional<int>> normal_chain_channels)
      : normal_chain_channels_(normal_chain_channels) {}

  void add(const Material& m, const EffectSet& effects, MemoryEstimate& out) {
    if (has(effects, Effect::base_color_variation)) out.shared += chain_bytes(added("color", m.base_color_map), 4);
    if (has(effects, Effect::metallic_variation))
      out.shared += chain_bytes(added("metal", m.metallic_roughness_map), 1);
    if (has(effects, Effect::specular_variation)) out.shared += chain_bytes(added("specular", m.specular_map), 3);
    const auto& width = texels_of(m.metallic_roughness_map) >= texels_of(m.lobe_parameter_map)
                            ? m.metallic_roughness_map
                            : m.lobe_parameter_map;
    const std::optional<TextureMap> none;
    const auto& normals = has(effects, Effect::normal_variation) ? m.normal_map : none;
    const auto& widths = has(effects, Effect::roughness_variation) ? width : none;
    out.reference += (4 * added("facets", normals) + added("widths", widths)) * float_bytes;
    // What is prefiltered of normals knows the widths beside them.
    if (!pairs_.emplace(image_of(normals), image_of(widths)).second) return;
    for (std::size_t i = 0; i < out.methods.size(); ++i) {
      const auto channels = static_cast<std::uint64_t>(normal_chain_channels_[i].value_or(channels_kept_by_lean));
      out.methods[i] += chain_bytes(texels_of(normals), channels) + chain_bytes(texels_of(widths), 1);
      out.bake = std::max(out.bake, copies_of_what_is_baked * chain_bytes(texels_of(normals), channels));
    }
  }

 private:
  static MapTexels image_of(const std::optional<TextureMap>& map) { return map ? map->image : MapTexels(); }

  // Texels of a map that has no such use yet.
  std::uint64_t added(std::string_view use, const std::optional<TextureMap>& map) {
    return map && uses_.emplace(use, map->image).second ? texels_of(map) : 0;
  }

  std::span<const std::optional<int>> normal_chain_channels_;
  std::set<std::pair<std::string_view, MapTexels>> uses_;
  std::set<std::pair<MapTexels, MapTexels>> pairs_;
};

}  // namespace

MemoryEstimate estimate_memory(const Scene& scene, const EffectSet& effects,
                               std::span<const std::optional<int>> normal_chain_channels) {
  MemoryEstimate out;
  out.methods.resize(normal_chain_channels.size());
  std::set<MapTexels> counted;
  OnGpu on_gpu(normal_chain_channels);
  for (const Material& m : scene.materials) {
    for (const auto* map : {&m.base_color_map, &m.metallic_roughness_map, &m.lobe_parameter_map, &m.specular_map,
                            &m.normal_map, &m.layer_map}) {
      if (!*map || !counted.insert((*map)->image).second) continue;
      const MapTexels& texels = (*map)->image;
      out.maps += texels.texel_count() * static_cast<std::uint64_t>(texels.channels()) * float_bytes;
      out.kept += texels.byte_count();
    }
    on_gpu.add(m, effects, out);
    const std::uint64_t normals = has(effects, Effect::normal_variation) ? texels_of(m.normal_map) : 0;
    out.bake = std::max(out.bake, copies_in_a_bake * chain_bytes(std::max(normals, texels_of(m.base_color_map)), 4));
    out.upload = std::max(out.upload, 4 * normals * float_bytes);
  }
  return out;
}

}  // namespace footprint
