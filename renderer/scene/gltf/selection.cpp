// Lists scenes and variants with their names, and reads the mappings of variants (KHR_materials_variants).
#include "renderer/scene/gltf/selection.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace footprint {
namespace {

constexpr const char* variants_extension = "KHR_materials_variants";

std::string name_or_number(const std::string& name, const char* kind, std::size_t number) {
  return name.empty() ? fmt::format("{} {}", kind, number) : name;
}

}  // namespace

ModelChoice scene_choice(const tinygltf::Model& model, const std::optional<std::string>& wanted) {
  ModelChoice choice{"scene", {}, {}};
  for (std::size_t i = 0; i < model.scenes.size(); ++i) {
    choice.names.push_back(name_or_number(model.scenes[i].name, "scene", i));
  }
  if (wanted) {
    choice.taken = find_choice(choice, *wanted);
  } else if (!model.scenes.empty()) {
    choice.taken = static_cast<std::size_t>(std::max(model.defaultScene, 0));
  }
  return choice;
}

ModelChoice variant_choice(const tinygltf::Model& model, const std::optional<std::string>& wanted) {
  ModelChoice choice{"variant", {}, {}};
  if (const auto found = model.extensions.find(variants_extension); found != model.extensions.end()) {
    const tinygltf::Value& variants = found->second.Get("variants");
    for (int i = 0; i < static_cast<int>(variants.ArrayLen()); ++i) {
      const tinygltf::Value& name = variants.Get(i).Get("name");
      choice.names.push_back(
          name_or_number(name.IsString() ? name.Get<std::string>() : "", "variant", static_cast<std::size_t>(i)));
    }
  }
  if (wanted) choice.taken = find_choice(choice, *wanted);
  return choice;
}

int material_in_variant(const tinygltf::Primitive& primitive, const std::optional<std::size_t>& variant) {
  const auto found = primitive.extensions.find(variants_extension);
  if (!variant || found == primitive.extensions.end()) return primitive.material;
  const tinygltf::Value& mappings = found->second.Get("mappings");
  for (int i = 0; i < static_cast<int>(mappings.ArrayLen()); ++i) {
    const tinygltf::Value& mapping = mappings.Get(i);
    const tinygltf::Value& variants = mapping.Get("variants");
    for (int j = 0; j < static_cast<int>(variants.ArrayLen()); ++j) {
      if (variants.Get(j).GetNumberAsInt() == static_cast<int>(*variant))
        return mapping.Get("material").GetNumberAsInt();
    }
  }
  return primitive.material;
}

}  // namespace footprint
