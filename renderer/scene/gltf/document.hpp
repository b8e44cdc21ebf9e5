// A glTF file, decompressed and checked, its accessors and images, and the checks of its JSON.
#pragma once

#include <tiny_gltf.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/core/error.hpp"

namespace footprint {

/// A checked document: indices are in range, and buffer views within their buffers. Compressed geometry is decoded,
/// into further buffers. tinygltf has read the members that have bytes: buffers, buffer views, accessors, and images in
/// data URIs.
struct GltfDocument {
  nlohmann::json json;  ///< normalized
  std::filesystem::path file;
  tinygltf::Model model{};  ///< buffers that only name what is decoded are empty
};

/// Reads a .gltf or .glb file (by its content) with its buffers. Throws Error (usage): missing, empty, over 2 GiB, not
/// glTF 2.0, a broken GLB container, as check_gltf_json, a missing or too short buffer, a data URI that is not base64,
/// damaged compressed geometry.
[[nodiscard]] GltfDocument read_gltf(const std::filesystem::path& file);

/// The JSON in the bytes of a .gltf or .glb file. Throws Error (usage): a broken container.
[[nodiscard]] std::string_view gltf_text(std::span<const std::uint8_t> bytes);

/// The name of an image for messages: its URI, its own name, or its place.
[[nodiscard]] std::string gltf_image_name(const GltfDocument& document, std::size_t index);

/// A text with its percent escapes decoded: "%20" is a blank. What is no escape stays.
[[nodiscard]] std::string percent_decoded(std::string_view text);

/// The file that a URI names.
struct GltfFile {
  std::filesystem::path path;  ///< from the document's folder if it is relative
  std::string fault{};         ///< why there is none, such as "no such file"; empty: there is one
};

/// The file of a local URI: as it is written, or else with percent escapes decoded, or without a query and a fragment.
/// `file:` URIs and absolute paths count too.
[[nodiscard]] GltfFile gltf_file(const GltfDocument& document, const std::string& uri);

/// An encoded image.
struct GltfImage {
  std::filesystem::path file;       ///< of any content, as in GltfFile; empty: `bytes`
  std::vector<std::uint8_t> bytes;  ///< of a buffer view or a data URI
  std::string fault{};              ///< of the file
};

/// The image of an index of `images`. Throws Error (usage): neither a buffer view nor a URI.
[[nodiscard]] GltfImage gltf_image(const GltfDocument& document, std::size_t index);

/// The bytes of a buffer view.
[[nodiscard]] std::span<const std::uint8_t> view_bytes(const tinygltf::Model& model, std::size_t view);

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
/// components: 1 to 4, or 16 for matrices of 4 x 4.
/// Throws Error (usage) that names the accessor: another type or component type, no element, more than
/// `largest_element_count` elements (2^20 without a buffer view), elements outside of the buffer view, or sparse
/// indices out of order or range.
[[nodiscard]] std::vector<float> read_floats(const GltfDocument& document, std::size_t accessor, int components);

/// All elements of a scalar accessor of unsigned 8, 16 or 32 bit integers. Throws as read_floats.
[[nodiscard]] std::vector<std::uint32_t> read_indices(const GltfDocument& document, std::size_t accessor);

/// Whether a buffer view is compressed, and whether a buffer has no bytes and only names what such views are decoded
/// to.
[[nodiscard]] bool is_compressed(const nlohmann::json& view);
[[nodiscard]] bool is_fallback(const nlohmann::json& buffer);

/// Decodes every compressed buffer view into its own buffer. Throws Error (usage) that names the buffer view: damaged
/// data, data outside of its buffer, or an invalid size, mode or filter.
void decode_meshopt(GltfDocument& document);

/// Decodes every compressed primitive into its own buffers and points its accessors there. Primitives with uncompressed
/// buffer views are not changed. Throws Error (usage) that names the primitive: damaged data, or counts, components or
/// types that differ from the accessors'.
void decode_draco(GltfDocument& document);

[[noreturn]] inline void refuse_gltf(const std::string& place, const std::string& message,
                                     const std::string& hint = "repair the file or export it again") {
  throw Error(ErrorKind::usage, place, message, hint);
}

/// Removes null members, which count as missing, and makes whole numbers of floats such as 4.0.
template <class Json>
void normalize_gltf(Json& value) {
  if (value.is_object()) {
    for (auto member = value.begin(); member != value.end();)
      member = member->is_null() ? value.erase(member) : std::next(member);
  }
  if (value.is_number_float()) {
    const auto number = value.template get<double>();
    const bool is_whole = std::abs(number) < 0x1p53 && number == std::floor(number);
    if (is_whole && !(number == 0.0 && std::signbit(number))) value = static_cast<std::int64_t>(number);
  }
  if (value.is_structured())
    for (Json& child : value) normalize_gltf(child);
}

/// Parses and normalizes JSON, with a limit on its nesting. Throws Error (usage): not JSON, nested over 64 deep.
[[nodiscard]] nlohmann::json parse_gltf_json(std::string_view text);

/// Checks everything in a glTF 2.0 document that Footprint reads: version, required extensions, types, array sizes,
/// indices, buffer views within their buffers, and URIs. Throws Error (usage) with a place such as
/// "meshes[0].primitives[1].indices".
void check_gltf_json(const nlohmann::json& document);

/// Whether an extension is supported.
[[nodiscard]] bool reads_gltf_extension(std::string_view name);

/// The feature that an unsupported extension adds to a surface, such as "sheen". Empty for extensions without which a
/// file cannot be shown.
[[nodiscard]] std::string_view gltf_layer(std::string_view name);

}  // namespace footprint
