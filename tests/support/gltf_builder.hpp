// Small glTF files made in memory.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "renderer/core/error.hpp"
#include "renderer/image/image.hpp"

namespace footprint::test {

/// A document with one buffer that grows with each attribute. Tests may change `json`.
class GltfBuilder {
 public:
  GltfBuilder();

  /// Adds bytes as a buffer view; returns its index.
  int add_view(std::span<const std::uint8_t> bytes);
  /// Adds an accessor of floats; `type` is glTF's ("VEC3").
  int add_floats(const std::vector<float>& values, const std::string& type);
  /// Adds a scalar accessor of 16-bit indices.
  int add_indices(const std::vector<std::uint16_t>& values);
  /// Adds an accessor over raw bytes.
  int add_accessor(std::span<const std::uint8_t> bytes, int component_type, std::size_t count, const std::string& type);
  /// Adds a PNG as an embedded image and a texture of it; returns the texture's index.
  int add_texture(const Image& image);

  /// The .gltf text, with the buffer as a data URI.
  [[nodiscard]] std::string text() const;
  /// The file as a .glb.
  [[nodiscard]] std::string glb() const;
  /// Writes `text()` to a fresh file under the tests' folder.
  [[nodiscard]] std::filesystem::path write() const;

  nlohmann::json json;
  std::vector<std::uint8_t> data;
};

/// A quad of 2 x 2 m in the xy plane facing +z with normals and glTF texture coordinates (v down), mesh 0 on node 0.
[[nodiscard]] GltfBuilder make_quad();

/// Writes `text` to `name` in the folder of the process.
std::filesystem::path write_file(const std::string& name, const std::string& text);

/// Runs `action` and returns the text of the footprint::Error{usage} that it throws; "" if it throws none.
template <typename Action>
[[nodiscard]] std::string usage_error(Action&& action) {
  try {
    (void)action();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage) << error.what();
    EXPECT_FALSE(error.hint().empty()) << error.what();
    return error.what();
  }
  return {};
}

}  // namespace footprint::test
