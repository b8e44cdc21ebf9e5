// What the frame build's map holds, against sums in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "renderer/bake/baked_method.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/image/mipmap.hpp"
#include "renderer/pipeline/surface_program.hpp"
#include "tests/methods/built_map.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

// The part that a normal lies in, written once more by angles.
int cell_twin(const glm::dvec3& n, bool azimuth) {
  const double radius = std::hypot(n.x, n.y);
  const double angle = std::atan2(n.y, n.x);
  if (!azimuth)
    return 2 * std::min(static_cast<int>(radius / 0.25), 3) + (std::abs(angle) <= std::numbers::pi / 2 ? 0 : 1);
  const int sector = (static_cast<int>(std::lround(angle / (std::numbers::pi / 2))) + 4) % 4;
  return 2 * sector + (radius < 0.5 ? 0 : 1);
}

struct MapCase {
  std::string j;
  bool azimuth, camera;
};

class XuMap : public ::testing::TestWithParam<MapCase> {};

Image checked_normals() {
  Image normals = random_normals(13, 7, 0.9F, 11);
  for (int x = 0; x < 5; ++x) normals.at(x, 3)[3] = 0.0F;
  std::ranges::fill(normals.at(6, 2), 0.0F);
  std::fill_n(normals.at(7, 2).begin(), 3, 0.0F);  // no direction, though the map says that it has one
  return normals;
}

// (r, 1) of the texels of a map with a roughness map: of all, and of those whose lobes lie in each of 8 cells, where
// the surface is turned.
std::vector<Image> finest_twin(const Image& normals, const Image& roughness, bool azimuth, const glm::dmat3& turned) {
  std::vector<Image> out(9, Image(normals.width, normals.height, 4, 0.0F));
  for (int y = 0; y < normals.height; ++y) {
    for (int x = 0; x < normals.width; ++x) {
      const auto texel = normals.at(x, y);
      if (texel[3] < 0.5F || (texel[0] == 0.0F && texel[2] == 0.0F)) continue;
      const glm::dvec3 n = turned * glm::normalize(glm::dvec3(texel[0], texel[1], texel[2]));
      const double alpha = std::pow(roughness.at(x, y)[0], 2.0);
      const glm::dvec3 r = (1.0 - shortfall_twin(2.0 / (alpha * alpha) - 1.0)) * n;  // kappa = s + 1
      for (const std::size_t layer : {0, 1 + cell_twin(n, azimuth)}) {
        const auto value = out[layer].at(x, y);
        for (int c = 0; c < 3; ++c) value[static_cast<std::size_t>(c)] = static_cast<float>(r[c]);
        value[3] = 1.0F;
      }
    }
  }
  return out;
}

// Half floats are rounded to the nearest, by up to 2^-12, at each level; others give the mean of what is covered, xyz /
// w, to 1e-5.
void expect_levels(const BuiltMap& map, std::string_view name, const std::vector<Image>& layers, std::size_t first,
                   bool half) {
  for (std::size_t layer = 0; layer < layers.size(); ++layer) {
    const std::vector<Image> chain = mip_chain(layers[layer]);
    for (std::size_t level = first; level < chain.size(); ++level) {
      const Image got = map.level(name, level - first);
      const Image& want = chain[level];
      const float rounded = 2.5e-4F * static_cast<float>(level + 1);
      for (std::size_t i = 0; i < want.texels.size(); ++i) {
        const float covered = want.texels[i / 4 * 4 + 3];
        EXPECT_NEAR(got.texels[layer * want.texels.size() + i], want.texels[i], half ? rounded : 1e-5F * covered)
            << layer << ", " << level;
      }
    }
  }
}

Image sum_of(const Image& a, const Image& b) {
  Image sum = a;
  std::ranges::transform(a.texels, b.texels, sum.texels.begin(), std::plus());
  return sum;
}

