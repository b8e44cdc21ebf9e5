// What an effect leaves behind: nothing where a scene does not call for it, the same picture where it is compiled in
// with nothing to do, another picture where it has something to do.
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <memory>
#include <string>

#include "renderer/microgeometry/microgeometry.hpp"
#include "renderer/microgeometry/patch.hpp"
#include "renderer/pipeline/base_surface.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/shadow_scenes.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

// The scene that calls for least: one facet without terms, under one directional light low enough for Fresnel to show.
Scene least_scene() {
  Scene scene = square_scene({}, {.brdf = {NormalDistribution::ggx, GeometryTerm::none, FresnelTerm::none, false},
                                  .roughness = 0.8F,
                                  .base_color = glm::vec3(0.5F),
                                  .specular = glm::vec3(0.5F),
                                  .metallic = 0.0F});
  scene.lights = {DirectionalLight{.direction = {0.99F, 0.0F, -0.1410674F}, .illuminance = glm::vec3(10.0F)}};
  return scene;
}

TextureMap map_of(Image image) { return {"map", std::make_shared<const Image>(std::move(image)), {}}; }

Image halves(int channels, float left, float right) {
  Image image(2, 1, channels, left);
  for (auto i = static_cast<std::size_t>(channels); i < image.texels.size(); ++i) image.texels[i] = right;
  return image;
}

std::shared_ptr<const Microgeometry> microgeometry(const std::string& kind,
                                                   const std::map<std::string, std::string>& given = {}) {
  Patch patch = make_patch(find_patch_kind(kind), given);
  const glm::vec3 mean = patch_maps(patch, 32).mean_color;
  return std::make_shared<const Microgeometry>(Microgeometry{std::move(patch), mean});
}

ClearCoat rough_coat() {
  ClearCoat coat;
  coat.roughness = 0.5F;
  return coat;
}

// An effect, text that its code leaves in the shader, and what makes a scene call for it.
struct EffectCase {
  Effect effect;
  std::string trace;
  void (*call_for)(Scene&);
};

