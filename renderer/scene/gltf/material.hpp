// glTF materials and their textures, converted when first used.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "renderer/scene/gltf/document.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// A name per entry of `materials`, all distinct: its own, or "material 3" without one (told_apart).
[[nodiscard]] std::vector<std::string> gltf_material_names(const GltfDocument& document);

/// The decoded bytes of all materials' maps, by the headers of their images.
[[nodiscard]] std::uint64_t decoded_map_bytes(const GltfDocument& document);

/// The TEXCOORD_n of a file that are the two sets of a mesh's vertices.
using UvSets = std::array<int, 2>;

/// Converts the materials that meshes use. Shared textures are decoded once.
class GltfMaterials {
 public:
  /// The arguments must outlive this. Adds a warning per unsupported feature.
  /// maps: by image, use and factors; takes those that are there, and adds what it decodes.
  GltfMaterials(const GltfDocument& document, std::map<std::string, MapTexels>& maps,
                std::vector<std::string>& warnings)
      : document_(document), maps_(maps), warnings_(warnings) {}

  /// The index in `materials()` of glTF material `gltf_index`; -1 is glTF's default material. Throws Error (usage) that
  /// names material and texture: an image that is missing, empty, invalid or too large, or a factor that is not finite.
  [[nodiscard]] int use(int gltf_index);

  [[nodiscard]] const std::vector<Material>& materials() const { return materials_; }
  /// The sets that the maps of materials()[index] look up.
  [[nodiscard]] const UvSets& sets(int index) const { return sets_[static_cast<std::size_t>(index)]; }

 private:
  const GltfDocument& document_;
  std::map<std::string, MapTexels>& maps_;
  std::vector<std::string>& warnings_;
  std::vector<Material> materials_;
  std::vector<UvSets> sets_;
  std::map<int, int> indices_;
};

}  // namespace footprint