// The parts that a map stores, of `finest_twin`'s layers: cells, pairs of them, or the hemisphere with pairs before
// their cells.
std::vector<Image> parts_twin(const std::vector<Image>& finest, const std::string& j) {
  std::vector<Image> out;
  if (j == "adaptive") out.push_back(finest[0]);
  for (std::size_t i = 1; i < finest.size(); i += 2) {
    if (j != "8") out.push_back(sum_of(finest[i], finest[i + 1]));
    if (j != "4") out.insert(out.end(), {finest[i], finest[i + 1]});
  }
  return out;
}

// Every level of every layer of a map of odd sizes with holes and a roughness map: the mean of (r, 1) over the texels
// under it, so that (xyz / w) is the mean of the covered ones.
TEST_P(XuMap, HoldsTheMeansOfTheCoveredTexels) {
  const auto& [j, azimuth, camera] = GetParam();
  const Image normals = checked_normals();
  Image roughness(13, 7, 1);
  for (std::size_t i = 0; i < roughness.texels.size(); ++i)
    roughness.texels[i] = 0.2F + 0.7F * static_cast<float>(i % 9) / 9.0F;
  const Words words{
      {"j", j}, {"partition", azimuth ? "azimuth" : "latitude"}, {"space", camera ? "camera" : "tangent"}};
  const glm::mat3 turned = turn(40, {0.6F, 0.8F, 0.0F});
  Scene scene = rough_square(normals, roughness);
  turn_meshes(scene, turned);
  const std::vector<Image> finest =
      finest_twin(normals, roughness, azimuth, glm::dmat3(camera ? turned : glm::mat3(1)));
  for (const bool half : {false, true}) {
    Words stored = words;
    if (half) stored["storage"] = "fp16";
    const BuiltMap map(scene, stored);
    if (j == "1") expect_levels(map, "xu_vmf_whole", {finest[0]}, 0, half);
    if (j != "1") expect_levels(map, "xu_vmf_parts", parts_twin(finest, j), 1, half);
  }
}

// With specular=joint texels weigh by the luminance of their specular colour over the largest; without a map of colours
// nothing changes.
TEST(XuMap, WeighsTexelsByTheirSpecularColour) {
  const Image normals = checked_normals();
  Image roughness(13, 7, 1), colours(13, 7, 3);
  for (std::size_t i = 0; i < roughness.texels.size(); ++i) {
    roughness.texels[i] = 0.2F + 0.7F * static_cast<float>(i % 9) / 9.0F;
    for (std::size_t c = 0; c < 3; ++c) colours.texels[3 * i + c] = 0.1F + 0.4F * static_cast<float>(i % 5) / 4.0F;
  }
  Scene scene = rough_square(normals, roughness);
  scene.materials[0].specular_map = TextureMap{"colours", std::make_shared<Image>(colours), {}};
  std::vector<Image> finest = finest_twin(normals, roughness, true, glm::dmat3(1.0));
  const std::vector<Image> plain = finest;
  for (Image& layer : finest) {
    for (std::size_t i = 0; i < layer.texels.size(); ++i) layer.texels[i] *= 2.0F * colours.texels[3 * (i / 4)];
  }
  for (const std::string space : {"tangent", "camera"}) {
    expect_levels(BuiltMap(scene, {{"specular", "joint"}, {"j", "8"}, {"space", space}}), "xu_vmf_parts",
                  parts_twin(finest, "8"), 1, false);
  }
  expect_levels(BuiltMap(scene, {{"j", "8"}}), "xu_vmf_parts", parts_twin(plain, "8"), 1, false);
  expect_levels(BuiltMap(rough_square(normals, roughness), {{"specular", "joint"}, {"j", "8"}}), "xu_vmf_parts",
                parts_twin(plain, "8"), 1, false);
}

