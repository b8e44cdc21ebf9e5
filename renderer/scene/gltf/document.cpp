// Checks container, JSON, lengths and base64 before tinygltf reads them. Images stay encoded.
#include "renderer/scene/gltf/document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "renderer/core/bytes.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/names.hpp"

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
  std::optional<std::span<const std::uint8_t>> binary{};  // the bytes of the first buffer, if it has no URI
};

// The chunks of a GLB file. Bytes after its own length and chunks of unknown kinds are passed over (glTF 2.0, 4.4).
Container glb_parts(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t header = 12, chunk_header = 8;
  constexpr std::uint32_t json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;
  if (bytes.size() < header + chunk_header) fail_container("shorter than its header");
  if (word_at(bytes, 4) != 2) fail_container(fmt::format("version {} is not 2", word_at(bytes, 4)));
  const std::uint64_t length = word_at(bytes, 8);
  if (length > bytes.size()) fail_container(fmt::format("says {} bytes, the file has {}", length, bytes.size()));
  if (word_at(bytes, header + 4) != json_chunk) fail_container("the first chunk is not JSON");
  Container parts;
  for (std::uint64_t at = header; at < length;) {
    if (at + chunk_header > length) fail_container(fmt::format("the header of the chunk at byte {} is cut off", at));
    const std::uint64_t size = word_at(bytes, at), end = at + chunk_header + size;
    if (end > length) fail_container(fmt::format("the chunk at byte {} is longer than the file", at));
    const auto content = bytes.subspan(at + chunk_header, size);
    if (at == header) parts.json = text_of(content);
    if (at > header && word_at(bytes, at + 4) == binary_chunk && !parts.binary) parts.binary = content;
    at = end;
  }
  return parts;
}

Container parts_of(std::span<const std::uint8_t> bytes) {
  if (text_of(bytes).starts_with("glTF")) return glb_parts(bytes);
  if (std::ranges::find(bytes, 0) != bytes.end())
    throw Error(ErrorKind::usage, {}, "is neither JSON text nor a GLB container", damaged_hint);
  return {text_of(bytes)};
}

bool is_data(std::string_view uri) { return lower_case(std::string(uri.substr(0, 5))) == "data:"; }

// The digits of a data URI in base64, without line breaks and padding.
std::string base64_digits(std::string_view uri) {
  constexpr std::string_view known = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string digits;
  for (const char character : percent_decoded(uri.substr(uri.find(',') + 1))) {
    if (character == '=') break;
    if (character == '-' || character == '_')
      refuse_gltf({}, "its data URI is in the URL-safe kind of base64, with `-` and `_`",
                  "encode it in plain base64, with `+` and `/`");
    if (std::string_view(" \t\r\n").find(character) != std::string_view::npos) continue;
    if (known.find(character) == std::string_view::npos)
      refuse_gltf({}, fmt::format("its data URI has a character of code {}, which is not base64",
                                  static_cast<int>(static_cast<std::uint8_t>(character))));
    digits += character;
  }
  if (digits.size() % 4 == 1) refuse_gltf({}, "the base64 of its data URI is cut off");
  return digits;
}

constexpr std::string_view bytes_uri = "data:application/octet-stream;base64,";  // a kind that tinygltf knows

// What is given to tinygltf: the members of a document that have bytes, in forms that it reads.
struct Readable {
  Json json;
  std::map<std::string, Bytes> files;  // what it asks for, by the names that `json` gives it
};

// A buffer of `length` bytes. It may have more bytes than it declares, which have no meaning.
Json readable_buffer(const GltfDocument& document, std::size_t index, std::optional<std::size_t> binary_size,
                     std::map<std::string, Bytes>& files) {
  const Json& buffer = document.json["buffers"][index];
  const auto length = buffer["byteLength"].get<std::size_t>();
  const std::string uri = buffer.value("uri", "");
  const auto require = [&](std::size_t size, const std::string& what) {
    if (size < length) refuse_gltf({}, fmt::format("{} has {} bytes, byteLength is {}", what, size, length));
  };
  if (length == 0 || is_fallback(buffer)) return {{"byteLength", 1}, {"uri", std::string(bytes_uri) + "AA=="}};
  if (uri.empty()) {
    if (index > 0) refuse_gltf({}, "has no URI, and the binary chunk of a GLB file is that of buffers[0]");
    if (!binary_size) refuse_gltf({}, fmt::format("has no URI, and the file no binary chunk of {} bytes", length));
    require(*binary_size, "the binary chunk");
    return {{"byteLength", length}};
  }
  if (is_data(uri)) {
    std::string digits = base64_digits(uri);
    require(digits.size() * 6 / 8, "its data URI");
    digits.resize((length * 8 + 5) / 6);
    return {{"byteLength", length}, {"uri", std::string(bytes_uri) + digits}};
  }
  const GltfFile file = gltf_file(document, uri);
  if (!file.fault.empty()) refuse_gltf(file.path.string(), file.fault, "check the path");
  Bytes bytes = read_file_bytes(file.path, largest_file);
  require(bytes.size(), fmt::format("`{:.80}`", uri));
  bytes.resize(length);
  std::string name = std::to_string(index);
  files.emplace(name, std::move(bytes));
  return {{"byteLength", length}, {"uri", std::move(name)}};
}

