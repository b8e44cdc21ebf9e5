// Adds up texels: a mip chain has four thirds of its finest level's.
#include "experiments/studies/memory_estimate.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
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

// What is made of a shared map while its chain is: a copy of it, its levels, and these as they are uploaded.
constexpr std::uint64_t copies_in_a_bake = 3;

// Of normals: the moments of slope take five, the mean normal three (bake_slopes).
constexpr int channels_kept_by_lean = 8;

BakeMemory as_lean(const Material& material) {
  const std::uint64_t kept = chain_bytes(texels_of(material.normal_map), channels_kept_by_lean);
  return {.kept = kept, .baking = 2 * kept};
}

// What lies on the GPU of a material's maps, once for all materials that are looked up in the same ones.
class OnGpu {
 public:
  explicit OnGpu(std::span<const NormalMemory> methods) : methods_(methods) {}

  void add(const Material& m, const EffectSet& effects, MemoryEstimate& out) {
    if (has(effects, Effect::base_color_variation)) out.shared += chain_bytes(added("color", m.base_color_map), 4);
    if (has(effects, Effect::metallic_variation))
      out.shared += chain_bytes(added("metal", m.metallic_roughness_map), 1);
    if (has(effects, Effect::specular_variation)) out.shared += chain_bytes(added("specular", m.specular_map), 3);
    if (m.coat) {
      if (has(effects, Effect::coat_weight_variation))
        out.shared += chain_bytes(added("coat weight", m.coat->weight_map), 1);
      if (has(effects, Effect::coat_width_variation))
        out.shared += chain_bytes(added("coat width", m.coat->roughness_map), 1);
      if (has(effects, Effect::coat_normal_variation))
        out.shared += chain_bytes(added("coat normals", m.coat->normal_map), 3);
    }
    const auto& width = texels_of(m.metallic_roughness_map) >= texels_of(m.lobe_parameter_map)
                            ? m.metallic_roughness_map
                            : m.lobe_parameter_map;
    const std::optional<TextureMap> none;
    const auto& normals = has(effects, Effect::normal_variation) ? m.normal_map : none;
    const auto& widths = has(effects, Effect::roughness_variation) ? width : none;
    out.reference += (4 * added("facets", normals) + added("widths", widths)) * float_bytes;
    // What is prefiltered of normals knows the widths beside them.
    if (!pairs_.emplace(image_of(normals), image_of(widths)).second) return;
    const std::uint64_t width_chain = chain_bytes(texels_of(widths), 1);
    for (std::size_t i = 0; i < out.methods.size(); ++i) {
      const BakeMemory own = normals ? methods_[i](m).value_or(as_lean(m)) : BakeMemory{};
      // What earlier materials left is there already.
      out.methods[i].baking = std::max(out.methods[i].baking, out.methods[i].kept + own.baking + 2 * width_chain);
      out.methods[i].kept += own.kept + width_chain;
    }
  }

 private:
  static MapTexels image_of(const std::optional<TextureMap>& map) { return map ? map->image : MapTexels(); }

  // Texels of a map that has no such use yet.
  std::uint64_t added(std::string_view use, const std::optional<TextureMap>& map) {
    return map && uses_.emplace(use, map->image).second ? texels_of(map) : 0;
  }

  std::span<const NormalMemory> methods_;
  std::set<std::pair<std::string_view, MapTexels>> uses_;
  std::set<std::pair<MapTexels, MapTexels>> pairs_;
};

}  // namespace

std::vector<std::size_t> MemoryEstimate::bake_order() const {
  std::vector<std::size_t> order(methods.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater{}, [&](std::size_t i) { return methods[i].baking - methods[i].kept; });
  return order;
}

std::uint64_t MemoryEstimate::peak() const {
  std::uint64_t most = shared + shared_bake;
  std::uint64_t there = shared;
  for (const std::size_t i : bake_order()) {
    most = std::max(most, there + methods[i].baking);
    there += methods[i].kept;
  }
  return kept + std::max(most, there + reference + upload);
}

MemoryEstimate estimate_memory(const Scene& scene, const EffectSet& effects, std::span<const NormalMemory> methods) {
  MemoryEstimate out;
  out.methods.resize(methods.size());
  std::set<MapTexels> counted;
  OnGpu on_gpu(methods);
  for (const Material& m : scene.materials) {
    for (const TextureMap* map : maps_of(m)) {
      const MapTexels& texels = map->image;
      if (!counted.insert(texels).second) continue;
      out.maps += texels.texel_count() * static_cast<std::uint64_t>(texels.channels()) * float_bytes;
      out.kept += texels.byte_count();
    }
    on_gpu.add(m, effects, out);
    const std::uint64_t normals = has(effects, Effect::normal_variation) ? texels_of(m.normal_map) : 0;
    if (has(effects, Effect::base_color_variation))
      out.shared_bake = std::max(out.shared_bake, copies_in_a_bake * chain_bytes(texels_of(m.base_color_map), 4));
    if (m.coat && has(effects, Effect::coat_normal_variation))
      out.shared_bake = std::max(out.shared_bake, copies_in_a_bake * chain_bytes(texels_of(m.coat->normal_map), 4));
    out.upload = std::max(out.upload, 4 * normals * float_bytes);
  }
  return out;
}

}  // namespace footprint
