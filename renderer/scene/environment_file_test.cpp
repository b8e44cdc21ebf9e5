// Environments from scene.toml and from files: their content, and the faults of bad ones.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "renderer/image/image_io.hpp"
#include "renderer/scene/assembly/load_scene.hpp"
#include "tests/support/gltf_builder.hpp"

namespace footprint {
namespace {

std::filesystem::path folder() { return test::write_file("environments/scene.toml", "").parent_path(); }

Scene load_environment(const std::string& environment) {
  const std::string text = "[plane]\nsize = [1, 1]\n[environment]\n" + environment;
  return load_scene(test::write_file("environments/scene.toml", text).string(), {});
}

std::string environment_error(const std::string& environment) {
  return test::usage_error([&] { return load_environment(environment); });
}

Image ramp(int width, int height, int channels) {
  Image image(width, height, channels);
  for (std::size_t i = 0; i < image.texels.size(); ++i) image.texels[i] = 0.01F * static_cast<float>(i + 1);
  return image;
}

TEST(EnvironmentFile, ConstantHasItsColourAndIntensity) {
  const Scene scene = load_environment("kind = \"constant\"\ncolor = [1, 0.5, 0.25]\nintensity = 4.0");
  ASSERT_TRUE(scene.environment);
  const glm::vec3 radiance = environment_radiance(*scene.environment, {0.1, -0.4, 0.3});
  EXPECT_EQ(radiance, glm::vec3(4.0F, 2.0F, 1.0F));
  EXPECT_TRUE(scene.lights.empty()) << "no lights are supplied";
  EXPECT_FALSE(scene.exposure);
}

TEST(EnvironmentFile, SkyIsBrightestAtItsSunAndGreyBelow) {
  const Scene scene = load_environment("kind = \"sky\"\nsun_direction = [1, 1, 0]");
  const Environment& sky = *scene.environment;
  const auto at = [&](double x, double y, double z) { return environment_radiance(sky, {x, y, z}); };
  EXPECT_GT(at(1, 1, 0).g, 100.0F * at(0, 1, 0).g);
  EXPECT_GT(at(0, 1, 0).b, at(0, 1, 0).r) << "blue above";
  EXPECT_NEAR(at(0.3, -1, 0.2).r, at(-0.5, -0.2, 0.1).r, 1e-6F);
  for (const float value : sky.radiance->texels) ASSERT_TRUE(std::isfinite(value) && value >= 0.0F);
}

TEST(EnvironmentFile, RotationTurnsCounterClockwiseSeenFromAbove) {
  write_exr(folder() / "ramp.exr", ramp(4, 2, 3));
  const Environment straight = *load_environment("file = \"ramp.exr\"").environment;
  const Environment turned = *load_environment("file = \"ramp.exr\"\nrotation_degrees = 90").environment;
  // What was seen along -z is now along -x.
  EXPECT_EQ(environment_radiance(turned, {-1.0, 0.2, -0.1}), environment_radiance(straight, {0.1, 0.2, -1.0}));
  EXPECT_EQ(environment_radiance(straight, {0.1, 0.2, -1.0}).r, straight.radiance->at(2, 0)[0]);
}

TEST(EnvironmentFile, TakesOneThreeAndFourChannels) {
  for (const int channels : {1, 3, 4}) {
    write_exr(folder() / "map.exr", ramp(4, 2, channels));
    const Environment environment = *load_environment("file = \"map.exr\"").environment;
    EXPECT_EQ(environment.radiance->channels, 3);
    EXPECT_FLOAT_EQ(environment.radiance->at(1, 0)[0], 0.01F * static_cast<float>(channels + 1));
  }
}

TEST(EnvironmentFile, NegativeValuesBecomeZeroWithAWarning) {
  Image image = ramp(4, 2, 3);
  image.texels[5] = -0.5F;
  write_exr(folder() / "negative.exr", image);
  const Scene scene = load_environment("files = [\"nowhere.exr\", \"negative.exr\"]");
  EXPECT_EQ(scene.environment->radiance->texels[5], 0.0F);
  ASSERT_EQ(scene.warnings.size(), 1U);
  EXPECT_NE(scene.warnings[0].find("negative.exr: 1 negative value"), std::string::npos);
}

TEST(EnvironmentFile, ValuesThatAreNotFiniteNameFileAndTexel) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    Image image = ramp(4, 3, 3);
    image.at(2, 1)[1] = bad;
    EXPECT_THROW(write_exr(folder() / "bad.exr", image), Error);  // once it is written
    const std::string error = environment_error("file = \"bad.exr\"");
    EXPECT_NE(error.find("bad.exr"), std::string::npos) << error;
    EXPECT_NE(error.find("column 2, row 1"), std::string::npos) << error;
  }
}

