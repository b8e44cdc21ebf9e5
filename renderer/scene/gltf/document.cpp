// Checks container and JSON before buffers are read, which come from the model's folder. Images stay encoded.
#include "renderer/scene/gltf/document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>

#include "renderer/core/bytes.hpp"
#include "renderer/core/error.hpp"

namespace footprint {
namespace {

using Json = nlohmann::json;
using Bytes = std::vector<std::uint8_t>;

constexpr std::uint64_t largest_file = std::numeric_limits<std::int32_t>::max();
constexpr const char* damaged_hint = "the file is damaged: export or download it again";

std::uint32_t word_at(std::span<const std::uint8_t> bytes, std::size_t offset) {
  const auto b = bytes.subspan(offset, 4);
  return static_cast<std::uint32_t>(b[0]) | static_cast<std::uint32_t>(b[1]) << 8U |
         static_cast<std::uint32_t>(b[2]) << 16U | static_cast<std::uint32_t>(b[3]) << 24U;
}

std::string_view text_of(std::span<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

[[noreturn]] void fail_container(const std::string& message) {
  throw Error(ErrorKind::usage, "GLB container", message, damaged_hint);
}

struct Container {
  std::string_view json;
  std::span<const std::uint8_t> binary{};  // the bytes of buffers without a URI
};

// The chunks of a GLB file.
Container glb_parts(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t header = 12, chunk_header = 8;
  constexpr std::uint32_t json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;
  if (bytes.size() < header + chunk_header) fail_container("shorter than its header");
  if (word_at(bytes, 4) != 2) fail_container(fmt::format("version {} is not 2", word_at(bytes, 4)));
  const std::uint64_t length = word_at(bytes, 8);
  if (length != bytes.size()) {
    fail_container(fmt::format("says {} bytes, the file has {}", length, bytes.size()));
  }
  const std::uint64_t json_length = word_at(bytes, header);
  if (word_at(bytes, header + 4) != json_chunk) fail_container("the first chunk is not JSON");
  const std::uint64_t json_end = header + chunk_header + json_length;
  if (json_end > length) fail_container("the JSON chunk is longer than the file");
  const std::string_view text = text_of(bytes.subspan(header + chunk_header, json_length));
  if (json_end == length) return {text};
  if (json_end + chunk_header > length) fail_container("the second chunk's header is cut off");
  const std::uint64_t binary_length = word_at(bytes, json_end);
  if (json_end + chunk_header + binary_length > length) fail_container("the binary chunk is longer than the file");
  if (word_at(bytes, json_end + 4) != binary_chunk) fail_container("the second chunk is not binary data");
  return {text, bytes.subspan(json_end + chunk_header, binary_length)};
}

Container parts_of(std::span<const std::uint8_t> bytes) {
  if (text_of(bytes).starts_with("glTF")) return glb_parts(bytes);
  if (std::ranges::find(bytes, 0) != bytes.end())
    throw Error(ErrorKind::usage, {}, "is neither JSON text nor a GLB container", damaged_hint);
  return {text_of(bytes)};
}

// The bytes of a data URI in base64, up to its padding.
Bytes data_of(std::string_view uri) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  Bytes bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char character : uri.substr(uri.find(',') + 1)) {
    const std::size_t digit = digits.find(character);
    if (digit == std::string_view::npos) break;
    bits = bits << 6U | static_cast<std::uint32_t>(digit);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<std::uint8_t>(bits >> count));
  }
  return bytes;
}

// The path in a URI, which may have "%20" for a blank.
std::filesystem::path path_of(const std::string& uri) {
  std::string name;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    std::uint8_t code = 0;
    const bool encoded =
        uri[i] == '%' && i + 2 < uri.size() && std::from_chars(&uri[i + 1], &uri[i] + 3, code, 16).ptr == &uri[i] + 3;
    name += encoded ? static_cast<char>(code) : uri[i];
    if (encoded) i += 2;
  }
  return name;
}

Bytes buffer_bytes(const GltfDocument& document, const Json& buffer, std::span<const std::uint8_t> binary) {
  const auto length = buffer["byteLength"].get<std::size_t>();
  const std::string uri = buffer.value("uri", "");
  if (uri.empty()) {
    if (is_fallback(buffer)) return {};
    if (length > binary.size())
      refuse_gltf({}, fmt::format("has no URI, and the file no binary chunk of {} bytes", length));
    return {binary.begin(), binary.begin() + static_cast<std::ptrdiff_t>(length)};
  }
  const bool is_within = uri.starts_with("data:");
  Bytes bytes = is_within ? data_of(uri)
                          : read_file_bytes(document.file.parent_path() / path_of(uri).relative_path(), largest_file);
  if (bytes.size() != length)
    refuse_gltf({}, fmt::format("{} has {} bytes, byteLength is {}",
                                is_within ? "its data URI" : fmt::format("`{:.80}`", uri), bytes.size(), length));
  return bytes;
}

void read_buffers(GltfDocument& document, std::span<const std::uint8_t> binary) {
  const Json& buffers = document.json.value("buffers", Json::array());
  for (const Json& buffer : buffers) {
    try {
      document.buffers.push_back(buffer_bytes(document, buffer, binary));
    } catch (const Error& error) {
      throw error.within(fmt::format("buffers[{}]", document.buffers.size()));
    }
  }
  const Json& views = document.json.value("bufferViews", Json::array());
  for (const Json& view : views) {
    const auto buffer = view["buffer"].get<std::size_t>();
    GltfView& out = document.views.emplace_back();
    out.stride = view.value("byteStride", std::size_t{0});
    if (!is_fallback(buffers[buffer])) {
      out.bytes = std::span(document.buffers[buffer])
                      .subspan(view.value("byteOffset", std::size_t{0}), view["byteLength"].get<std::size_t>());
    } else if (!is_compressed(view)) {
      refuse_gltf(fmt::format("bufferViews[{}]", document.views.size() - 1),
                  fmt::format("is not compressed, and buffers[{}] has no bytes of its own", buffer));
    }
  }
}

}  // namespace

std::string_view gltf_text(std::span<const std::uint8_t> bytes) { return parts_of(bytes).json; }

GltfDocument read_gltf(const std::filesystem::path& file) {
  const Bytes bytes = read_file_bytes(file, largest_file);
  try {
    const Container parts = parts_of(bytes);
    GltfDocument document{parse_gltf_json(parts.json), file};
    check_gltf_json(document.json);
    read_buffers(document, parts.binary);
    decode_meshopt(document);
    decode_draco(document);
    return document;
  } catch (const Error& error) {
    throw error.within(file.string());
  }
}

std::string gltf_image_name(const GltfDocument& document, std::size_t index) {
  const Json& image = document.json["images"][index];
  const std::string uri = image.value("uri", ""), own = image.value("name", "");
  if (!uri.empty() && !uri.starts_with("data:")) return uri;
  return own.empty() ? fmt::format("images[{}]", index) : own;
}

GltfImage gltf_image(const GltfDocument& document, std::size_t index) {
  const Json& image = document.json["images"][index];
  const std::string uri = image.value("uri", "");
  if (image.contains("bufferView")) {
    const auto& bytes = document.views[image["bufferView"].get<std::size_t>()].bytes;
    return {.file = {}, .bytes = {bytes.begin(), bytes.end()}};
  }
  if (uri.starts_with("data:")) return {.file = {}, .bytes = data_of(uri)};
  if (uri.empty()) refuse_gltf(fmt::format("images[{}]", index), "has neither a buffer view nor a URI");
  return {.file = document.file.parent_path() / path_of(uri), .bytes = {}};
}

}  // namespace footprint
