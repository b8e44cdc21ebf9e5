// Maps of concentrations widen the lobes of texels.
#include "renderer/scene/assembly/surface_maps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "renderer/image/image_io.hpp"
#include "renderer/lobes/convolution.hpp"
#include "renderer/scene/assembly/load_scene.hpp"
#include "tests/support/gltf_builder.hpp"

namespace footprint {
namespace {

using enum NormalDistribution;

TextureMap kappas(std::vector<float> values) {
  Image image(static_cast<int>(values.size()), 1, 1);
  image.texels = std::move(values);
  return {"kappas", std::make_shared<const Image>(std::move(image)), {}};
}

TEST(TexelSpread, WidensConstantsAndMaps) {
  Material material;
  material.brdf.distribution = blinn_phong;
  material.lobe_parameter = 200.0F;
  spread_normals(kappas({16.0F, 1e6F}), material);
  const Image parameters = material.lobe_parameter_map->image.decoded();
  EXPECT_NEAR(parameters.texels[0], 16.0 * 200.0 / 216.0, 1e-5);
  EXPECT_NEAR(parameters.texels[1], 1e6 * 200.0 / 1000200.0, 2e-4);
  EXPECT_FALSE(material.lobe_parameter);
  spread_normals(kappas({16.0F, 1e6F, 16.0F, 1e6F}), material);  // two spreads of one texel add
  EXPECT_NEAR(material.lobe_parameter_map->image.decoded().texels[0], 1.0 / (1.0 / 200.0 + 2.0 / 16.0), 1e-5);

  Material rough;  // GGX of roughness 0.5 and 0.25, whose metalness varies
  Image map(2, 1, 2);
  map.texels = {0.5F, 1.0F, 0.25F, 0.0F};
  rough.metallic_roughness_map = TextureMap{"rough", std::make_shared<const Image>(map), {}};
  spread_normals(kappas({100.0F}), rough);
  const Image widened = rough.metallic_roughness_map->image.decoded();
  EXPECT_NEAR(widened.texels[0], std::sqrt(convolved({ggx, 0.25}, 100.0).parameter), 1e-6);
  EXPECT_NEAR(widened.texels[2], std::sqrt(convolved({ggx, 0.0625}, 100.0).parameter), 1e-6);
  EXPECT_EQ(widened.texels[1], 1.0F);
  EXPECT_EQ(widened.texels[3], 0.0F);
}

TEST(TexelSpread, IsAMapOfAScene) {
  Image stored(2, 2, 1, 16.0F);
  const auto folder = test::write_file("spread/made.txt", "").parent_path();
  write_exr(folder / "kappa.exr", stored);
  const auto load = [&](const std::string& text) {
    return load_scene(test::write_file("spread/scene.toml", "[plane]\n" + text).string(), {}).materials.at(0);
  };
  const std::string maps = "[maps.normal_kappa]\nfile = \"kappa.exr\"\nuv = [2, 3]\n";
  const std::string phong = "[brdf]\ndistribution = \"blinn_phong\"\n";
  const Material material = load(phong + "exponent = 200\n" + maps);
  EXPECT_NEAR(material.lobe_parameter_map->image.decoded().texels[0], 16.0 * 200.0 / 216.0, 1e-5);
  EXPECT_EQ(material.lobe_parameter_map->coordinates.transform * glm::vec3(1, 1, 1), glm::vec2(2, 3));
  const auto error = [&](const std::string& text) { return test::usage_error([&] { return load(text); }); };
  const std::string exponents = phong + "[maps.exponent]\nfile = \"kappa.exr\"\nuv = [1, 1]\n";
  EXPECT_NE(error(exponents + maps).find("give both maps the same `uv`"), std::string::npos);
  EXPECT_NE(error(phong + "[[brdf.lobe]]\naxis = [0, 0, 1]\nexponent = 3\n" + maps)
                .find("`normal_kappa` in [maps] excludes [[brdf.lobe]]"),
            std::string::npos);
  EXPECT_NE(
      error(maps + "[microgeometry]\nkind = \"grooves\"\n").find("`normal_kappa` in [maps] excludes [microgeometry]"),
      std::string::npos);
  stored.at(1, 0)[0] = 0.0F;
  write_exr(folder / "kappa.exr", stored);
  EXPECT_NE(error(maps).find("texel (1, 0)"), std::string::npos);
}

}  // namespace
}  // namespace footprint
