// Thousands of damaged OBJ and MTL files: each loads or throws Error; nothing else may happen.
#include <gtest/gtest.h>

#include <string>

#include "renderer/scene/model.hpp"
#include "tests/support/gltf_builder.hpp"
#include "tests/support/sound_model.hpp"

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

TEST(ObjFuzz, DamagedGeometryLoadsOrThrowsError) {
  test::write_file("fuzz.mtl", "newmtl a\n");
  const int loaded = test::count_loaded(
      rich_obj, 2000, 3, [](const std::string& text) { return load_obj(test::write_file("fuzz.obj", text)); });
  EXPECT_GT(loaded, 100);
  EXPECT_LT(loaded, 1990);
}

TEST(ObjFuzz, DamagedMaterialsLoadOrThrowError) {
  const auto file = test::write_file("fuzz.obj", "mtllib fuzz.mtl\nusemtl b\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const int loaded = test::count_loaded(rich_mtl, 1000, 3, [&](const std::string& text) {
    test::write_file("fuzz.mtl", text);
    return load_obj(file);
  });
  EXPECT_GT(loaded, 50);
  EXPECT_LT(loaded, 990);
}

TEST(ObjFuzz, TheUndamagedFileLoads) {
  test::write_file("fuzz.mtl", "newmtl a\n");
  const Model model = load_obj(test::write_file("fuzz.obj", rich_obj));
  test::expect_sound(model);
  EXPECT_EQ(model.meshes.size(), 2U);
}

}  // namespace
}  // namespace footprint