const auto cases = std::to_array<EffectCase>({
    {Effect::diffuse, "diffuse(", [](Scene& s) { s.materials[0].brdf.diffuse = true; }},
    {Effect::fresnel, "Schlick", [](Scene& s) { s.materials[0].brdf.fresnel = FresnelTerm::schlick; }},
    {Effect::masking_shadowing, "Smith", [](Scene& s) { s.materials[0].brdf.geometry = GeometryTerm::smith; }},
    {Effect::normal_variation, "base_normal",
     [](Scene& s) {
       s.materials[0].normal_map = map_of(constant_normals(2, 2, {0.6F, 0.0F, 0.8F}));
     }},
    {Effect::normal_layers, "base_layer",
     [](Scene& s) {
       s.materials[0].layer_map = map_of(constant_normals(2, 2, {0.6F, 0.0F, 0.8F}));
     }},
    {Effect::roughness_variation, "base_roughness",
     [](Scene& s) {
       s.materials[0].metallic = 0.0F;
       Image map(2, 1, 2, 0.0F);
       map.texels = {0.4F, 0.0F, 0.8F, 0.0F};
       s.materials[0].metallic_roughness_map = map_of(std::move(map));
     }},
    {Effect::multi_lobe, "facet_lobe",
     [](Scene& s) {
       s.materials[0].lobes = {{.axis = {0.6F, 0.0F, 0.8F}, .parameter = 0.4F, .weight = 0.5F},
                               {.axis = {-0.6F, 0.0F, 0.8F}, .parameter = 0.3F, .weight = 0.5F}};
     }},
    {Effect::anisotropic_lobe, "facetAlphas",
     [](Scene& s) {
       s.materials[0].anisotropy = Anisotropy{0.7F, 0.4F};
     }},
    {Effect::anisotropy_variation, "stretch_map",
     [](Scene& s) {
       s.materials[0].metallic = 0.0F;
       s.materials[0].metallic_roughness_map = map_of(halves(2, 0.4F, 0.4F));
       s.materials[0].anisotropy = Anisotropy{0.0F, 0.0F};
       s.materials[0].anisotropy_map = map_of(halves(2, 0.5F, -0.5F));
     }},
    {Effect::base_color_variation, "base_color_map",
     [](Scene& s) {
       s.materials[0].metallic = 1.0F;
       s.materials[0].base_color_map = map_of(halves(4, 1.0F, 0.5F));
     }},
    {Effect::vertex_color, "vertex_color",
     [](Scene& s) {
       s.materials[0].metallic = 1.0F;
       for (Vertex& vertex : s.meshes[0].vertices) vertex.color = {0.2F, 0.4F, 0.6F, 1.0F};
     }},
    {Effect::metallic_variation, "metallic_map",
     [](Scene& s) {
       s.materials[0].base_color = {1.0F, 0.0F, 0.0F, 1.0F};
       s.materials[0].metallic_roughness_map = map_of(halves(2, 0.5F, 0.9F));
     }},
    {Effect::specular_variation, "specular_map",
     [](Scene& s) { s.materials[0].specular_map = map_of(halves(3, 1.0F, 0.25F)); }},
    {Effect::clear_coat, "coatReflectance", [](Scene& s) { s.materials[0].coat = rough_coat(); }},
    {Effect::coat_weight_variation, "coat_weight_map",
     [](Scene& s) {
       s.materials[0].coat = rough_coat();
       s.materials[0].coat->weight_map = map_of(halves(1, 1.0F, 0.0F));
     }},
    {Effect::coat_width_variation, "coat_width_map",
     [](Scene& s) {
       s.materials[0].coat = ClearCoat{};
       s.materials[0].coat->roughness_map = map_of(halves(1, 0.9F, 0.5F));
     }},
    {Effect::coat_normal_variation, "coat_normal_map",
     [](Scene& s) {
       s.materials[0].coat = rough_coat();
       s.materials[0].coat->normal_map = map_of(constant_normals(2, 2, {0.6F, 0.0F, 0.8F}));
     }},
    {Effect::material_index, "material_share",
     [](Scene& s) {
       s.materials.push_back(s.materials[0]);
       s.materials[1].dielectric_specular = glm::vec3(0.1F);
       s.materials[0].share = SurfaceShare{map_of(halves(1, 1.0F, 0.0F)), true};
       s.materials[1].share = SurfaceShare{map_of(halves(1, 0.0F, 1.0F)), false};
       s.meshes.push_back(s.meshes[0]);
       s.meshes[1].material = 1;
     }},
    {Effect::alpha_mask, "discard",
     [](Scene& s) {
       s.materials[0].base_color.a = 0.3F;
       s.materials[0].alpha_cutoff = 0.5F;
     }},
    {Effect::unlit, "lobe_cutoff.z", [](Scene& s) { s.materials[0].unlit = true; }},
    {Effect::emission, "vec4 emitted;", [](Scene& s) { s.materials[0].emission = glm::vec3(0.5F); }},
    {Effect::emission_variation, "emission_uv_linear",
     [](Scene& s) {
       s.materials[0].emission = glm::vec3(0.5F);
       s.materials[0].emission_map = map_of(halves(3, 1.0F, 0.25F));
     }},
    {Effect::occlusion, "occlusion_map",
     [](Scene& s) {
       s.environment = constant_environment(glm::vec3(0.5F));
       s.materials[0].occlusion_map = map_of(halves(1, 1.0F, 0.25F));
     }},
    {Effect::double_sided, "gl_FrontFacing", [](Scene& s) { s.materials[0].double_sided = true; }},
    {Effect::point_light, "PointLight",
     [](Scene& s) {
       s.lights.emplace_back(PointLight{.position = {0, 0, 2}, .intensity = glm::vec3(2.0F), .range = {}});
     }},
    {Effect::spot_light, "SpotLight",
     [](Scene& s) {
       s.lights.emplace_back(SpotLight{.point = {.position = {0, 0, 2}, .intensity = glm::vec3(2.0F), .range = {}},
                                       .direction = {0, 0, -1}});
     }},
    {Effect::directional_light, "DirectionalLight",
     [](Scene& s) {
       s.lights.emplace_back(DirectionalLight{.direction = {0, 0, -1}, .illuminance = glm::vec3(1.0F)});
     }},
    {Effect::area_light, "AreaLight",
     [](Scene& s) {
       s.lights.emplace_back(AreaLight{.position = {0, 0, 2}, .intensity = glm::vec3(2.0F)});
     }},
    {Effect::cast_shadow, "shadow_maps",
     [](Scene& s) {
       s.meshes.push_back(box_mesh({-0.2F, -0.2F, 0.1F}, {0.2F, 0.2F, 0.3F}));
       fit_bounds(s);
     }},
    {Effect::environment_light, "environment_stack",
     [](Scene& s) { s.environment = constant_environment(glm::vec3(0.5F)); }},
    {Effect::microgeometry_visibility, "base_facets",
     [](Scene& s) { s.materials[0].microgeometry = microgeometry("pyramids"); }},
    {Effect::microgeometry_colour, "base_paints",
     [](Scene& s) {
       s.materials[0].metallic = 1.0F;
       s.materials[0].microgeometry = microgeometry("weave", {{"warp_red", "0"}});
     }},
    {Effect::tabulated_brdf, "base_table",
     [](Scene& s) {
       Microgeometry flat = *microgeometry("flat");
       flat.brdf = std::make_shared<const TabulatedBrdf>(ward_brdf(glm::vec3(0.5F), glm::vec3(0.1F), 0.3));
       s.materials[0].microgeometry = std::make_shared<const Microgeometry>(std::move(flat));
     }},
});