// A map of colours that lies elsewhere cannot be joined texel by texel: a note says so, and it has no weight.
TEST(XuMap, LeavesColoursThatLieElsewhere) {
  Scene scene = rough_square(checked_normals(), Image(13, 7, 1, 0.5F));
  const auto colours = std::make_shared<Image>(2, 2, 3, 0.5F);
  colours->at(0, 0)[1] = 1.0F;
  scene.materials[0].specular_map = TextureMap{"colours", colours, {}};
  scene.materials[0].specular_map->coordinates.transform = {3.0F, 0.0F, 0.0F, 2.0F, 0.3F, 0.1F};
  const BuiltMap joint(scene, {{"specular", "joint"}, {"j", "8"}});
  ASSERT_FALSE(joint.baked().notes.empty());
  EXPECT_NE(joint.baked().notes.back().find("cannot be joined"), std::string::npos);
  EXPECT_EQ(joint.level("xu_vmf_parts", 0).texels, BuiltMap(scene, {{"j", "8"}}).level("xu_vmf_parts", 0).texels);
}

std::vector<MapCase> map_cases() {
  std::vector<MapCase> cases;
  for (const std::string j : {"1", "4", "8", "adaptive"}) {
    for (const bool azimuth : {true, false}) {
      for (const bool camera : {false, true}) cases.push_back({j, azimuth, camera});
    }
  }
  return cases;
}

INSTANTIATE_TEST_SUITE_P(All, XuMap, ::testing::ValuesIn(map_cases()), [](const auto& test) {
  return "j_" + test.param.j + (test.param.azimuth ? "_azimuth" : "_latitude") +
         (test.param.camera ? "_camera" : "_tangent");
});

// What the parts hold of r under a footprint is what the whole hemisphere has there, between the texels and between the
// levels too, where the finest level of a part is put together from the whole's.
TEST(XuParts, MakeUpTheWholeUnderAnyFootprint) {
  const Scene scene = blinn_phong_square(random_normals(16, 8, 0.7F, 41), 100);
  ProbeInputs footprints;
  for (const float texels : {0.3F, 1.0F, 1.4F, 2.0F, 3.0F, 9.0F}) {
    for (int i = 0; i < 40; ++i) {
      const auto along = static_cast<float>(i);
      footprints.push_back({glm::vec4(0.137F * along, 0.071F * along, texels / 16.0F, texels / 8.0F), {}, {}});
    }
  }
  const std::string sum =
      "footprints.normal = Footprint(a.xy, vec2(a.z, 0.0), vec2(0.0, a.w));\ne = effective(footprints);\n"
      "vec3 sum = vec3(0.0);\nfor (int i = 0; i < e.count; ++i) sum += weights[i].y * lobes[i].xyz;\n"
      "return vec4(sum * (1.0 - facetsLobeAt(footprints, 0).shortfall), 0.0);";
  const std::vector<glm::vec4> whole = BuiltMap(scene, {{"j", "1"}}).probe(sum, footprints);
  for (const std::string j : {"4", "8"}) {
    const std::vector<glm::vec4> parts = BuiltMap(scene, {{"j", j}}).probe(sum, footprints);
    for (std::size_t i = 0; i < whole.size(); ++i)
      EXPECT_LT(glm::length(parts[i] - whole[i]), 5e-4F) << j << ", footprint " << i;
  }
}

// The map is what the frame's BRDF says, and nothing of the frame before stays in it.
TEST(XuFrameBuild, AChangedBrdfGivesTheMapOfAColdStart) {
  const Image normals = random_normals(9, 6, 0.5F, 13);
  const BuiltMap sharp(blinn_phong_square(normals, 400));
  const BuiltMap broad(blinn_phong_square(normals, 20));
  const Image cold = sharp.level("xu_vmf_parts", 1);
  EXPECT_NE(broad.level("xu_vmf_parts", 1), cold);
  broad.build_for(sharp);
  EXPECT_EQ(broad.level("xu_vmf_parts", 1), cold);
}

TEST(XuFrameBuild, JoinsMapsOfDifferentSizesAndSaysWhereItCannot) {
  const Image normals = random_normals(8, 8, 0.5F, 14);
  Image roughness(4, 16, 1, 0.3F);
  roughness.at(0, 0)[0] = 0.9F;
  Scene scene = rough_square(normals, roughness);
  const BuiltMap joined(scene);
  EXPECT_EQ(joined.baked().textures.front().levels.front().width, 8);
  EXPECT_EQ(joined.baked().textures.front().levels.front().height, 16);
  EXPECT_TRUE(joined.baked().notes.empty());
  scene.materials[0].metallic_roughness_map->coordinates.set = 1;
  const BuiltMap apart(scene);
  EXPECT_EQ(apart.baked().textures.front().levels.front().height, 8);
  ASSERT_EQ(apart.baked().notes.size(), 1U);
  EXPECT_NEAR(apart.energy(), 1.0, 0.02);
}

