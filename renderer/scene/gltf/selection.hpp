// Which of a glTF file's scenes is taken, and by which variant its primitives have their materials.
#pragma once

#include <tiny_gltf.h>

#include <optional>
#include <string>

#include "renderer/scene/model_selection.hpp"

namespace footprint {

/// The scenes of a file. Taken is the one that is wanted, else the file's default one, else the first. Errors (usage):
/// as of find_choice.
[[nodiscard]] ModelChoice scene_choice(const tinygltf::Model& model, const std::optional<std::string>& wanted);

/// The variants of KHR_materials_variants; none is taken where none is wanted. Errors (usage): as of find_choice.
[[nodiscard]] ModelChoice variant_choice(const tinygltf::Model& model, const std::optional<std::string>& wanted);

/// The material of a primitive in a variant: that of the mapping which names the variant, else the primitive's own.
[[nodiscard]] int material_in_variant(const tinygltf::Primitive& primitive, const std::optional<std::size_t>& variant);

}  // namespace footprint
