// The ending, in lower case, chooses between the readers of glTF and of OBJ.
#include "renderer/scene/model_file.hpp"

#include "renderer/core/error.hpp"
#include "renderer/core/file_names.hpp"
#include "renderer/scene/gltf/model.hpp"
#include "renderer/scene/obj_model.hpp"

namespace footprint {

bool names_model(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  return extension == ".gltf" || extension == ".glb" || extension == ".obj";
}

Model load_model(const std::filesystem::path& file, const ModelSelection& selection) {
  if (lower_extension(file) != ".obj") return load_gltf(file, selection);
  if (!selection.empty()) {
    throw Error(ErrorKind::usage, file.string(), "an OBJ file has no scenes, cameras or variants to choose from",
                "leave the choice out, or give a glTF file");
  }
  return load_obj(file);
}

}  // namespace footprint
