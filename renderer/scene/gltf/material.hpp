// glTF materials and their textures, converted when first used.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "renderer/image/image_io.hpp"
#include "renderer/scene/gltf/document.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// The decoded bytes of all materials' maps, by the headers of their images.
[[nodiscard]] std::uint64_t decoded_map_bytes(const GltfDocument& document);

/// Converts the materials that meshes use. Shared textures are decoded once.
class GltfMaterials {
 public:
  /// Both arguments must outlive this. Adds a warning per unsupported feature.
  GltfMaterials(const GltfDocument& document, std::vector<std::string>& warnings)
      : document_(document), warnings_(warnings) {}

  /// The index in `materials()` of glTF material `gltf_index`; -1 is glTF's default material. Throws Error (usage) that
  /// names material and texture: an image that is missing, empty, invalid or too large, or a factor that is not finite.
  [[nodiscard]] int use(int gltf_index);

  [[nodiscard]] const std::vector<Material>& materials() const { return materials_; }

 private:
  [[nodiscard]] Material convert(int gltf_index);
  [[nodiscard]] Material convert_named(int gltf_index);
  void convert_metallic_roughness(const tinygltf::Material& source, Material& material);
  void convert_specular_glossiness(const tinygltf::Value& source, Material& material);
  void convert_normals(const tinygltf::Material& source, Material& material);
  void convert_coat(const tinygltf::Material& source, Material& material);
  void convert_anisotropy(const tinygltf::Material& source, Material& material);
  void convert_alpha(const tinygltf::Material& source, Material& material);
  void warn_left_out(const tinygltf::Material& source);
  [[nodiscard]] std::optional<TextureMap> find_map(int texture, int set, const tinygltf::ExtensionMap& extensions);
  [[nodiscard]] int image_of(int texture) const;
  [[nodiscard]] Image stored(int index, Transfer transfer) const;
  [[nodiscard]] MapTexels base_color(int image);
  [[nodiscard]] MapTexels metallic_roughness(int image, const Material& material);
  [[nodiscard]] MapTexels factor(int image, int channel, float factor);
  [[nodiscard]] MapTexels normals(int image, double scale);
  /// diffuse (1 - max specular) of KHR_materials_pbrSpecularGlossiness. diffuse: -1 is white.
  [[nodiscard]] MapTexels diffuse_beside(int diffuse, int specular, const glm::vec3& specular_factor);

  const GltfDocument& document_;
  std::vector<std::string>& warnings_;
  std::vector<Material> materials_;
  std::map<int, int> indices_;
  std::map<std::string, MapTexels> maps_;  ///< by image, use and factors
};

}  // namespace footprint
