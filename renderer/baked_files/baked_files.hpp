// A baked method as a folder of files: every texture with its whole chain, the GLSL module that reads them, and a
// manifest that says what is what (docs/baking.md).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "renderer/bake/baked_method.hpp"
#include "renderer/baked_files/engine_maps.hpp"
#include "renderer/scene/footprint_filter.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint {

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
  std::vector<std::string> exr;  ///< one; of an array one a layer
  std::string ktx2;
  std::vector<std::string> png;  ///< one a level, of an array layer after layer; empty where 8 bits do not hold it
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

/// Refuses, before anything is written, what would leave no files that another program could draw by. Errors (usage):
/// the method has no texture for this scene. What a frame build fills must have been taken (built_maps.hpp).
void require_files(const BakeToFiles& bake);

/// Writes all of them and manifest.json into `folder`, which exists. Equal bakes give equal bytes. Errors: those of
/// require_files; (machine): a file cannot be written.
void write_bake(const BakeToFiles& bake, const std::filesystem::path& folder);

/// The GLSL that reads the maps, with its contract in front.
[[nodiscard]] std::string module_text(const BakeToFiles& bake);

}  // namespace footprint
