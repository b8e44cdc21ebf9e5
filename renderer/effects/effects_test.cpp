// Which effects follow from a scene, and the reasons given.
#include "renderer/effects/effects.hpp"

#include <gtest/gtest.h>

#include <memory>

#include <set>

#include "renderer/scene/geometry.hpp"

namespace footprint {
namespace {

TextureMap map_of(Image image) { return {"map", std::make_shared<const Image>(std::move(image)), {}}; }

Scene plain_scene() {
  Scene scene;
  scene.materials.emplace_back();
  scene.materials[0].metallic = 0.0F;
  scene.lights.emplace_back(PointLight{});
  return scene;
}

EffectDecision decision(const Scene& scene, Effect effect) {
  return derive_effects(scene).at(static_cast<std::size_t>(effect));
}

bool on(const Scene& scene, Effect effect) { return decision(scene, effect).on; }

TEST(Effects, ComeInOrderEachWithAReason) {
  const auto decisions = derive_effects(plain_scene());
  ASSERT_EQ(decisions.size(), effect_count);
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < effect_count; ++i) {
    EXPECT_EQ(decisions[i].effect, static_cast<Effect>(i));
    EXPECT_FALSE(decisions[i].reason.empty());
    names.insert(effect_name(decisions[i].effect));
  }
  EXPECT_EQ(names.size(), effect_count);
}

TEST(Effects, PlainSceneCallsForItsLightAndBaseBrdfAlone) {
  const EffectSet set = effects_on(derive_effects(plain_scene()));
  EXPECT_EQ(effect_names(set), (std::vector<std::string>{"diffuse", "fresnel", "masking_shadowing", "point_light"}));
}

TEST(Effects, MetalHasNoDiffuseTerm) {
  Scene scene = plain_scene();
  scene.materials[0].metallic = 1.0F;
  EXPECT_FALSE(on(scene, Effect::diffuse));
  scene.materials[0].metallic_roughness_map = map_of(Image(1, 1, 2, 0.0F));  // says where it is none
  EXPECT_TRUE(on(scene, Effect::diffuse));
  scene.materials[0].metallic_roughness_map.reset();
  scene.materials[0].metallic = 0.0F;
  scene.materials[0].base_color = {0, 0, 0, 1};
  EXPECT_FALSE(on(scene, Effect::diffuse));
}

TEST(Effects, TermsOfTheBaseBrdfFollowIt) {
  Scene scene = plain_scene();
  scene.materials[0].brdf = {NormalDistribution::blinn_phong, GeometryTerm::none, FresnelTerm::none, false};
  for (const Effect effect : {Effect::diffuse, Effect::fresnel, Effect::masking_shadowing})
    EXPECT_FALSE(on(scene, effect));
}

TEST(Effects, ConstantNormalMapIsOffOnlyIfFlat) {
  Scene scene = plain_scene();
  EXPECT_EQ(decision(scene, Effect::normal_variation).reason, "no normal map");
  Image normals(2, 2, 4, 0.0F);
  for (std::size_t i = 0; i < 16; i += 4) normals.texels[i + 2] = normals.texels[i + 3] = 1.0F;
  scene.materials[0].normal_map = map_of(normals);
  EXPECT_FALSE(on(scene, Effect::normal_variation));
  EXPECT_EQ(decision(scene, Effect::normal_variation).reason, "every normal map is flat");
  normals.texels[3] = 0.0F;  // a texel that does not count must still be left out
  scene.materials[0].normal_map = map_of(normals);
  EXPECT_TRUE(on(scene, Effect::normal_variation));
  for (std::size_t i = 0; i < 16; i += 4) normals.texels[i] = 0.6F;
  scene.materials[0].normal_map = map_of(normals);
  EXPECT_TRUE(on(scene, Effect::normal_variation));
}

TEST(Effects, MapsCountWhereTheyVary) {
  Scene scene = plain_scene();
  Image map(2, 1, 2, 0.5F);
  scene.materials[0].metallic_roughness_map = map_of(map);
  EXPECT_FALSE(on(scene, Effect::roughness_variation));
  EXPECT_FALSE(on(scene, Effect::metallic_variation));
  map.texels[2] = 0.7F;
  scene.materials[0].metallic_roughness_map = map_of(map);
  EXPECT_TRUE(on(scene, Effect::roughness_variation));
  EXPECT_FALSE(on(scene, Effect::metallic_variation));
  scene.materials[0].lobe_parameter = 0.2F;
  EXPECT_FALSE(on(scene, Effect::roughness_variation));
}

TEST(Effects, LobeParameterMapsCountWhereTheyVary) {
  Scene scene = plain_scene();
  Image map(2, 1, 1, 50.0F);
  scene.materials[0].lobe_parameter_map = map_of(map);
  EXPECT_FALSE(on(scene, Effect::roughness_variation));
  map.texels[1] = 400.0F;
  scene.materials[0].lobe_parameter_map = map_of(map);
  EXPECT_TRUE(on(scene, Effect::roughness_variation));
  scene.materials[0].lobes = {FacetLobe{}};
  EXPECT_FALSE(on(scene, Effect::roughness_variation));
  EXPECT_TRUE(on(scene, Effect::multi_lobe));
}

TEST(Effects, MapsOfAnisotropyCountWhereTheyVary) {
  Scene scene = plain_scene();
  scene.materials[0].metallic_roughness_map = map_of(Image(2, 1, 2, 0.5F));
  scene.materials[0].anisotropy = Anisotropy{0.0F, 0.0F};
  Image axes(2, 1, 2, 0.0F);
  scene.materials[0].anisotropy_map = map_of(axes);
  for (const Effect effect : {Effect::anisotropic_lobe, Effect::anisotropy_variation, Effect::roughness_variation})
    EXPECT_FALSE(on(scene, effect));
  axes.texels = {0.0F, 0.4F, 0.0F, -0.4F};  // axes across each other: the mean is round
  scene.materials[0].anisotropy_map = map_of(axes);
  for (const Effect effect : {Effect::anisotropic_lobe, Effect::anisotropy_variation, Effect::roughness_variation})
    EXPECT_TRUE(on(scene, effect));
}

TEST(Effects, SpecularMapsCountWhereTheyVaryInAnyChannel) {
  Scene scene = plain_scene();
  Image map(1, 2, 3, 0.5F);
  scene.materials[0].specular_map = map_of(map);
  EXPECT_FALSE(on(scene, Effect::specular_variation));
  map.texels[5] = 0.6F;
  scene.materials[0].specular_map = map_of(map);
  EXPECT_TRUE(on(scene, Effect::specular_variation));
}

TEST(Effects, VertexColoursCountWhereOneIsNotWhite) {
  Scene scene = plain_scene();
  scene.meshes = {make_plane({2, 2}, {1, 1}), make_plane({1, 1}, {1, 1})};
  EXPECT_FALSE(on(scene, Effect::vertex_color));
  scene.meshes[1].vertices[3].color.a = 0.5F;
  EXPECT_EQ(decision(scene, Effect::vertex_color).reason, "1 of 2 meshes: vertices with colours");
}

TEST(Effects, OneMaterialOfManyIsEnoughAndIsCounted) {
  Scene scene = plain_scene();
  scene.materials.push_back(scene.materials[0]);
  scene.materials[1].alpha_cutoff = 0.5F;
  scene.materials[1].double_sided = true;
  EXPECT_EQ(decision(scene, Effect::alpha_mask).reason, "1 of 2 materials: parts cut out by alpha");
  EXPECT_TRUE(on(scene, Effect::double_sided));
}

TEST(Effects, ABlackEnvironmentIsNone) {
  Scene scene = plain_scene();
  EXPECT_EQ(decision(scene, Effect::environment_light).reason, "no environment");
  scene.environment = constant_environment(glm::vec3(0.0F));
  EXPECT_FALSE(on(scene, Effect::environment_light));
  scene.environment = constant_environment(glm::vec3(0.0F, 1e-6F, 0.0F));
  EXPECT_TRUE(on(scene, Effect::environment_light));
}

TEST(Effects, SmallSunsAreCounted) {
  Scene scene = plain_scene();
  Image map(512, 256, 3, 0.0F);
  for (float& channel : map.at(100, 60)) channel = 3e4F;
  const auto reason = [&] {
    scene.environment = Environment{.name = "lamps", .radiance = std::make_shared<const Image>(map)};
    return decision(scene, Effect::environment_light).reason;
  };
  EXPECT_TRUE(reason().ends_with("whose small sun, 100% of its light, methods take as a directional light"))
      << reason();
  for (float& channel : map.at(300, 70)) channel = 1e4F;
  EXPECT_TRUE(reason().ends_with("whose 2 small suns, 100% of its light, methods take as directional lights"))
      << reason();
}

// A square facing +z, under `height` of which another hovers.
Scene two_squares(float height) {
  Scene scene = plain_scene();
  scene.meshes = {make_plane({2, 2}, {1, 1}), make_plane({1, 1}, {1, 1})};
  for (Vertex& vertex : scene.meshes[1].vertices) vertex.position.z = height;
  scene.bounds = {{-1, -1, 0}, {1, 1, height}};
  scene.lights = {PointLight{.position = {0, 0, 3}, .intensity = glm::vec3(1), .range = {}},
                  DirectionalLight{.direction = {0, 0, 1}, .illuminance = glm::vec3(0)}};
  return scene;
}

TEST(Effects, ShadowsAreCastIfSomethingIsInTheWay) {
  Scene scene = two_squares(1.0F);
  EXPECT_EQ(decision(scene, Effect::cast_shadow).reason, "1 of 2 lights: something is before a surface");
  EXPECT_TRUE(on(scene, Effect::cast_shadow));
  scene.meshes.pop_back();
  EXPECT_EQ(decision(scene, Effect::cast_shadow).reason, "nothing is between a surface and a light");
  EXPECT_FALSE(on(scene, Effect::cast_shadow));
}

TEST(Effects, ShadowsFollowTheSceneWhereItSaysSo) {
  Scene scene = two_squares(1.0F);
  scene.shadows.cast = false;
  EXPECT_EQ(decision(scene, Effect::cast_shadow).reason, "switched off by the scene");
  scene.shadows.cast = true;
  scene.meshes.pop_back();
  EXPECT_TRUE(on(scene, Effect::cast_shadow));
  scene.lights.clear();
  EXPECT_FALSE(on(scene, Effect::cast_shadow));
}

TEST(Effects, LightsAreCountedByKind) {
  Scene scene = plain_scene();
  scene.lights = {DirectionalLight{}, DirectionalLight{}, SpotLight{}};
  EXPECT_FALSE(on(scene, Effect::point_light));
  EXPECT_EQ(decision(scene, Effect::directional_light).reason, "2 directional lights");
  EXPECT_EQ(decision(scene, Effect::spot_light).reason, "1 spot light");
}

}  // namespace
}  // namespace footprint