TEST(XuFrameBuild, IsNotThereWhereNothingVaries) {
  const Options options(xu_vmf_method().info.options, {}, "xu_vmf");
  const Material material = blinn_phong_square(constant_normals(4, 4, {0, 0, 1}), 100).materials[0];
  EXPECT_EQ(xu_vmf_method().frame_build({}, options), nullptr);
  EXPECT_TRUE(xu_vmf_method().precompute(material, options, {}, no_progress).textures.empty());
}

// The draws and copies of a build, added up.
struct BuildTotals {
  double written = 0, copied = 0;  // bytes
  double lookups = 0;
};

struct BuiltBytes {
  double all = 0, coarser = 0;  // of all levels, and of those that are not the finest
};

BuildTotals totals_of(const RecordedDraws& draws) {
  BuildTotals totals;
  for (const RecordedDraw& draw : draws) {
    for (const ColorTarget& target : draw.targets)
      (draw.fragment.empty() ? totals.copied : totals.written) += draw.pixels * target.bytes();
    totals.lookups += draw.pixels * draw.lookups;
  }
  return totals;
}

BuiltBytes built_bytes(const Prefiltered& baked) {
  BuiltBytes bytes;
  for (const PrefilteredTexture& texture : baked.textures) {
    if (!texture.built) continue;
    const auto all = static_cast<double>(byte_count(texture));
    const TextureLevel& finest = texture.levels.front();
    const double texel_bytes = texture.channels * (texture.storage == Storage::fp16 ? 2.0 : 4.0);
    bytes.all += all;
    bytes.coarser += all - texel_bytes * finest.width * finest.height * texture.layers;
  }
  return bytes;
}

// The passes of a frame of a square with such maps.
RecordedDraws passes_of(const Scene& scene, const Words& words, Prefiltered& baked) {
  const EffectSet effects = effects_on(derive_effects(scene));
  GpuScene gpu_scene(shared_context().info(), scene, effects);
  const Options options(xu_vmf_method().info.options, words, "xu_vmf");
  const BakedMethod method =
      bake(xu_vmf_method(), {.text = "xu_vmf", .name = "xu_vmf", .options = words}, scene, effects, no_progress);
  const GpuMethod gpu(gpu_scene, method);
  baked = method.materials.front();
  RecordedDraws draws = gpu.draws_per_frame({.size = {8, 8}, .camera = scene.camera});
  shared_context().check("recording a build");
  return draws;
}

// Each texel is drawn once, and each below the finest level is copied once, for any size, partition and storage.
TEST(XuFrameBuild, WritesEachTexelOnceAndCopiesTheCoarserLevels) {
  const Scene odd = rough_square(random_normals(13, 7, 0.6F, 5), Image(13, 7, 1, 0.3F));
  Scene rough = rough_square(random_normals(16, 8, 0.6F, 5), Image(16, 8, 1, 0.3F));
  for (const Scene& scene : {odd, rough}) {
    for (const Words& words : {Words{{"j", "1"}}, Words{{"j", "8"}}, Words{}, Words{{"storage", "fp16"}}}) {
      Prefiltered baked;
      const BuildTotals totals = totals_of(passes_of(scene, words, baked));
      const BuiltBytes bytes = built_bytes(baked);
      EXPECT_GT(bytes.all, 0);
      EXPECT_EQ(totals.written, bytes.all);
      EXPECT_EQ(totals.copied, bytes.coarser);
    }
  }
}

