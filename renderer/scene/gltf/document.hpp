// A glTF file, read by tinygltf, decompressed and checked, and its accessors.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

namespace footprint {

/// A checked document and its content as tinygltf reads it: indices are in range, and buffer views within their
/// buffers. Compressed geometry is decoded. `model.images[i].image` stores encoded bytes, empty if an external file
/// could not be read.
struct GltfDocument {
  nlohmann::json json;
  tinygltf::Model model;
  std::filesystem::path file;
};

/// Reads a .gltf or .glb file (by its content) with its buffers and encoded images. Throws Error (usage): missing,
/// empty, over 2 GiB, not glTF 2.0, a broken GLB container, as check_gltf_json, a missing buffer or one of another
/// size, damaged compressed geometry.
[[nodiscard]] GltfDocument read_gltf(const std::filesystem::path& file);

/// Whether a component type is one of vertex attributes: float, or an integer of 8 or 16 bits.
[[nodiscard]] inline bool is_attribute_type(int type) {
  return type == TINYGLTF_COMPONENT_TYPE_FLOAT ||
         (type >= TINYGLTF_COMPONENT_TYPE_BYTE && type <= TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
}

/// `visit` of a value of a component type: one of vertex attributes, or of an unsigned integer of 32 bits.
template <class Visit>
auto visit_component(int type, const Visit& visit) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return visit(std::int8_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return visit(std::uint8_t{});
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return visit(std::int16_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return visit(std::uint16_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return visit(std::uint32_t{});
    default:
      return visit(float{});
  }
}

/// The largest number of elements of an accessor, and of triangles and vertices of a scene.
inline constexpr std::uint64_t largest_element_count = std::uint64_t{1} << 26U;

/// All elements of an accessor, interleaved, `components` floats each. Normalised integers are converted, plain
/// integers are not scaled, sparse substitutions are applied, and elements without a buffer view are 0.
/// Throws Error (usage) that names the accessor: another type or component type, no element, more than
/// `largest_element_count` elements (2^20 without a buffer view), elements outside of the buffer view, or sparse
/// indices out of order or range.
[[nodiscard]] std::vector<float> read_floats(const tinygltf::Model& model, int accessor, int components);

/// All elements of a scalar accessor of unsigned 8, 16 or 32 bit integers. Throws as read_floats.
[[nodiscard]] std::vector<std::uint32_t> read_indices(const tinygltf::Model& model, int accessor);

/// Adds a byte to fallback buffers of compressed data, because tinygltf refuses empty buffers. Returns whether there
/// are any. The document must be checked. Throws Error (usage): an uncompressed buffer view in such a buffer; an image
/// in a compressed one.
[[nodiscard]] bool fill_fallback_buffers(nlohmann::json& document);

/// Decodes every compressed buffer view into its own buffer. Throws Error (usage) that names the buffer view: damaged
/// data, data outside of its buffer, or an invalid size, mode or filter.
void decode_meshopt(GltfDocument& document);

/// Assigns the compressed data's buffer view to accessors of indices without one, which tinygltf refuses; decode_draco
/// replaces it. Returns whether there are any. The document must be checked.
[[nodiscard]] bool fill_draco_indices(nlohmann::json& document);

/// Decodes every compressed primitive into its own buffers and points its accessors there. Primitives with uncompressed
/// buffer views are not changed. Throws Error (usage) that names the primitive: damaged data, or counts, components or
/// types that differ from the accessors'.
void decode_draco(GltfDocument& document);

}  // namespace footprint
