// The ending, in lower case, chooses between the readers of glTF and of OBJ.
#include "renderer/scene/model_file.hpp"

#include <algorithm>
#include <cctype>

#include "renderer/scene/gltf/model.hpp"
#include "renderer/scene/obj_model.hpp"

namespace footprint {

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return extension;
}

bool names_model(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  return extension == ".gltf" || extension == ".glb" || extension == ".obj";
}

Model load_model(const std::filesystem::path& file) {
  return lower_extension(file) == ".obj" ? load_obj(file) : load_gltf(file);
}

}  // namespace footprint
