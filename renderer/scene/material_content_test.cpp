// What tells materials apart: every field does, names do not.
#include "renderer/scene/material_content.hpp"

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
  for (auto* const map : {&material.base_color_map, &material.metallic_roughness_map, &material.lobe_parameter_map,
                          &material.specular_map, &material.normal_map, &material.layer_map})
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
                          [](Material& m) { m.metallic = 0.5F; },
                          [](Material& m) { m.roughness = 0.5F; },
                          [](Material& m) { m.lobe_parameter = 3.0F; },
                          [](Material& m) { m.lobe_parameter.reset(); },
                          [](Material& m) { m.lobes.pop_back(); },
                          [](Material& m) { m.lobes[1].axis.x = 0.5F; },
                          [](Material& m) { m.lobes[1].parameter = 0.5F; },
                          [](Material& m) { m.lobes[1].weight = 0.5F; },
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
        &Material::specular_map, &Material::normal_map, &Material::layer_map}) {
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

}  // namespace
}  // namespace footprint
