// Chooses the reader of a model: renderer/scene/gltf or renderer/scene/obj.
#include "renderer/scene/model.hpp"

#include <fmt/format.h>

#include "renderer/core/error.hpp"
#include "renderer/core/names.hpp"
#include "renderer/scene/gltf/model_file.hpp"

namespace footprint {

std::size_t find_choice(const ModelChoice& choice, const std::string& wanted) {
  if (const auto found = find_entry(wanted, choice.names)) return *found;
  throw Error(ErrorKind::usage, choice.kind, fmt::format("the model has none that is called `{:.80}`", wanted),
              choice.names.empty() ? fmt::format("it has no {} to choose: leave it out", choice.kind)
                                   : suggestion(wanted, choice.names) + fmt::format("; or a number from 0"));
}

bool names_model(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  return extension == ".gltf" || extension == ".glb" || extension == ".obj";
}

ModelFiles::ModelFiles() = default;
ModelFiles::~ModelFiles() = default;

Model ModelFiles::load(const std::filesystem::path& file, const ModelSelection& selection) {
  if (lower_extension(file) != ".obj") {
    std::unique_ptr<GltfModelFile>& known = files_[file];
    if (!known) known = std::make_unique<GltfModelFile>(GltfModelFile{.document = read_gltf(file)});
    return load_gltf(*known, selection);
  }
  if (!selection.empty()) {
    throw Error(ErrorKind::usage, file.string(), "an OBJ file has no scenes, cameras or variants to choose from",
                "leave the choice out, or give a glTF file");
  }
  return load_obj(file);
}

}  // namespace footprint
