// A method's precompute over a whole scene, from the disk where it is kept there.
#pragma once

#include <functional>
#include <set>
#include <utility>
#include <vector>

#include "renderer/bake/bake_cache.hpp"
#include "renderer/bake/method.hpp"

namespace footprint {

/// A method's precompute for every material of a scene, with what it cost.
struct BakedMethod {
  const Method* method = nullptr;
  MethodSpec spec;
  Options options;
  std::vector<Prefiltered> materials;  ///< one for each material of the scene
  /// Material and number of each texture whose texels a material before it has: on the GPU they lie once.
  std::set<std::pair<std::size_t, std::size_t>> shared;
  double seconds = 0;
  std::size_t bytes = 0;   ///< as stored on the GPU: texels that several materials have count once
  std::size_t texels = 0;  ///< of the finest levels, over all materials (`finest_texels`)
  bool cached = false;     ///< every material came from the disk: `seconds` is what reading took
};

/// Called when a material is baked, with its number; it may free the texels.
using MaterialBaked = std::function<void(std::size_t)>;

/// The options of `spec`, checked against the method's table, with defaults. Errors (usage): an unknown option, or a
/// value out of range.
[[nodiscard]] Options options_of(const Method& method, const MethodSpec& spec);

/// A method with its options, and nothing baked yet. Errors (usage): those of options_of.
[[nodiscard]] BakedMethod unbaked(const Method& method, const MethodSpec& spec);

/// Runs the precompute of `baked` for one material after the other, as `bake` does. Seconds are those of the precompute
/// alone.
void bake_materials(BakedMethod& baked, const Scene& scene, const EffectSet& effects, const Progress& progress,
                    const BakeCache* cache, const MaterialBaked& when_baked);

/// Runs the precompute of `spec` for every material, or reads it from `cache` where that is given and has it.
/// `effects` are the scene's; the method gets those that it honours.
[[nodiscard]] BakedMethod bake(const Method& method, const MethodSpec& spec, const Scene& scene,
                               const EffectSet& effects, const Progress& progress, const BakeCache* cache = nullptr);

}  // namespace footprint
