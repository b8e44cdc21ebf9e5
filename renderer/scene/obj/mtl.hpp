// MTL files: the materials of Wavefront OBJ files.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "renderer/scene/material.hpp"
#include "renderer/scene/settings/part.hpp"

namespace footprint {

/// A picture that a material names.
struct MtlMap {
  std::filesystem::path file;
  TextureCoordinates coordinates{};
  float multiplier = 1.0F;  ///< of -bm
};

/// A material as an MTL file gives it.
struct MtlMaterial {
  glm::vec3 diffuse{1.0F};               ///< Kd
  std::optional<glm::vec3> specular{};   ///< Ks
  std::optional<glm::vec3> emission{};   ///< Ke
  std::optional<float> exponent{};       ///< Ns
  std::optional<float> roughness{};      ///< Pr
  std::optional<float> metallic{};       ///< Pm
  std::map<std::string, MtlMap> maps{};  ///< by keyword in lower case, "bump" and "norm" for all their spellings
};

/// Reads the materials of MTL files, and converts those that are used. Pictures are decoded once for all.
class MtlLibrary {
 public:
  /// warnings: must outlive this; gets a line per feature that is left out.
  explicit MtlLibrary(std::vector<std::string>& warnings) : warnings_(warnings) {}

  /// Adds the materials of a file; a name that exists keeps its first material. Throws Error (usage) with file and
  /// line: as WavefrontFile, a number that is not one, a value before the first `newmtl`.
  void read(const std::filesystem::path& file);

  /// The material of a name; without one in the files, their default: roughness 0.5, metalness 0, white. Throws Error
  /// (usage) that names the picture: damaged, or too large; (machine): the pictures do not fit in memory.
  [[nodiscard]] Material material(const std::string& name);

 private:
  void add_maps(const MtlMaterial& source, Material& material);
  void add_specular(const MtlMaterial& source, Material& material);
  void add_bump(const MtlMap& map, Material& material);
  void add_normals(const MtlMap& map, const NormalFile& file, Material& material);
  void add_roughness(const MtlMaterial& source, Material& material);
  template <class Make>
  TextureMap decoded(const MtlMap& map, const std::string& use, const Make& make);

  std::vector<std::string>& warnings_;
  std::map<std::string, MtlMaterial> sources_;
  std::map<std::string, MapTexels> texels_;  // by file and use
};

}  // namespace footprint