TEST(EnvironmentFile, LargeMapsAreAveragedDown) {
  Image large(4096, 2048, 3, 0.75F);
  large.texels[0] = 0.5F;
  write_exr(folder() / "large.exr", large);
  const Scene scene = load_environment("file = \"large.exr\"");
  EXPECT_EQ(scene.environment->radiance->width, largest_environment_width);
  EXPECT_NEAR(scene.environment->radiance->texels[12345], 0.75F, 1e-6F);
  EXPECT_EQ(scene.warnings.size(), 1U);
}

TEST(EnvironmentFile, OtherShapesThanTwoToOneAreNamed) {
  struct Shape {
    int width, height;
    const char* says;  // null: no warning
  };
  for (const auto& [width, height, says] :
       {Shape{8, 4, nullptr}, Shape{9, 4, nullptr}, Shape{1, 1, nullptr}, Shape{8, 8, "angular map"},
        Shape{8, 6, "as a cross"}, Shape{6, 8, "as a cross"}, Shape{12, 2, "as a strip"}, Shape{4, 8, "2:1"}}) {
    write_exr(folder() / "shape.exr", ramp(width, height, 3));
    const std::vector<std::string> warnings = load_environment("file = \"shape.exr\"").warnings;
    ASSERT_EQ(warnings.size(), says == nullptr ? 0U : 1U) << width << " x " << height;
    if (says != nullptr) {
      EXPECT_NE(warnings[0].find(says), std::string::npos) << warnings[0];
    }
  }
}

TEST(EnvironmentFile, TheSameRadianceEverywhereIsNamed) {
  write_exr(folder() / "grey.exr", Image(4, 2, 3, 0.5F));
  const std::vector<std::string> warnings = load_environment("file = \"grey.exr\"").warnings;
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("the same radiance"), std::string::npos);
}

// A sky of 4 x 2 texels that stores one of them lights by that one.
TEST(EnvironmentFile, APartOfASkyLightsByThatPart) {
  OIIO::ImageSpec spec(1, 1, 3, OIIO::TypeDesc::FLOAT);
  spec.x = 2;
  spec.y = 1;
  spec.full_width = 4;
  spec.full_height = 2;
  const std::string file = (folder() / "part.exr").string();
  const std::array<float, 3> radiance{1.0F, 2.0F, 4.0F};
  const auto output = OIIO::ImageOutput::create(file);
  ASSERT_TRUE(output->open(file, spec) && output->write_image(OIIO::TypeDesc::FLOAT, radiance.data()));
  ASSERT_TRUE(output->close());
  const Scene scene = load_environment("file = \"part.exr\"");
  Image expected(4, 2, 3);
  std::ranges::copy(radiance, expected.at(2, 1).begin());
  EXPECT_EQ(*scene.environment->radiance, expected);
  ASSERT_EQ(scene.warnings.size(), 1U);
  EXPECT_NE(scene.warnings[0].find("a part of its 4 x 2 pixels"), std::string::npos) << scene.warnings[0];
}

TEST(EnvironmentFile, PhotographedEnvironmentOfAPackageLoads) {
  const std::string file = "/usr/share/blender/datafiles/studiolights/world/courtyard.exr";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "the package blender-data is not installed";
  const Scene scene = load_environment("file = \"" + file + "\"");
  EXPECT_EQ(scene.environment->radiance->width, 1024);
  EXPECT_EQ(scene.environment->radiance->height, 512);
  for (const float value : scene.environment->radiance->texels) ASSERT_TRUE(std::isfinite(value) && value >= 0.0F);
}

TEST(EnvironmentFile, BadFilesAndSettingsAreNamed) {
  EXPECT_NE(
      environment_error("file = \"gone.exr\"\npackage = \"blender-data\"").find("install the package blender-data"),
      std::string::npos);
  test::write_file("environments/text.exr", "no image");
  EXPECT_NE(environment_error("file = \"text.exr\"").find("text.exr"), std::string::npos);
  EXPECT_NE(environment_error("intensity = 2").find("kind = \"constant\""), std::string::npos);
  EXPECT_NE(environment_error("kind = \"skye\"").find("`sky`"), std::string::npos);
  EXPECT_NE(environment_error("kind = \"sky\"\ncolor = [1, 1, 1]").find("does not belong"), std::string::npos);
  EXPECT_NE(environment_error("kind = \"sky\"\nsun_direction = [0, -1, 0]").find("below the horizon"),
            std::string::npos);
  EXPECT_NE(environment_error("kind = \"sky\"\nsun_direction = [0, 0, 0]").find("has no length"), std::string::npos);
  EXPECT_NE(environment_error("kind = \"constant\"\nintensity = -1").find("scene.toml:5"), std::string::npos);
  EXPECT_NE(environment_error("knid = \"sky\"").find("did you mean `kind`"), std::string::npos);
}

}  // namespace
}  // namespace footprint
