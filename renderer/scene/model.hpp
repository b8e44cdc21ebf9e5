// Models: the content of a glTF or Wavefront file.
#pragma once

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "renderer/scene/scene.hpp"

namespace footprint {

/// Meshes, materials, lights and the camera of a model; the fields mean what they mean in Scene.
struct Model {
  std::vector<Mesh> meshes;
  std::vector<Material> materials;
  std::vector<Light> lights;
  std::optional<Camera> camera;
  std::vector<ModelChoice> choices;
  std::vector<std::string> warnings;
};

/// Adds a line that is not there yet: a thousand materials with one fault make one warning.
inline void add_once(std::vector<std::string>& lines, std::string line) {
  if (std::ranges::find(lines, line) == lines.end()) lines.push_back(std::move(line));
}

/// Whether a path ends as a model file does: .gltf, .glb or .obj.
[[nodiscard]] bool names_model(const std::filesystem::path& path);

/// Loads an .obj file as such, any other as glTF. Throws Error (usage): as of load_obj and load_gltf; a selection of an
/// .obj file, which holds one thing alone.
[[nodiscard]] Model load_model(const std::filesystem::path& file, const ModelSelection& selection = {});

/// Loads v, vt, vn and f (Wavefront, Advanced Visualizer manual, appendix B1): polygons as fans, indices from 1 or
/// negative from the end. Vertices without a normal get the area-weighted mean of their triangles' normals, and v of
/// `vt`, which points up, is turned downwards as glTF has it. Materials, groups and every other statement are left out.
/// At most 2 GiB and 2^26 triangles. Throws Error (usage) that reads "FILE:LINE: ...": a number or an index that is
/// none.
[[nodiscard]] Model load_obj(const std::filesystem::path& file);

/// Loads a scene of the file: that of `selection`, else its default scene, its first one, or all root nodes. Meshes in
/// world space merged into one per material, the materials in use (of the variant that is asked for), all lights, one
/// camera: that of `selection`, else the first. May hold no triangle.
/// Throws Error (usage) that names file and place; docs/scenes.md lists what is read.
[[nodiscard]] Model load_gltf(const std::filesystem::path& file, const ModelSelection& selection = {});

}  // namespace footprint
