// For tests of readers: whether what was read may be drawn.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "renderer/core/error.hpp"
#include "renderer/scene/model.hpp"
#include "tests/support/damaged_text.hpp"

namespace footprint::test {

/// Expects indices and materials that are there, finite positions and texture coordinates, unit normals and tangents,
/// and colours of 0 to 1.
inline void expect_sound(const Model& model) {
  for (const Mesh& mesh : model.meshes) {
    EXPECT_LT(static_cast<std::size_t>(mesh.material), model.materials.size());
    for (const std::uint32_t index : mesh.indices) ASSERT_LT(index, mesh.vertices.size());
    for (const Vertex& vertex : mesh.vertices) {
      ASSERT_TRUE(std::isfinite(glm::length(vertex.position)));
      ASSERT_NEAR(glm::length(vertex.normal), 1.0F, 1e-4F);
      ASSERT_NEAR(glm::length(glm::vec3{vertex.tangent}), 1.0F, 1e-4F);
      ASSERT_TRUE(std::isfinite(vertex.uv0.x + vertex.uv0.y));
      for (int c = 0; c < 4; ++c) ASSERT_TRUE(vertex.color[c] >= 0.0F && vertex.color[c] <= 1.0F);
    }
  }
}

/// Returns how many of `count` damaged copies of a file still load; expects errors of the kind `usage` from the others.
/// load: a model of the text of a copy.
template <class Load>
int count_loaded(const std::string& whole, int count, unsigned seed, const Load& load) {
  std::mt19937 random(seed);
  int loaded = 0;
  for (int i = 0; i < count; ++i) {
    const std::string text = damaged(whole, random);
    try {
      expect_sound(load(text));
      ++loaded;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage) << error.what();
      EXPECT_FALSE(error.message().empty());
    }
  }
  return loaded;
}

}  // namespace footprint::test
