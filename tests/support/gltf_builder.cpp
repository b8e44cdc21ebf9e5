// Collects JSON and binary data, and writes them as text with a data URI or as a GLB container.
#include "tests/support/gltf_builder.hpp"

#include <cstring>
#include <fstream>

#include "renderer/core/bytes.hpp"
#include "renderer/image/image_io.hpp"
#include "tests/support/fresh_folder.hpp"

namespace footprint::test {
namespace {

std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t j = 0; j < 3; ++j) word = word << 8U | (i + j < bytes.size() ? bytes[i + j] : 0U);
    for (std::size_t j = 0; j < 4; ++j) {
      text += j <= bytes.size() - i ? digits[word >> (18U - 6U * static_cast<unsigned>(j)) & 63U] : '=';
    }
  }
  return text;
}

template <typename T>
std::vector<std::uint8_t> bytes_of(const std::vector<T>& values) {
  std::vector<std::uint8_t> bytes(values.size() * sizeof(T));
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

void append_word(std::string& text, std::size_t word) {
  for (unsigned shift = 0; shift < 32; shift += 8) text += static_cast<char>(word >> shift & 0xFFU);
}

}  // namespace

GltfBuilder::GltfBuilder() {
  json = {{"asset", {{"version", "2.0"}}},
          {"accessors", nlohmann::json::array()},
          {"bufferViews", nlohmann::json::array()}};
}

int GltfBuilder::add_view(std::span<const std::uint8_t> bytes) {
  while (data.size() % 4 != 0) data.push_back(0);
  json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", data.size()}, {"byteLength", bytes.size()}});
  data.insert(data.end(), bytes.begin(), bytes.end());
  return static_cast<int>(json["bufferViews"].size()) - 1;
}

int GltfBuilder::add_accessor(std::span<const std::uint8_t> bytes, int component_type, std::size_t count,
                              const std::string& type) {
  const int view = add_view(bytes);
  json["accessors"].push_back(
      {{"bufferView", view}, {"componentType", component_type}, {"count", count}, {"type", type}});
  return static_cast<int>(json["accessors"].size()) - 1;
}

int GltfBuilder::add_floats(const std::vector<float>& values, const std::string& type) {
  const std::size_t side = type == "SCALAR" ? 1 : static_cast<std::size_t>(type.back() - '0');
  const std::size_t width = type.starts_with("MAT") ? side * side : side;
  return add_accessor(bytes_of(values), 5126, values.size() / width, type);
}

int GltfBuilder::add_indices(const std::vector<std::uint16_t>& values) {
  return add_accessor(bytes_of(values), 5123, values.size(), "SCALAR");
}

int GltfBuilder::add_texture(const Image& image) {
  const auto file = process_folder() / "texture.png";
  write_png(file, image);
  const int view = add_view(read_file_bytes(file, 1U << 20U));
  json["images"].push_back({{"bufferView", view}, {"mimeType", "image/png"}});
  json["textures"].push_back({{"source", json["images"].size() - 1}});
  return static_cast<int>(json["textures"].size()) - 1;
}

std::string GltfBuilder::text() const {
  nlohmann::json whole = json;
  whole["buffers"] = {{{"byteLength", data.size()}, {"uri", "data:application/octet-stream;base64," + base64(data)}}};
  return whole.dump();
}

std::string GltfBuilder::glb() const {
  std::vector<std::uint8_t> padded = data;
  while (padded.size() % 4 != 0) padded.push_back(0);
  nlohmann::json whole = json;
  whole["buffers"] = {{{"byteLength", data.size()}}};
  std::string document = whole.dump();
  while (document.size() % 4 != 0) document += ' ';
  std::string file = "glTF";
  append_word(file, 2);
  append_word(file, 12 + 8 + document.size() + 8 + padded.size());
  append_word(file, document.size());
  file += "JSON" + document;
  append_word(file, padded.size());
  file += std::string("BIN\0", 4);
  file.append(padded.begin(), padded.end());
  return file;
}

std::filesystem::path GltfBuilder::write() const { return write_file("made.gltf", text()); }

GltfBuilder make_quad() {
  GltfBuilder quad;
  const int positions = quad.add_floats({-1, 1, 0, 1, 1, 0, 1, -1, 0, -1, -1, 0}, "VEC3");
  const int normals = quad.add_floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  const int uvs = quad.add_floats({0, 0, 1, 0, 1, 1, 0, 1}, "VEC2");
  const int indices = quad.add_indices({0, 3, 2, 0, 2, 1});
  quad.json["meshes"] = {{{"name", "quad"},
                          {"primitives",
                           {{{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", uvs}}},
                             {"indices", indices}}}}}};
  quad.json["nodes"] = {{{"mesh", 0}}};
  quad.json["scenes"] = {{{"nodes", {0}}}};
  return quad;
}

std::filesystem::path write_file(const std::string& name, const std::string& text) {
  auto file = process_folder() / name;
  std::filesystem::create_directories(file.parent_path());
  std::filesystem::remove(file);  // truncating a file that exists makes some file systems write it out at once
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

}  // namespace footprint::test
