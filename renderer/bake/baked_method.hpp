// Bakes a method for all materials of a scene, or reads bakes from the cache.
#pragma once

#include <functional>
#include <set>
#include <utility>
#include <vector>

#include "renderer/bake/bake_cache.hpp"
#include "renderer/bake/method.hpp"

namespace footprint {

/// A method's bakes for every material of a scene, with their cost.
struct BakedMethod {
  const Method* method = nullptr;
  MethodSpec spec;
  Options options;
  std::vector<Prefiltered> materials;  ///< one for each material of the scene
  /// Material and index of each texture whose texels equal those of an earlier material, so that they are on the GPU
  /// once.
  std::set<std::pair<std::size_t, std::size_t>> shared;
  double seconds = 0;
  std::size_t bytes = 0;   ///< on the GPU; texels that several materials share count once
  std::size_t texels = 0;  ///< of the finest levels of all materials (`finest_texels`)
  bool cached = false;     ///< all materials were cached: `seconds` is the time of reading
};

/// Called after a material is baked, with its index; it may free the texels.
using MaterialBaked = std::function<void(std::size_t)>;

/// The options of `spec`, checked against the method's table, with defaults. Errors (usage): an unknown option, or a
/// value out of range.
[[nodiscard]] Options options_of(const Method& method, const MethodSpec& spec);

/// A method with its options, without bakes. Errors (usage): those of options_of.
[[nodiscard]] BakedMethod unbaked(const Method& method, const MethodSpec& spec);

/// Bakes the materials one by one, as `bake` does. Seconds are those of the precompute only.
void bake_materials(BakedMethod& baked, const Scene& scene, const EffectSet& effects, const Progress& progress,
                    const BakeCache* cache, const MaterialBaked& when_baked);

/// Bakes every material by `spec`, or reads it from `cache` if it is there. `effects` are the scene's; the method
/// receives those that it honours.
[[nodiscard]] BakedMethod bake(const Method& method, const MethodSpec& spec, const Scene& scene,
                               const EffectSet& effects, const Progress& progress, const BakeCache* cache = nullptr);

}  // namespace footprint
