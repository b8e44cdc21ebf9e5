// A bake as files for other programs: EXR, KTX2 and PNG maps, GLSL, and a manifest.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "renderer/bake/baked_method.hpp"
#include "renderer/baked_files/gltf_copy.hpp"
#include "renderer/scene/footprint_filter.hpp"
#include "renderer/scene/scene.hpp"

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

/// What is to be written.
struct BakeToFiles {
  const Scene& scene;
  const BakedMethod& baked;          ///< of that scene, for `effects`
  EffectSet effects;                 ///< of the scene
  FootprintFilter footprint;         ///< that the module looks maps up by
  std::string version;               ///< of the program, for the manifest
  std::vector<EngineMaps> engine{};  ///< for each material, or for none
};

/// The files of one texture, as paths from the output folder.
struct TextureFiles {
  std::vector<std::string> exr;  ///< one; of an array one per layer
  std::string ktx2;
  std::vector<std::string> png;  ///< one per level, of an array layer after layer; empty where 8 bits do not hold it
};

/// Those of one material.
struct MaterialFiles {
  std::string folder;
  std::vector<TextureFiles> textures;     ///< in the order of Prefiltered::textures
  std::vector<TextureFiles> imports;      ///< of EngineMaps::textures
  std::optional<std::string> bumpslopes;  ///< moments of slope as OpenImageIO lays them out; none: there are none
};

/// Where everything lies, as paths from the output folder.
struct BakeListing {
  std::string module;                    ///< the GLSL
  std::vector<MaterialFiles> materials;  ///< in the order of the scene
};

/// The names of the files that `bake` gets.
[[nodiscard]] BakeListing list_bake(const BakeToFiles& bake);

/// Refuses, before anything is written, what would leave no files that another program could draw by. Throws Error
/// (usage): the method has no texture for this scene. What a frame build fills must have been taken (take_built_maps).
void require_files(const BakeToFiles& bake);

/// Writes all of them and manifest.json into `folder`, which exists. Equal bakes give equal bytes. Throws those of
/// require_files; (machine): a file cannot be written.
void write_bake(const BakeToFiles& bake, const std::filesystem::path& folder);

/// The GLSL that reads the maps, with its contract in front.
[[nodiscard]] std::string module_text(const BakeToFiles& bake);

/// The document, "schema": "footprint-bake/1"; pretty-printed, key order fixed. Nothing in it depends on when or how
/// fast the bake was made.
[[nodiscard]] std::string manifest_json(const BakeToFiles& bake, const BakeListing& listing);

}  // namespace footprint
