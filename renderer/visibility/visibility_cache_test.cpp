// Visibility on disk: a second run has the bytes of the first, damaged or foreign files are computed again, and the
// key follows all that the field depends on.
#include "renderer/visibility/visibility_field.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "renderer/core/bytes.hpp"
#include "renderer/core/error.hpp"
#include "tests/support/fresh_folder.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;

// Two squares, one over the other's half: what the lower one sees varies.
Scene two_squares() {
  Scene scene = testing::square_scene({}, {});
  Mesh upper = scene.meshes.front();
  for (Vertex& vertex : upper.vertices) vertex.position += glm::vec3(1.0F, 0.0F, 0.5F);
  scene.meshes.push_back(upper);
  return scene;
}

const Environment white_sky = constant_environment(glm::vec3(1.0F));

// The field by `cache`, and whether it was computed.
struct Found {
  VisibilityField field;
  bool computed = false;
};

Found find_field(const Scene& scene, const DiskCache* cache) {
  Found found;
  const Progress notice = [&](std::string_view /*what*/, double /*fraction*/) { found.computed = true; };
  found.field = cached_visibility_field(scene, white_sky, cache, notice);
  return found;
}

fs::path only_file(const DiskCache& cache) { return fs::directory_iterator(cache.folder())->path(); }

TEST(VisibilityCache, ASecondRunHasTheBytesOfTheFirst) {
  const DiskCache cache(test::fresh_folder() / "cache");
  const Scene scene = two_squares();
  const Found first = find_field(scene, &cache), second = find_field(scene, &cache);
  EXPECT_TRUE(first.computed);
  EXPECT_FALSE(second.computed);
  EXPECT_EQ(to_bytes(first.field), to_bytes(second.field));
  EXPECT_GT(first.field.error + std::abs(first.field.meshes.at(0).at(1).weights.at(0)), 0.0F) << "nothing to keep";
  EXPECT_TRUE(find_field(scene, nullptr).computed);
  EXPECT_EQ(to_bytes(find_field(scene, nullptr).field), to_bytes(first.field));
}

TEST(VisibilityCache, ADamagedFileIsComputedAgainAndReplaced) {
  const DiskCache cache(test::fresh_folder() / "cache");
  const Scene scene = two_squares();
  const std::vector<std::uint8_t> whole = to_bytes(find_field(scene, &cache).field);
  const fs::path file = only_file(cache);
  for (const std::size_t place : {std::size_t{0}, whole.size() / 2, whole.size() - 1}) {
    std::vector<std::uint8_t> damaged = whole;
    damaged[place] ^= 1U;
    EXPECT_FALSE(visibility_from_bytes(damaged, scene)) << place;
    std::ofstream(file, std::ios::binary) << std::string(damaged.begin(), damaged.end());
    const Found again = find_field(scene, &cache);
    EXPECT_TRUE(again.computed) << place;
    EXPECT_EQ(to_bytes(again.field), whole);
    EXPECT_FALSE(find_field(scene, &cache).computed) << "replaced";
  }
  fs::resize_file(file, 100);
  EXPECT_TRUE(find_field(scene, &cache).computed);
}

TEST(VisibilityCache, AFieldOfAnotherSceneUnderThisNameIsComputedAgain) {
  const DiskCache cache(test::fresh_folder() / "cache");
  const Scene scene = two_squares(), other = testing::square_scene({}, {});
  cache.store(visibility_key(scene, white_sky), to_bytes(find_field(other, nullptr).field));
  EXPECT_TRUE(find_field(scene, &cache).computed);
  EXPECT_EQ(find_field(scene, &cache).field.meshes.size(), 2U);
}

TEST(VisibilityCache, AnInterruptLeavesNothing) {
  const DiskCache cache(test::fresh_folder() / "cache");
  const Progress stop = [](std::string_view /*what*/, double /*fraction*/) {
    throw Error(ErrorKind::interrupted, "", "interrupted");
  };
  EXPECT_THROW((void)cached_visibility_field(two_squares(), white_sky, &cache, stop), Error);
  EXPECT_FALSE(fs::exists(cache.folder()));
}

TEST(VisibilityCache, TheKeyFollowsAllThatTheFieldDependsOn) {
  const Scene scene = two_squares();
  const std::string key = visibility_key(scene, white_sky);
  EXPECT_EQ(visibility_key(two_squares(), white_sky), key);
  EXPECT_NE(visibility_key(scene, constant_environment({1.0F, 1.0F, 2.0F})), key);
  const auto changed = [&](auto change) {
    Scene other = scene;
    change(other);
    return visibility_key(other, white_sky);
  };
  EXPECT_NE(changed([](Scene& s) { s.meshes[0].vertices[2].position.z += 1e-6F; }), key);
  EXPECT_NE(changed([](Scene& s) { s.meshes[1].vertices[0].normal = {1.0F, 0.0F, 0.0F}; }), key);
  EXPECT_NE(changed([](Scene& s) { std::swap(s.meshes[0].indices[0], s.meshes[0].indices[1]); }), key);
  EXPECT_NE(changed([](Scene& s) { s.meshes.pop_back(); }), key);
  EXPECT_NE(changed([](Scene& s) { s.bounds.upper.x += 1.0F; }), key);
  EXPECT_NE(changed([](Scene& s) { s.materials[0].alpha_cutoff = 0.5F; }), key);
  EXPECT_NE(changed([](Scene& s) { s.materials[0].double_sided = true; }), key);
  EXPECT_NE(changed([](Scene& s) { s.shadows.both_sides = true; }), key);
  EXPECT_NE(changed([](Scene& s) { s.horizon = Horizon::open; }), key);
  EXPECT_EQ(changed([](Scene& s) { s.meshes[0].vertices[0].color.a = 0.3F; }), key) << "nothing is cut out";
  EXPECT_EQ(changed([](Scene& s) { s.materials[0].roughness = 0.9F; }), key) << "nothing is cut out";
  EXPECT_EQ(changed([](Scene& s) { s.meshes[0].vertices[0].uv0 = {7.0F, 7.0F}; }), key);
  EXPECT_EQ(changed([](Scene& s) { s.lights.clear(); }), key);
  const auto cut_out = [&](float alpha) {
    return changed([&](Scene& s) {
      s.materials[0].alpha_cutoff = 0.5F;
      s.materials[0].base_color.a = alpha;
    });
  };
  EXPECT_NE(cut_out(0.25F), cut_out(0.75F));
  const std::string faint = changed([&](Scene& s) {
    s.materials[0].alpha_cutoff = 0.5F;
    s.materials[0].base_color.a = 0.75F;
    s.meshes[0].vertices[0].color.a = 0.5F;
  });
  EXPECT_NE(faint, cut_out(0.75F));
}

}  // namespace
}  // namespace footprint