// Only data URIs are decoded: files are read when a material needs them.
Json readable_image(const Json& image) {
  const std::string uri = image.value("uri", "");
  return {{"uri", !image.contains("bufferView") && is_data(uri) ? std::string(bytes_uri) + base64_digits(uri) : ""}};
}

Json readable_accessor(const Json& accessor) {
  Json out;
  for (const char* member : {"bufferView", "byteOffset", "componentType", "count", "normalized", "sparse", "type"})
    if (accessor.contains(member)) out[member] = accessor[member];
  return out;
}

Readable readable(const GltfDocument& document, std::optional<std::size_t> binary_size) {
  Readable out{{{"asset", {{"version", "2.0"}}}}, {}};
  const auto convert = [&](const char* array, const auto& each) {
    const std::size_t count = document.json.contains(array) ? document.json[array].size() : 0;
    for (std::size_t i = 0; i < count; ++i) {
      try {
        out.json[array].push_back(each(document.json[array][i], i));
      } catch (const Error& error) {
        throw error.within(fmt::format("{}[{}]", array, i));
      }
    }
  };
  convert("buffers", [&](const Json&, std::size_t i) { return readable_buffer(document, i, binary_size, out.files); });
  convert("bufferViews", [&](const Json& view, std::size_t) {
    const auto buffer = view["buffer"].get<std::size_t>();
    if (is_fallback(document.json["buffers"][buffer]) && !is_compressed(view))
      refuse_gltf({}, fmt::format("is not compressed, and buffers[{}] has no bytes of its own", buffer));
    return Json{{"buffer", buffer}, {"byteOffset", view.value("byteOffset", 0)}, {"byteLength", view["byteLength"]}};
  });
  convert("accessors", [](const Json& accessor, std::size_t) { return readable_accessor(accessor); });
  convert("images", [](const Json& image, std::size_t) { return readable_image(image); });
  return out;
}

bool file_exists(const std::string& name, void* files) {
  return static_cast<std::map<std::string, Bytes>*>(files)->contains(name);
}

bool read_whole_file(Bytes* bytes, std::string* /*error*/, const std::string& name, void* files) {
  *bytes = std::move((*static_cast<std::map<std::string, Bytes>*>(files))[name]);
  return true;
}

std::string same_name(const std::string& name, void* /*files*/) { return name; }

bool write_nothing(std::string* /*error*/, const std::string& /*name*/, const Bytes& /*bytes*/, void* /*files*/) {
  return false;
}

bool keep_encoded(tinygltf::Image* image, int /*index*/, std::string* /*error*/, std::string* /*warning*/,
                  int /*width*/, int /*height*/, const unsigned char* bytes, int size, void* /*user*/) {
  image->image.assign(bytes, bytes + size);
  return true;
}

void append_word(Bytes& bytes, std::size_t word) {
  for (unsigned shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(word >> shift));
}

void append_chunk(Bytes& file, std::string_view kind, std::span<const std::uint8_t> content, std::uint8_t padding) {
  append_word(file, (content.size() + 3) / 4 * 4);
  file.insert(file.end(), kind.begin(), kind.end());
  file.insert(file.end(), content.begin(), content.end());
  while (file.size() % 4 != 0) file.push_back(padding);
}

