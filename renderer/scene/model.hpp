// Models: the content of a glTF or Wavefront file.
#pragma once

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderer/scene/scene.hpp"

namespace footprint {

/// Meshes, materials, lights and camera of a model, as in Scene.
struct Model {
  glm::dvec3 origin{0.0};  ///< as Scene::origin
  std::vector<Mesh> meshes;
  std::vector<Material> materials;
  std::vector<Light> lights;
  std::optional<Camera> camera;
  std::vector<ModelChoice> choices;
  std::optional<Motion> motion;
  std::vector<std::string> warnings;
};

/// Adds a line unless it exists, so that a thousand materials with one fault give one warning.
inline void add_once(std::vector<std::string>& lines, std::string line) {
  if (std::ranges::find(lines, line) == lines.end()) lines.push_back(std::move(line));
}

/// Whether a path has the extension of a model file: .gltf, .glb or .obj.
[[nodiscard]] bool names_model(const std::filesystem::path& path);

struct GltfModelFile;

/// Loads models. A glTF file that is loaded again, as at another time of its animation, is not read again.
class ModelFiles {
 public:
  ModelFiles();
  ~ModelFiles();
  ModelFiles(const ModelFiles&) = delete;
  ModelFiles(ModelFiles&&) = delete;
  ModelFiles& operator=(const ModelFiles&) = delete;
  ModelFiles& operator=(ModelFiles&&) = delete;

  /// Loads an .obj file, or any other as glTF. Throws as load_obj and load_gltf; Error (usage): a selection in an .obj
  /// file.
  [[nodiscard]] Model load(const std::filesystem::path& file, const ModelSelection& selection = {});

 private:
  std::map<std::filesystem::path, std::unique_ptr<GltfModelFile>> files_;
};

/// Loads the polygons of a Wavefront file (Advanced Visualizer manual, appendix B1) with the materials of its MTL
/// files, at most 2 GiB and 2^26 triangles: one mesh per material, without any a default one. Vertices without a normal
/// get the area-weighted mean of the normals around their position. v of `vt` is flipped to glTF's. scenes.md lists
/// what is read; for the rest there are warnings. Throws Error (usage) "FILE:LINE: ...": an invalid number or index; as
/// MtlLibrary.
[[nodiscard]] Model load_obj(const std::filesystem::path& file);

/// Loads a scene of a glTF file: the selected one, else the default, else the first, else all root nodes. Meshes are in
/// world space, one per material of the selected variant. Includes all lights, and the selected or the first camera. It
/// may have no triangles. Throws Error (usage) with file and place; scenes.md lists the supported features.
[[nodiscard]] Model load_gltf(const std::filesystem::path& file, const ModelSelection& selection = {});

}  // namespace footprint
