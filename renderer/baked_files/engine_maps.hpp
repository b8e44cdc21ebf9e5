// The maps that an engine's importer makes of a material, for methods that stand for one: roughness mips with the
// normals' spread in them, and the normals beside them.
#pragma once

#include <string>
#include <vector>

#include "renderer/bake/baked_method.hpp"
#include "renderer/baked_files/gltf_copy.hpp"

namespace footprint {

/// Those of one material.
struct EngineMaps {
  std::vector<PrefilteredTexture> textures;  ///< `engine_normal` and `engine_roughness`, 8 bits; empty: there are none
  std::string missing;                       ///< why, where the method has such maps and the material cannot
};

/// What `Method::roughness_mips` says of a material, beside its mean normals, renormalised, (n + 1) / 2.
[[nodiscard]] EngineMaps engine_maps(const BakedMethod& baked, const Material& material);

/// Level `level` of them (the coarsest, where there are fewer) for a copy of the model whose maps are that small, with
/// the material's metallic beside the roughness. `mips` as ReplacedMaps::roughness_mips. The maps are those of
/// engine_maps, which are there.
[[nodiscard]] ReplacedMaps replaced_maps(const EngineMaps& maps, const Material& material, int level,
                                         std::vector<std::string> mips);

}  // namespace footprint
