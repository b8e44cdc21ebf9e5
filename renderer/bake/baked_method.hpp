// A method's precompute over a whole scene, from the disk where it is kept there.
#pragma once

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
  double seconds = 0;
  std::size_t bytes = 0;
  std::size_t texels = 0;  ///< of the finest levels, over all materials (`finest_texels`)
  bool cached = false;     ///< every material came from the disk: `seconds` is what reading took
};

/// Runs the precompute of `spec` for every material, or reads it from `cache` where that is given and has it.
/// `effects` are the scene's; the method gets those that it honours.
[[nodiscard]] BakedMethod bake(const Method& method, const MethodSpec& spec, const Scene& scene,
                               const EffectSet& effects, const Progress& progress, const BakeCache* cache = nullptr);

}  // namespace footprint