class EffectTrace : public ::testing::TestWithParam<EffectCase> {};

// The scene without the effect; a directional light is what the least scene has, so a point light takes its place.
Scene scene_without(Effect effect) {
  Scene scene = least_scene();
  if (effect == Effect::directional_light)
    scene.lights = {PointLight{.position = {0, 0, 2}, .intensity = glm::vec3(2.0F), .range = {}}};
  return scene;
}

TEST_P(EffectTrace, IsAbsentWhereTheSceneDoesNotCallForIt) {
  const EffectCase& c = GetParam();
  Scene without = scene_without(c.effect);
  Scene with = without;
  c.call_for(with);
  ASSERT_FALSE(has(effects_on(derive_effects(without)), c.effect));
  ASSERT_TRUE(has(effects_on(derive_effects(with)), c.effect));
  EXPECT_EQ(TestRenderer(without).fragment_text(base_surface()).find(c.trace), std::string::npos);
  EXPECT_NE(TestRenderer(with).fragment_text(base_surface()).find(c.trace), std::string::npos);
}

TEST_P(EffectTrace, ChangesNothingWithNothingToDo) {
  const EffectCase& c = GetParam();
  const Scene scene = scene_without(c.effect);
  EffectSet set = effects_on(derive_effects(scene));
  const Image plain = TestRenderer(scene).frame(base_surface());
  set.set(static_cast<std::size_t>(c.effect));
  // `diffuse` alone has a term of its own to be given nothing: a black albedo under an opaque specular.
  Scene idle = scene;
  if (c.effect == Effect::diffuse) idle.materials[0].base_color = {0, 0, 0, 1};
  EXPECT_LT(largest_difference(TestRenderer(idle, {64, 64}, set).frame(base_surface()), plain), 1e-5);
}

TEST_P(EffectTrace, ChangesThePictureWhereItHasSomethingToDo) {
  const EffectCase& c = GetParam();
  Scene scene = scene_without(c.effect);
  if (c.effect == Effect::double_sided)
    scene.camera.world = glm::mat4(1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, -3, 1);
  Scene with = scene;
  c.call_for(with);
  EXPECT_GT(largest_difference(TestRenderer(with).frame(base_surface()), TestRenderer(scene).frame(base_surface())),
            1e-3);
}

INSTANTIATE_TEST_SUITE_P(AllEffects, EffectTrace, ::testing::ValuesIn(cases),
                         [](const auto& test) { return std::string(effect_name(test.param.effect)); });

