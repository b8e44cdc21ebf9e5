// A copy of a glTF file with some of its materials' maps replaced: what was baked, written back into the model.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "renderer/image/image.hpp"

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

}  // namespace footprint
