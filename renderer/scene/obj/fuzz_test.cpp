// Thousands of damaged OBJ and MTL files: each loads or throws Error; nothing else may happen.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "renderer/core/error.hpp"
#include "renderer/scene/model.hpp"
#include "tests/support/damaged_text.hpp"
#include "tests/support/gltf_builder.hpp"

namespace footprint {
namespace {

constexpr const char* rich_obj =
    "\xEF\xBB\xBFmtllib fuzz.mtl\nv 0 0 0 2\nv 1 0 0 0.5 0.5 1\nv +1 1 1e-60\nv 0.5 0.2 0\nv 0 1 \\\n0\nvn 0 0 1\nvt 0 "
    "0\nvt "
    "1\nvt 1 1 0\ns 1\nusemtl a\nf 1/1/1 2/2/1 3/3/1 4//1 5\nf -5 -4 -3\nusemtl b\nfo 7/1 1/2 2/3\nv 1.#IND 3 3\nv 2 2 "
    "2\nl 1 "
    "2\nf 7 1 2 3\n";
constexpr const char* rich_mtl =
    "newmtl a\nKd 0.5 0.25 1\nKs 0.5\nNs 200\nKe 0 1 2\nd 0.5\nmap_Kd -s 2 2 -o 0.5 -clamp on none.png\nnewmtl b\nPr "
    "0.5\nPm "
    "1\nmap_Bump -bm 0.5 fuzz.mtl\n";

void expect_usable(const Model& model) {
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

// How many of `count` models load, of damaged files.
int count_loaded(bool damages_materials, int count) {
  std::mt19937 random(3);
  int loaded = 0;
  for (int i = 0; i < count; ++i) {
    test::write_file("fuzz.mtl", damages_materials ? test::damaged(rich_mtl, random) : "newmtl a\n");
    const auto file = test::write_file(
        "fuzz.obj", damages_materials ? "mtllib fuzz.mtl\nusemtl b\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
                                      : test::damaged(rich_obj, random));
    try {
      expect_usable(load_obj(file));
      ++loaded;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage) << error.what();
      EXPECT_FALSE(error.message().empty());
    }
  }
  return loaded;
}

TEST(ObjFuzz, DamagedGeometryLoadsOrThrowsError) {
  const int loaded = count_loaded(false, 2000);
  EXPECT_GT(loaded, 100);
  EXPECT_LT(loaded, 1990);
}

TEST(ObjFuzz, DamagedMaterialsLoadOrThrowError) {
  const int loaded = count_loaded(true, 1000);
  EXPECT_GT(loaded, 50);
  EXPECT_LT(loaded, 990);
}

TEST(ObjFuzz, TheUndamagedFileLoads) {
  test::write_file("fuzz.mtl", "newmtl a\n");
  const Model model = load_obj(test::write_file("fuzz.obj", rich_obj));
  expect_usable(model);
  EXPECT_EQ(model.meshes.size(), 2U);
}

}  // namespace
}  // namespace footprint
