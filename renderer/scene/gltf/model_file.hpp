// A glTF file that is loaded several times, at times of its animation.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "renderer/scene/gltf/document.hpp"
#include "renderer/scene/map_texels.hpp"
#include "renderer/scene/model.hpp"

namespace footprint {

/// A file as it was read, and what is decoded of it on first use.
struct GltfModelFile {
  GltfDocument document;
  std::map<std::string, MapTexels> maps = {};  ///< by image, use and factors
  std::vector<std::string> warnings = {};      ///< of all loads: those of maps come when they are decoded
};

/// Loads the file again, as load_gltf of its path does. Decodes only maps that no load before decoded.
[[nodiscard]] Model load_gltf(GltfModelFile& file, const ModelSelection& selection);

}  // namespace footprint
