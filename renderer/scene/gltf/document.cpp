// Checks container and JSON before tinygltf parses them. Images stay encoded; files come from the model's folder only.
#include "renderer/scene/gltf/document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/core/bytes.hpp"
#include "renderer/core/error.hpp"
#include "renderer/scene/gltf/check.hpp"

namespace footprint {
namespace {

constexpr std::uint64_t largest_file = std::numeric_limits<std::int32_t>::max();  // tinygltf counts in int
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

/// The JSON text of a GLB file; checks header and chunks, whose lengths tinygltf 2.7 trusts in part.
std::string_view glb_json(std::span<const std::uint8_t> bytes) {
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
  if (json_end < length) {
    if (json_end + chunk_header > length) fail_container("the second chunk's header is cut off");
    if (json_end + chunk_header + word_at(bytes, json_end) > length) {
      fail_container("the binary chunk is longer than the file");
    }
    if (word_at(bytes, json_end + 4) != binary_chunk) fail_container("the second chunk is not binary data");
  }
  return text_of(bytes.subspan(header + chunk_header, json_length));
}

bool keep_encoded(tinygltf::Image* image, const int /*index*/, std::string* /*error*/, std::string* /*warning*/,
                  int /*width*/, int /*height*/, const unsigned char* bytes, int size, void* /*user*/) {
  image->image.assign(bytes, bytes + size);
  image->as_is = true;
  return true;
}

/// Files are only read from the document's folder, which is `user`.
bool file_exists(const std::string& file, void* user) {
  const auto& folder = *static_cast<const std::string*>(user);
  std::error_code error;
  return file.starts_with(folder) && std::filesystem::is_regular_file(file, error);
}

bool read_whole_file(std::vector<unsigned char>* bytes, std::string* message, const std::string& file, void* /*user*/) {
  try {
    *bytes = read_file_bytes(file, largest_file);
    return true;
  } catch (const std::exception& error) {
    *message = error.what();
    return false;
  }
}

std::string same_path(const std::string& file, void* /*user*/) { return file; }

bool write_nothing(std::string* /*message*/, const std::string& /*file*/, const std::vector<unsigned char>& /*bytes*/,
                   void* /*user*/) {
  return false;
}

/// tinygltf's messages may be long and end in line breaks.
std::string one_line(std::string message) {
  if (message.size() > 300) message = message.substr(0, 300) + " ...";
  std::ranges::replace(message, '\n', ' ');
  while (!message.empty() && message.back() == ' ') message.pop_back();
  return message.empty() ? "tinygltf gives no reason" : message;
}

tinygltf::Model parse(std::span<const std::uint8_t> bytes, bool binary, std::string folder) {
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(keep_encoded, nullptr);
  loader.SetFsCallbacks({file_exists, same_path, read_whole_file, write_nothing, &folder});
  tinygltf::Model model;
  std::string error, warning;
  const auto size = static_cast<unsigned int>(bytes.size());
  bool loaded = false;
  try {
    loaded = binary ? loader.LoadBinaryFromMemory(&model, &error, &warning, bytes.data(), size, folder)
                    : loader.LoadASCIIFromString(&model, &error, &warning, text_of(bytes).data(), size, folder);
  } catch (const std::bad_alloc&) {
    throw Error(ErrorKind::machine, {}, "out of memory while reading the glTF file", "use a smaller model");
  } catch (const std::exception& thrown) {
    error += thrown.what();
  }
  if (!loaded) {
    throw Error(ErrorKind::usage, {}, "not readable as glTF 2.0: " + one_line(error),
                "check that the files it names lie beside it and are whole");
  }
  return model;
}

// The container with another JSON chunk; the rest stays.
std::vector<std::uint8_t> with_json(std::span<const std::uint8_t> glb, std::string text) {
  constexpr std::size_t header = 12, chunk_header = 8;
  const std::size_t rest = header + chunk_header + word_at(glb, header);
  while (text.size() % 4 != 0) text += ' ';
  std::vector<std::uint8_t> out(glb.begin(), glb.begin() + header + chunk_header);
  out.insert(out.end(), text.begin(), text.end());
  out.insert(out.end(), glb.begin() + static_cast<std::ptrdiff_t>(rest), glb.end());
  const auto write_word = [&](std::size_t at, std::size_t word) {
    for (std::size_t i = 0; i < 4; ++i) out[at + i] = static_cast<std::uint8_t>(word >> 8 * i);
  };
  write_word(8, out.size());
  write_word(header, text.size());
  return out;
}

// Parses a checked document, which changes where tinygltf needs it.
tinygltf::Model parse_changed(std::span<const std::uint8_t> bytes, bool binary, nlohmann::json& document,
                              const std::string& folder) {
  const bool has_fallbacks = fill_fallback_buffers(document), has_draco = fill_draco_indices(document);
  if (!has_fallbacks && !has_draco) return parse(bytes, binary, folder);
  const std::string text = document.dump();
  if (binary) return parse(with_json(bytes, text), binary, folder);
  return parse({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, binary, folder);
}

}  // namespace

GltfDocument read_gltf(const std::filesystem::path& file) {
  const std::vector<std::uint8_t> bytes = read_file_bytes(file, largest_file);
  const bool binary = text_of(bytes).starts_with("glTF");
  try {
    if (!binary && std::ranges::find(bytes, 0) != bytes.end()) {
      throw Error(ErrorKind::usage, {}, "is neither JSON text nor a GLB container", damaged_hint);
    }
    GltfDocument document{parse_gltf_json(binary ? glb_json(bytes) : text_of(bytes)), {}, file};
    check_gltf_json(document.json);
    document.model =
        parse_changed(bytes, binary, document.json, std::filesystem::absolute(file).parent_path().string());
    decode_meshopt(document);
    decode_draco(document);
    return document;
  } catch (const Error& error) {
    throw error.within(file.string());
  }
}

}  // namespace footprint