// Half of a surface each: what two materials leave is the sum of their shares, and covers as one does, at any filter.
TEST(MaterialIndex, SharesAddUpAndCoverOnce) {
  Scene both = least_scene();
  std::array single{least_scene(), least_scene()};
  single[1].materials[0].dielectric_specular = glm::vec3(0.1F, 0.3F, 0.2F);
  both.materials.push_back(single[1].materials[0]);
  both.meshes.push_back(both.meshes[0]);
  both.meshes[1].material = 1;
  both.materials[0].share = SurfaceShare{map_of(halves(1, 1.0F, 0.0F)), true};
  both.materials[1].share = SurfaceShare{map_of(halves(1, 0.0F, 1.0F)), false};
  for (auto& material : both.materials) material.share->map.coordinates.transform[0].x = 2.0F;
  const Image first = TestRenderer(single[0]).frame(base_surface());
  const Image second = TestRenderer(single[1]).frame(base_surface());
  TestRenderer renderer(both);
  const Image picture = renderer.frame(base_surface());
  const Image samples = renderer.reference(4).mean;
  for (std::size_t i = 0; i < picture.texel_count(); ++i) {
    const double whole = first.texels[4 * i] - second.texels[4 * i];
    const double share = (picture.texels[4 * i] - second.texels[4 * i]) / whole;
    ASSERT_GE(share, -1e-3);
    ASSERT_LE(share, 1.001);
    ASSERT_NEAR(picture.texels[4 * i + 1], share * first.texels[4 * i + 1] + (1.0 - share) * second.texels[4 * i + 1],
                1e-3);
    ASSERT_EQ(picture.texels[4 * i + 3], 1.0F);
    ASSERT_EQ(samples.texels[4 * i + 3], 1.0F);
  }
  // Texel centres of the map: at an eighth and three eighths of the picture's width.
  EXPECT_NEAR(picture.at(8, 32)[1], first.at(8, 32)[1], 0.07 * first.at(8, 32)[1]);
  EXPECT_NEAR(picture.at(24, 32)[1], second.at(24, 32)[1], 0.07 * first.at(24, 32)[1]);
}

// A sun apart is a part of the environment's light, and leaves no more behind than that.
TEST(EffectTrace, ASunOfAnEnvironmentIsInTheShaderWhereThereIsOne) {
  Scene scene = least_scene();
  scene.environment = constant_environment(glm::vec3(1.0F));
  EXPECT_EQ(TestRenderer(scene).fragment_text(base_surface()).find("environment_suns"), std::string::npos);
  Image map(512, 256, 3, 1.0F);
  for (float& channel : map.at(100, 30)) channel = 1e5F;
  scene.environment->radiance = std::make_shared<const Image>(std::move(map));
  EXPECT_NE(TestRenderer(scene).fragment_text(base_surface()).find("environment_suns"), std::string::npos);
}

TEST(EffectTrace, EveryEffectHasACase) { EXPECT_EQ(std::size(cases), effect_count); }

TEST(EffectTrace, TexturesAndBytesFollow) {
  Scene scene = least_scene();
  const auto bytes = [](const Scene& s) {
    const EffectSet set = effects_on(derive_effects(s));
    return bake(base_surface(), {.text = "r", .name = "r", .options = {}}, s, set, no_progress).bytes;
  };
  EXPECT_EQ(bytes(scene), 0U);
  EXPECT_EQ(TestRenderer(scene).gpu_scene().shared_bytes(), 0U);
  scene.materials[0].normal_map = map_of(constant_normals(8, 8, {0.6F, 0.0F, 0.8F}));
  EXPECT_EQ(bytes(scene), 8U * 8U * 16U);
  scene.materials[0].base_color_map = map_of(Image(2, 2, 4, 1.0F));
  EXPECT_EQ(TestRenderer(scene).gpu_scene().shared_bytes(), (4U + 1U) * 16U);
  EXPECT_FALSE(TestRenderer(scene).gpu_scene().shadow_maps());
}

// An effect that a method cannot honour is left out of its picture; all else stays.
TEST(EffectTrace, IsLeftOutByAMethodThatCannotHonourIt) {
  Scene scene = least_scene();
  const Image without = TestRenderer(scene).frame(base_surface());
  scene.materials[0].brdf.fresnel = FresnelTerm::schlick;
  const Method method{.info = {.name = "no_fresnel",
                               .summary = "",
                               .paper = "",
                               .options = {},
                               .honours = ~EffectSet{}.set(static_cast<std::size_t>(Effect::fresnel))},
                      .precompute =
                          [](const Material& m, const Options& o, const EffectSet& e, const Progress& p) {
                            EXPECT_FALSE(has(e, Effect::fresnel));
                            return base_surface().precompute(m, o, e, p);
                          },
                      .shader = base_surface().shader};
  EXPECT_LT(largest_difference(TestRenderer(scene).frame(method), without), 1e-6);
  EXPECT_GT(largest_difference(TestRenderer(scene).frame(base_surface()), without), 1e-3);
}

}  // namespace
}  // namespace footprint::testing
