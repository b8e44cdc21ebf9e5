// A bake as files for other programs: EXR, KTX2 and PNG maps, GLSL, and a manifest.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "renderer/bake/baked_method.hpp"
#include "renderer/baked_files/gltf_copy.hpp"
#include "renderer/languages/translation.hpp"
#include "renderer/scene/footprint_filter.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint {

/// Maps in the form that engines import, of one material.
struct EngineMaps {
  std::vector<PrefilteredTexture> textures;  ///< `engine_normal`, `engine_roughness` and, if it has a direction,
                                             ///< `engine_anisotropy`, 8 bits; or empty
  std::string missing;                       ///< the reason, if the method has such maps but not for this material
};

/// The roughness of `Method::roughness_mips`, and renormalised mean normals as (n + 1) / 2.
[[nodiscard]] EngineMaps engine_maps(const BakedMethod& baked, const Material& material);

/// Level `level` of these maps, or the coarsest, and all coarser ones, for a copy of the model with smaller maps.
/// Metallic is added to the roughness. maps: of engine_maps, not empty.
[[nodiscard]] ReplacedMaps replaced_maps(const EngineMaps& maps, const Material& material, int level);

/// The content of an export.
struct BakeToFiles {
  const Scene& scene;
  const BakedMethod& baked;                 ///< of `scene`, for `effects`
  EffectSet effects;                        ///< of the scene
  FootprintFilter footprint;                ///< of the module's lookups
  std::string version;                      ///< of the program, for the manifest
  std::vector<EngineMaps> engine{};         ///< per material, or empty
  std::vector<ShaderLanguage> languages{};  ///< other than glsl, in which the module is written too
};

/// The files of one texture, as paths from the output folder.
struct TextureFiles {
  std::vector<std::string> exr;  ///< one, or one per layer of an array
  std::string ktx2;
  std::vector<std::string> png;  ///< one per level and layer; empty if 8 bits cannot store it
};

/// The files of one material.
struct MaterialFiles {
  std::string folder;
  std::vector<TextureFiles> textures;     ///< in the order of Prefiltered::textures
  std::vector<TextureFiles> imports;      ///< of EngineMaps::textures
  std::optional<std::string> bumpslopes;  ///< moments of slope in OpenImageIO's layout
};

/// All files, as paths from the output folder.
struct BakeListing {
  std::string module;                    ///< the GLSL
  std::vector<std::string> shaders;      ///< in the order of BakeToFiles::languages
  std::vector<MaterialFiles> materials;  ///< in the order of the scene
};

/// The files of an export.
[[nodiscard]] BakeListing list_bake(const BakeToFiles& bake);

/// Throws Error (usage) before anything is written: the method has no texture for this scene. Textures of a frame build
/// must have been read back (take_built_maps).
void require_files(const BakeToFiles& bake);

/// Writes all files and manifest.json into an existing folder. Equal bakes give equal bytes. Throws as require_files;
/// Error (machine): a file cannot be written.
void write_bake(const BakeToFiles& bake, const std::filesystem::path& folder);

/// The GLSL that reads the maps, with documentation.
[[nodiscard]] std::string module_text(const BakeToFiles& bake);

/// The same in a language: GLSL as module_text; else a fragment shader with the entry point of bare_main.glsl, its
/// inputs listed in front of it; SPIR-V as bytes, which are not listed. Throws Error (machine): glslang or SPIRV-Cross
/// refuses the module.
[[nodiscard]] std::string shader_text(const BakeToFiles& bake, ShaderLanguage language);

/// The inputs of that shader in a language other than GLSL, one per line, each behind `prefix`.
[[nodiscard]] std::string inputs_text(const BakeToFiles& bake, ShaderLanguage language, const std::string& prefix);

/// The manifest, "schema": "footprint-bake/1", pretty-printed in a fixed order of keys. It is independent of date and
/// time.
[[nodiscard]] std::string manifest_json(const BakeToFiles& bake, const BakeListing& listing);

}  // namespace footprint