// A GLB file without what is passed over.
Bytes assemble_glb(std::string_view text, std::span<const std::uint8_t> binary) {
  constexpr std::size_t headers = 12 + 8 + 8;
  Bytes file;
  file.reserve(headers + text.size() + binary.size() + 8);
  const std::string_view magic = "glTF";
  file.assign(magic.begin(), magic.end());
  append_word(file, 2);
  append_word(file, headers + (text.size() + 3) / 4 * 4 + (binary.size() + 3) / 4 * 4);
  append_chunk(file, "JSON", {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, ' ');
  append_chunk(file, std::string_view("BIN\0", 4), binary, 0);
  return file;
}

// The reading of `files` as tinygltf asks for it: 2.9, which Debian 13 has, also asks for sizes.
template <class Callbacks>
Callbacks callbacks_for(std::map<std::string, Bytes>& files) {
  Callbacks callbacks{};
  callbacks.FileExists = file_exists;
  callbacks.ExpandFilePath = same_name;
  callbacks.ReadWholeFile = read_whole_file;
  callbacks.WriteWholeFile = write_nothing;
  if constexpr (requires { callbacks.GetFileSizeInBytes; }) {
    callbacks.GetFileSizeInBytes = [](std::size_t* size, std::string* /*error*/, const std::string& name, void* user) {
      *size = (*static_cast<std::map<std::string, Bytes>*>(user))[name].size();
      return true;
    };
  }
  callbacks.user_data = &files;
  return callbacks;
}

tinygltf::Model parse(const std::string& text, const Bytes& glb, std::map<std::string, Bytes>& files) {
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(keep_encoded, nullptr);
  loader.SetFsCallbacks(callbacks_for<tinygltf::FsCallbacks>(files));
  tinygltf::Model model;
  std::string error, warning;
  const bool loaded =
      glb.empty()
          ? loader.LoadASCIIFromString(&model, &error, &warning, text.data(), static_cast<unsigned>(text.size()), "")
          : loader.LoadBinaryFromMemory(&model, &error, &warning, glb.data(), static_cast<unsigned>(glb.size()), "");
  if (!loaded) refuse_gltf({}, fmt::format("not readable as glTF 2.0: {:.300}", error));
  return model;
}

// Strides are set here, because tinygltf refuses those that are not multiples of 4, which exporters write.
void read_members(GltfDocument& document, Bytes bytes) {
  const std::optional<std::span<const std::uint8_t>> binary = parts_of(bytes).binary;
  Readable source = readable(document, binary ? std::optional(binary->size()) : std::nullopt);
  const Json::json_pointer first("/buffers/0");
  const bool in_chunk = source.json.contains(first) && !source.json[first].contains("uri");
  const auto chunk_size = in_chunk ? source.json[first]["byteLength"].get<std::size_t>() : 0;
  const std::string text = std::exchange(source.json, {}).dump();
  const Bytes glb = in_chunk ? assemble_glb(text, binary->first(chunk_size)) : Bytes{};
  bytes = {};  // the memory of a large file is needed below
  tinygltf::Model& model = document.model = parse(text, glb, source.files);
  for (std::size_t i = 0; i < model.buffers.size(); ++i) {
    const Json& buffer = document.json["buffers"][i];
    if (buffer["byteLength"] == 0 || is_fallback(buffer)) model.buffers[i].data.clear();
  }
  for (std::size_t i = 0; i < model.bufferViews.size(); ++i)
    model.bufferViews[i].byteStride = document.json["bufferViews"][i].value("byteStride", std::size_t{0});
}

}  // namespace

std::string_view gltf_text(std::span<const std::uint8_t> bytes) { return parts_of(bytes).json; }

GltfDocument read_gltf(const std::filesystem::path& file) {
  Bytes bytes = read_file_bytes(file, largest_file);
  try {
    GltfDocument document{parse_gltf_json(gltf_text(bytes)), file};
    check_gltf_json(document.json);
    read_members(document, std::move(bytes));
    decode_meshopt(document);
    decode_draco(document);
    return document;
  } catch (const Error& error) {
    throw error.within(file.string());
  }
}

std::span<const std::uint8_t> view_bytes(const tinygltf::Model& model, std::size_t view) {
  const tinygltf::BufferView& found = model.bufferViews[view];
  return std::span(model.buffers[static_cast<std::size_t>(found.buffer)].data)
      .subspan(found.byteOffset, found.byteLength);
}

std::string gltf_image_name(const GltfDocument& document, std::size_t index) {
  const Json& image = document.json["images"][index];
  const std::string uri = image.value("uri", ""), own = image.value("name", "");
  if (!uri.empty() && !is_data(uri)) return uri;
  return own.empty() ? fmt::format("images[{}]", index) : own;
}

GltfImage gltf_image(const GltfDocument& document, std::size_t index) {
  const Json& image = document.json["images"][index];
  const std::string uri = image.value("uri", "");
  if (image.contains("bufferView")) {
    const auto bytes = view_bytes(document.model, image["bufferView"].get<std::size_t>());
    return {.file = {}, .bytes = {bytes.begin(), bytes.end()}};
  }
  if (is_data(uri)) return {.file = {}, .bytes = document.model.images[index].image};
  if (uri.empty()) refuse_gltf(fmt::format("images[{}]", index), "has neither a buffer view nor a URI");
  GltfFile found = gltf_file(document, uri);
  return {.file = std::move(found.path), .bytes = {}, .fault = std::move(found.fault)};
}

}  // namespace footprint
