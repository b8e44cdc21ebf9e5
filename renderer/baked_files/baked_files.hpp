// A bake as files for other programs: EXR, KTX2 and PNG maps, GLSL, and a manifest.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/bake/baked_method.hpp"
#include "renderer/bake/prefiltered.hpp"
#include "renderer/core/bytes.hpp"
#include "renderer/image/image.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/languages/translation.hpp"
#include "renderer/scene/footprint_filter.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint {

/// The maps of one material that are replaced, each a mip chain of 8-bit values, 3 channels.
struct ReplacedMaps {
  std::string material;               ///< as the loader calls it: its name, or "material N"
  std::vector<Image> normal;          ///< (n + 1) / 2
  std::vector<Image> rough_metallic;  ///< 1, perceptual roughness, metallic; looked up as the normal map is
  std::vector<Image> anisotropy;      ///< KHR_materials_anisotropy's direction (d + 1) / 2 and strength; or empty
  bool metallic_in_map = false;       ///< else the metallic factor stays
};

/// Writes `source` (.gltf or .glb) with these maps as FOLDER/NAME.gltf, its buffers and images as files beside it,
/// where no path of the source leads. A map has three files: its finest level as PNG, and the whole chain as DDS, which
/// MSFT_texture_dds refers to, and as KTX2, which extras do: no extension takes KTX2 without Basis Universal. Returns
/// the file's name. Throws Error (usage): the source cannot be read, two of its materials have one of these names, or
/// none has; (machine): a file cannot be written.
std::string write_gltf_copy(const std::filesystem::path& source, std::span<const ReplacedMaps> maps,
                            const std::filesystem::path& folder);

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

/// The module in a language: GLSL as module_text; else a fragment shader with the entry point of bare_main.glsl, its
/// inputs listed in front of it; SPIR-V as bytes, which are not listed. Throws Error (machine): glslang or SPIRV-Cross
/// refuses the module.
[[nodiscard]] std::string shader_text(const BakeToFiles& bake, ShaderLanguage language);

/// The inputs of that shader in a language other than GLSL, one per line, each behind `prefix`.
[[nodiscard]] std::string inputs_text(const BakeToFiles& bake, ShaderLanguage language, const std::string& prefix);

/// The manifest, "schema": "footprint-bake/1", pretty-printed in a fixed order of keys. It is independent of date and
/// time.
[[nodiscard]] std::string manifest_json(const BakeToFiles& bake, const BakeListing& listing);

/// The linear Vulkan format (VkFormat) of a storage with 1 to 4 channels; a storage of blocks has its own number.
[[nodiscard]] std::uint32_t vk_format(Storage storage, int channels);

/// The file's bytes: header, level index, data format descriptor, the keys KTXorientation (`rd`: the first row is v =
/// 0) and KTXwriter, and the levels, coarsest first. Equal textures give equal bytes. Throws std::logic_error: a
/// texture of a frame build.
[[nodiscard]] std::vector<std::uint8_t> ktx2_bytes(const PrefilteredTexture& texture);

/// The offsets of the levels of a KTX2 file, finest first. Checks the file against a texture and against its own
/// length, before anything of its size is allocated.
/// form: storage, channels, layers and sizes of levels that the file must have; its texels are not used.
/// Throws Error (usage), without a place: not a KTX2 file, another format or size, supercompression, a level beyond its
/// end; (machine): it cannot be read.
[[nodiscard]] std::vector<std::uint64_t> ktx2_offsets(const ByteSource& file, const PrefilteredTexture& form);

/// Reads the texels of a texture, which has everything else.
/// Throws as ktx2_offsets; Error (machine): the texels do not fit in memory.
void read_ktx2(const ByteSource& file, PrefilteredTexture& texture);

/// A plain texture of `unorm8` with 4 channels as a DirectDraw surface with all its levels: the header of 2001, which
/// every reader knows.
[[nodiscard]] std::vector<std::uint8_t> dds_bytes(const PrefilteredTexture& texture);

/// The channels in order: height (-1 if made from a normal map), the slopes along u and v, and the means of their
/// products.
[[nodiscard]] const std::vector<std::string>& bumpslopes_channels();

/// Converts `slope_moments` and `slope_rest` of a bake (bake_slopes) to that layout. Nothing if one is missing or the
/// covariance is not complete.
[[nodiscard]] std::optional<ExrChain> make_bumpslopes(const Prefiltered& prefiltered);

/// The normals of the slopes in the finest level: 4 channels, as Material::normal_map. OpenImageIO's slopes of a height
/// map are per texel and point down along v; those of a normal map point up, as its green channel. The former are
/// converted.
/// file: for messages.
/// Throws Error (usage): wrong channels, a missing level, or a value that is not finite.
[[nodiscard]] Image normals_of_bumpslopes(const ExrChain& chain, const std::string& file);

/// Replaces the moments that were baked from the finest level by those of the chain, whose coarser levels may contain
/// more. Storage, coordinates and a mean normal stay. Throws std::logic_error if the bake has no such textures of that
/// size.
void replace_moments(const ExrChain& chain, Prefiltered& prefiltered);

/// Whether a bake has such textures.
[[nodiscard]] bool holds_slope_moments(const Prefiltered& prefiltered);

}  // namespace footprint
