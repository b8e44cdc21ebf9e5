// The content of materials and scenes includes every field, but not a material's names.
#include "renderer/scene/scene.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "renderer/microgeometry/microgeometry.hpp"

namespace footprint {
namespace {

std::string content(const Material& material) {
  ContentHash hash;
  add_content(hash, material);
  return hash.hex();
}

TextureMap map_of(float value) { return {"a map", std::make_shared<const Image>(2, 2, 4, value), {}}; }

// One that has everything.
Material whole_material() {
  Microgeometry small;
  small.patch = {"a patch", {1, 1}, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {0}, {{1, 1, 1}}};
  small.brdf = std::make_shared<const TabulatedBrdf>(TabulatedBrdf{{{1, 1, 1}}});
  Material material;
  material.name = "a material";
  material.lobe_parameter = 2.0F;
  material.lobes = {{}, {}};
  material.anisotropy = Anisotropy{};
  for (auto* const map : {&material.base_color_map, &material.metallic_roughness_map, &material.lobe_parameter_map,
                          &material.anisotropy_map, &material.specular_map, &material.emission_map,
                          &material.occlusion_map, &material.normal_map, &material.layer_map})
    *map = map_of(0.5F);
  material.coat = ClearCoat{};
  for (auto* const map : {&material.coat->weight_map, &material.coat->roughness_map, &material.coat->normal_map})
    *map = map_of(0.5F);
  material.share = {map_of(0.5F)};
  material.alpha_cutoff = 0.5F;
  material.microgeometry = std::make_shared<const Microgeometry>(small);
  return material;
}

using Change = std::function<void(Material&)>;

// A change of the small-scale geometry, which is shared and constant.
Change small_scale(const std::function<void(Microgeometry&)>& change) {
  return [change](Material& material) {
    Microgeometry small = *material.microgeometry;
    change(small);
    material.microgeometry = std::make_shared<const Microgeometry>(small);
  };
}

std::vector<Change> changes() {
  std::vector<Change> out{[](Material& m) { m.brdf.distribution = NormalDistribution::vmf; },
                          [](Material& m) { m.brdf.geometry = GeometryTerm::none; },
                          [](Material& m) { m.brdf.fresnel = FresnelTerm::none; },
                          [](Material& m) { m.brdf.diffuse = false; },
                          [](Material& m) { m.base_color.a = 0.5F; },
                          [](Material& m) { m.dielectric_specular.b = 0.5F; },
                          [](Material& m) { m.emission.g = 0.5F; },
                          [](Material& m) { m.metallic = 0.5F; },
                          [](Material& m) { m.roughness = 0.5F; },
                          [](Material& m) { m.lobe_parameter = 3.0F; },
                          [](Material& m) { m.lobe_parameter.reset(); },
                          [](Material& m) { m.lobes.pop_back(); },
                          [](Material& m) { m.lobes[1].axis.x = 0.5F; },
                          [](Material& m) { m.lobes[1].parameter = 0.5F; },
                          [](Material& m) { m.lobes[1].weight = 0.5F; },
                          [](Material& m) { m.anisotropy.reset(); },
                          [](Material& m) { m.anisotropy->strength = 0.5F; },
                          [](Material& m) { m.anisotropy->rotation = 0.5F; },
                          [](Material& m) { m.coat.reset(); },
                          [](Material& m) { m.coat->weight = 0.5F; },
                          [](Material& m) { m.coat->roughness = 0.5F; },
                          [](Material& m) { m.coat->weight_map = map_of(0.25F); },
                          [](Material& m) { m.coat->roughness_map = map_of(0.25F); },
                          [](Material& m) { m.coat->normal_map = map_of(0.25F); },
                          [](Material& m) { m.share.reset(); },
                          [](Material& m) { m.share->map = map_of(0.25F); },
                          [](Material& m) { m.share->first = false; },
                          [](Material& m) { m.alpha_cutoff = 0.25F; },
                          [](Material& m) { m.alpha_cutoff.reset(); },
                          [](Material& m) { m.double_sided = true; },
                          [](Material& m) { m.microgeometry.reset(); },
                          small_scale([](Microgeometry& s) { s.patch.period.y = 2.0F; }),
                          small_scale([](Microgeometry& s) { s.patch.vertices[1].z = 0.5F; }),
                          small_scale([](Microgeometry& s) {
                            s.patch.triangles[0] = {0, 2, 1};
                          }),
                          small_scale([](Microgeometry& s) { s.patch.paints.clear(); }),
                          small_scale([](Microgeometry& s) { s.patch.palette[0].r = 0.5F; }),
                          small_scale([](Microgeometry& s) { s.mean_color.r = 0.5F; }),
                          small_scale([](Microgeometry& s) { s.brdf.reset(); }),
                          small_scale([](Microgeometry& s) {
                            s.brdf = std::make_shared<const TabulatedBrdf>(TabulatedBrdf{{{1, 2, 1}}});
                          })};
  for (std::optional<TextureMap> Material::*const map :
       {&Material::base_color_map, &Material::metallic_roughness_map, &Material::lobe_parameter_map,
        &Material::anisotropy_map, &Material::specular_map, &Material::emission_map, &Material::occlusion_map,
        &Material::normal_map, &Material::layer_map}) {
    out.emplace_back([map](Material& m) { (m.*map).reset(); });
    out.emplace_back([map](Material& m) { m.*map = map_of(0.25F); });
    out.emplace_back([map](Material& m) { (m.*map)->image = std::make_shared<const Image>(4, 1, 4, 0.5F); });
    out.emplace_back([map](Material& m) { (m.*map)->coordinates.set = 1; });
    out.emplace_back([map](Material& m) { (m.*map)->coordinates.transform[2].y = 0.5F; });
    out.emplace_back([map](Material& m) { (m.*map)->coordinates.wrap[1] = Wrap::clamp_to_edge; });
  }
  return out;
}

TEST(MaterialContent, EveryFieldCounts) {
  std::set<std::string> found{content(whole_material())};
  const std::vector<Change> all = changes();
  for (std::size_t i = 0; i < all.size(); ++i) {
    Material material = whole_material();
    all[i](material);
    EXPECT_TRUE(found.insert(content(material)).second) << "change " << i;
  }
}

TEST(MaterialContent, NamesDoNotCount) {
  Material material = whole_material();
  material.name = "another";
  material.normal_map->name = "another";
  small_scale([](Microgeometry& s) { s.patch.name = "another"; })(material);
  EXPECT_EQ(content(material), content(whole_material()));
}

Scene whole_scene() {
  Scene scene;
  scene.name = "a scene";
  scene.meshes = {{"a mesh", {{}, {}, {}}, {0, 1, 2}, 0}};
  scene.materials = {whole_material()};
  scene.lights = {PointLight{}, SpotLight{}, DirectionalLight{}, AreaLight{}};
  scene.environment = Environment{"sky", std::make_shared<const Image>(2, 1, 3, 0.5F), 0.0F};
  scene.distances = {1.0, 2.0};
  scene.warnings = {"a warning"};
  return scene;
}

std::string content(const Scene& scene) {
  ContentHash hash;
  add_content(hash, scene);
  return hash.hex();
}

TEST(SceneContent, EveryFieldCounts) {
  const std::vector<std::function<void(Scene&)>> all{
      [](Scene& s) { s.name = "another"; },
      [](Scene& s) { s.meshes[0].name = "another"; },
      [](Scene& s) { s.meshes[0].vertices[1].uv1.y = 0.5F; },
      [](Scene& s) { s.meshes[0].vertices[2].color.a = 0.5F; },
      [](Scene& s) { s.meshes[0].indices[2] = 1; },
      [](Scene& s) { s.meshes[0].material = 1; },
      [](Scene& s) { s.materials[0].roughness = 0.5F; },
      [](Scene& s) { s.materials[0].name = "another"; },
      [](Scene& s) { std::get<PointLight>(s.lights[0]).range = 2.0F; },
      [](Scene& s) { std::get<SpotLight>(s.lights[1]).outer_cone_angle = 0.5F; },
      [](Scene& s) { std::get<SpotLight>(s.lights[1]).point.intensity.b = 0.5F; },
      [](Scene& s) { std::get<DirectionalLight>(s.lights[2]).illuminance.g = 0.5F; },
      [](Scene& s) { std::get<AreaLight>(s.lights[3]).half_size.y = 0.25F; },
      [](Scene& s) { std::get<AreaLight>(s.lights[3]).integral = AreaIntegral::points; },
      [](Scene& s) { std::swap(s.lights[0], s.lights[2]); },
      [](Scene& s) { s.shadows.cast = true; },
      [](Scene& s) { s.shadows.resolution = 64; },
      [](Scene& s) { s.horizon = Horizon::open; },
      [](Scene& s) { s.environment->rotation = 0.5F; },
      [](Scene& s) { s.environment->radiance = std::make_shared<const Image>(2, 1, 3, 0.25F); },
      [](Scene& s) { s.environment.reset(); },
      [](Scene& s) { s.camera.world[3].x = 0.5F; },
      [](Scene& s) { s.camera.aspect = 2.0F; },
      [](Scene& s) { s.bounds.upper.z = 0.5F; },
      [](Scene& s) { s.footprint = FootprintFilter{}; },
      [](Scene& s) { s.exposure = 0.5F; },
      [](Scene& s) {
        s.distances = {1.0, 3.0};
      },
      [](Scene& s) { s.frame_size = glm::ivec2(3, 4); },
      [](Scene& s) { s.defaults = {"a default"}; },
      [](Scene& s) { s.warnings.clear(); }};
  std::set<std::string> found{content(whole_scene())};
  for (std::size_t i = 0; i < all.size(); ++i) {
    Scene scene = whole_scene();
    all[i](scene);
    EXPECT_TRUE(found.insert(content(scene)).second) << "change " << i;
  }
}

TEST(SceneContent, WhereItCameFromDoesNotCount) {
  Scene scene = whole_scene();
  scene.source = "elsewhere";
  EXPECT_EQ(content(scene), content(whole_scene()));
}

}  // namespace
}  // namespace footprint