// With even sizes each finer texel is read once: 16 x 8 of the whole, then 8 x 4, 4 x 2 and 2 x 1 of 4 parts.
TEST(XuFrameBuild, ReadsEachFinerTexelOnce) {
  const Scene scene = blinn_phong_square(random_normals(16, 8, 0.6F, 5), 100);
  Prefiltered baked;
  const RecordedDraws draws = passes_of(scene, {{"j", "4"}}, baked);
  EXPECT_EQ(totals_of(draws).lookups, 16 * 8 + 4 * (8 * 4 + 4 * 2 + 2 * 1));
  EXPECT_EQ(draws.front().pixels, 16 * 8);
  EXPECT_TRUE(passes_of(scene, {{"j", "4"}, {"rebuild", "changed"}}, baked).empty());
}

// A facet with two lobes has layers for each, and one of normals.
TEST(XuMap, HasTheLobesOfAFacetInLayersOfTheirOwn) {
  const Image normals = random_normals(8, 8, 0.6F, 21);
  Scene scene = blinn_phong_square(normals, 100);
  const float slant = std::sqrt(0.5F);
  scene.materials[0].lobe_parameter.reset();
  scene.materials[0].lobes = {{{slant, 0.0F, slant}, 50.0F, 0.7F}, {{0.0F, 0.0F, 1.0F}, 200.0F, 0.3F}};
  const BuiltMap map(scene);
  const Image whole = map.level("xu_vmf_whole", 0);
  ASSERT_EQ(whole.height, 3 * 8);
  EXPECT_EQ(map.level("xu_vmf_parts", 0).height, 2 * 13 * 4);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      const auto texel = normals.at(x, y);
      const glm::dvec3 n = glm::normalize(glm::dvec3(texel[0], texel[1], texel[2]));
      // The rotation from z to n, about cross(z, n), by Rodrigues' formula.
      const glm::dvec3 about(-n.y, n.x, 0.0);
      const glm::dvec3 axis(slant, 0.0, slant);
      const glm::dvec3 turned = axis * n.z + glm::cross(about, axis) + about * glm::dot(about, axis) / (1.0 + n.z);
      const std::array expected{(1.0 - shortfall_twin(51.0)) * turned, (1.0 - shortfall_twin(201.0)) * n, n};
      for (int layer = 0; layer < 3; ++layer) {
        for (int c = 0; c < 3; ++c) {
          EXPECT_NEAR(whole.at(x, y + 8 * layer)[static_cast<std::size_t>(c)],
                      expected[static_cast<std::size_t>(layer)][c], 1e-5);
        }
      }
    }
  }
}

TEST(BuiltMapOfAConstantMap, HasItsOneLobe) {
  const std::vector<MapLobe> lobes =
      BuiltMap(blinn_phong_square(constant_normals(4, 4, {0.28F, 0, 0.96F}), 100)).lobes();
  ASSERT_EQ(lobes.size(), 1U);
  EXPECT_NEAR(lobes[0].share, 1.0, 1e-6);
  EXPECT_LT(glm::length(lobes[0].mean - glm::dvec3(0.28, 0, 0.96)), 1e-5);
  EXPECT_NEAR(lobes[0].kappa, 101.0, 0.01);
}

// Each with its own parts and half the weight.
TEST(XuMap, OfTwoEqualLobesShowsOne) {
  Scene scene = blinn_phong_square(random_normals(64, 64, 0.6F, 42), 100);
  scene.materials[0].brdf.diffuse = false;
  const Image one = TestRenderer(scene).frame(xu_vmf_method(), "xu_vmf:j=8", {}, 0, 2.0);
  ASSERT_GT(covered_mean(one), 1e-3);
  scene.materials[0].lobe_parameter.reset();
  scene.materials[0].lobes = {{{0.0F, 0.0F, 1.0F}, 100.0F, 0.5F}, {{0.0F, 0.0F, 1.0F}, 100.0F, 0.5F}};
  EXPECT_LT(largest_difference(TestRenderer(scene).frame(xu_vmf_method(), "xu_vmf:j=8", {}, 0, 2.0), one), 1e-4);
}

}  // namespace
}  // namespace footprint::testing
