// A glTF file, decompressed and checked, its accessors and images, and the checks of its JSON.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/core/error.hpp"

namespace footprint {

/// A part of a buffer.
struct GltfView {
  std::span<const std::uint8_t> bytes;
  std::size_t stride = 0;  ///< between elements; 0: tightly packed
};

/// A checked document: indices are in range, and buffer views within their buffers. Compressed geometry is decoded,
/// into further buffers.
struct GltfDocument {
  nlohmann::json json;
  std::filesystem::path file;
  std::vector<std::vector<std::uint8_t>> buffers{};
  std::vector<GltfView> views{};  ///< of `bufferViews`, then those of decoded accessors
};

/// Reads a .gltf or .glb file (by its content) with its buffers. Throws Error (usage): missing, empty, over 2 GiB, not
/// glTF 2.0, a broken GLB container, as check_gltf_json, a missing buffer or one of another size, damaged compressed
/// geometry.
[[nodiscard]] GltfDocument read_gltf(const std::filesystem::path& file);

/// The JSON in the bytes of a .gltf or .glb file. Throws Error (usage): a broken container.
[[nodiscard]] std::string_view gltf_text(std::span<const std::uint8_t> bytes);

/// The name of an image for messages: its URI, its own name, or its place.
[[nodiscard]] std::string gltf_image_name(const GltfDocument& document, std::size_t index);

/// An encoded image.
struct GltfImage {
  std::filesystem::path file;  ///< of any content, from the document's folder if its path is relative; empty: `bytes`
  std::vector<std::uint8_t> bytes;  ///< of a buffer view or a data URI
};

/// The image of an index of `images`. Throws Error (usage): neither a buffer view nor a URI.
[[nodiscard]] GltfImage gltf_image(const GltfDocument& document, std::size_t index);

/// glTF's numbers of component types.
enum GltfComponent : int {
  gltf_byte = 5120,
  gltf_unsigned_byte = 5121,
  gltf_short = 5122,
  gltf_unsigned_short = 5123,
  gltf_unsigned_int = 5125,
  gltf_float = 5126
};

/// Whether a component type is one of vertex attributes: float, or an integer of 8 or 16 bits.
[[nodiscard]] inline bool is_attribute_type(int type) {
  return type == gltf_float || (type >= gltf_byte && type <= gltf_unsigned_short);
}

/// `visit` of a value of a component type: one of vertex attributes, or of an unsigned integer of 32 bits.
template <class Visit>
auto visit_component(int type, const Visit& visit) {
  switch (type) {
    case gltf_byte:
      return visit(std::int8_t{});
    case gltf_unsigned_byte:
      return visit(std::uint8_t{});
    case gltf_short:
      return visit(std::int16_t{});
    case gltf_unsigned_short:
      return visit(std::uint16_t{});
    case gltf_unsigned_int:
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

/// Parses JSON with a limit on its nesting. Throws Error (usage): not JSON, nested over 64 deep.
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
