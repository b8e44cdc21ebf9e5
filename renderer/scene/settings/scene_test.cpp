// scene.toml: every key read, every mistake named with its line.
#include "renderer/scene/settings/scene.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/gltf_builder.hpp"

namespace footprint {
namespace {

SceneSettings read(const std::string& text) {
  return read_scene_settings(test::write_file("settings/scene.toml", text), {});
}

void expect_settings_error(const std::string& text, const std::vector<std::string>& wanted) {
  const std::string error = test::usage_error([&] { return read(text); });
  for (const std::string& words : wanted) {
    EXPECT_NE(error.find(words), std::string::npos) << "wanted: " << words << "\ngot: " << error;
  }
}

TEST(SceneSettings, EverythingIsRead) {
  const SceneSettings settings = read(R"(
[scene]
name = "n"
description = "d"
horizon = "open"
[plane]
size = [3, 2.5]
normal_map = "bumps.png"
normal_channels = "xy"
normal_scale = 0.5
roughness = 0.25
metallic = 1
[brdf]
distribution = "beckmann"
geometry = "tan"
fresnel = "none"
diffuse = false
alpha = 0.2
specular = [0.1, 0.2, 0.3]
base_color = [0.4, 0.5, 0.6]
[frame]
size = [640, 480]
exposure = 2
[lights]
keep = false
[[light]]
type = "point"
position = [1, 2, 3]
color = [1, 0.5, 0]
intensity = 10
range = 4
[[light]]
type = "spot"
position = [0, 0, 1]
direction = [0, 0, -2]
inner_cone_degrees = 10
outer_cone_degrees = 90
[[light]]
type = "directional"
direction = [0, -3, 0]
[shadows]
cast = false
sides = "both"
resolution = 512
[camera]
frame_bounds = { direction = [0, 0, 2], fov_degrees = 90, margin = 2 }
[zoom]
distances = [1, 2, 16]
[tiling]
uv = [2, 3]
)");
  EXPECT_EQ(settings.scene.name, "n");
  const PlaneSettings& plane = settings.parts.at(0).plane.value();
  EXPECT_EQ(plane.size, glm::vec2(3.0F, 2.5F));
  EXPECT_EQ(plane.normals->path.filename(), "bumps.png");
  EXPECT_TRUE(plane.normals->path.is_absolute());
  EXPECT_EQ(plane.normals->channels, NormalChannels::xy);
  EXPECT_EQ(plane.normals->scale, 0.5);
  EXPECT_EQ(settings.scene.horizon, Horizon::open);
  EXPECT_TRUE(settings.scene.shadows.both_sides);
  EXPECT_EQ(plane.roughness, 0.25F);
  EXPECT_EQ(plane.metallic, 1.0F);
  EXPECT_EQ(settings.parts.at(0).brdf.distribution, NormalDistribution::beckmann);
  EXPECT_EQ(settings.parts.at(0).brdf.geometry, GeometryTerm::tan);
  EXPECT_EQ(settings.parts.at(0).brdf.fresnel, FresnelTerm::none);
  EXPECT_EQ(settings.parts.at(0).brdf.diffuse, false);
  EXPECT_EQ(settings.parts.at(0).brdf.lobe_parameter, 0.2F);
  EXPECT_EQ(settings.parts.at(0).brdf.specular, glm::vec3(0.1F, 0.2F, 0.3F));
  EXPECT_EQ(settings.parts.at(0).brdf.base_color, glm::vec3(0.4F, 0.5F, 0.6F));
  EXPECT_EQ(settings.scene.frame_size, glm::ivec2(640, 480));
  EXPECT_EQ(settings.scene.exposure, 2.0F);
  EXPECT_FALSE(settings.keep_model_lights);
  ASSERT_EQ(settings.scene.lights.size(), 3U);
  const auto& point = std::get<PointLight>(settings.scene.lights[0]);
  EXPECT_EQ(point.position, glm::vec3(1, 2, 3));
  EXPECT_EQ(point.intensity, glm::vec3(10, 5, 0));
  EXPECT_EQ(point.range, 4.0F);
  const auto& spot = std::get<SpotLight>(settings.scene.lights[1]);
  EXPECT_EQ(spot.direction, glm::vec3(0, 0, -1));
  EXPECT_FLOAT_EQ(spot.inner_cone_angle, std::numbers::pi_v<float> / 18.0F);
  EXPECT_FLOAT_EQ(spot.outer_cone_angle, std::numbers::pi_v<float> / 2.0F);
  EXPECT_EQ(std::get<DirectionalLight>(settings.scene.lights[2]).direction, glm::vec3(0, -1, 0));
  EXPECT_EQ(settings.scene.shadows.cast, false);
  EXPECT_EQ(settings.scene.shadows.resolution, 512);
  const auto& framing = std::get<Framing>(settings.camera);
  EXPECT_EQ(framing.direction, glm::dvec3(0, 0, 1));
  EXPECT_FLOAT_EQ(static_cast<float>(framing.yfov), std::numbers::pi_v<float> / 2.0F);
  EXPECT_EQ(framing.margin, 2.0);
  EXPECT_EQ(settings.scene.distances, (std::vector<double>{1, 2, 16}));
  EXPECT_EQ(settings.parts.at(0).tiling, glm::vec2(2, 3));
}

TEST(SceneSettings, AreaLights) {
  const std::string plane = "[plane]\n", start = "[[light]]\nposition = [0, 0, 2]\ndirection = [0, 0, -2]\n";
  const auto lights =
      read(plane + start + "type = \"rectangle\"\nsize = [1, 3]\nup = [1, 0, 1]\nintensity = 6\ncolor = [1, 0.5, 0]\n" +
           start + "type = \"disk\"\nradius = 0.25\nintegral = \"points\"\npoints = 64\n")
          .scene.lights;
  ASSERT_EQ(lights.size(), 2U);
  const auto& rectangle = std::get<AreaLight>(lights[0]);
  EXPECT_EQ(rectangle.shape, AreaShape::rectangle);
  EXPECT_EQ(rectangle.position, glm::vec3(0, 0, 2));
  EXPECT_EQ(rectangle.direction, glm::vec3(0, 0, -1));
  EXPECT_EQ(rectangle.up, glm::vec3(1, 0, 0));
  EXPECT_EQ(glm::cross(rectangle.across, rectangle.up), rectangle.direction);
  EXPECT_EQ(rectangle.half_size, glm::vec2(0.5F, 1.5F));
  EXPECT_EQ(rectangle.intensity, glm::vec3(6, 3, 0));
  EXPECT_EQ(rectangle.integral, AreaIntegral::lobes);
  EXPECT_FLOAT_EQ(rectangle.area(), 3.0F);
  const auto& disk = std::get<AreaLight>(lights[1]);
  EXPECT_EQ(disk.shape, AreaShape::disk);
  EXPECT_EQ(disk.half_size, glm::vec2(0.25F));
  EXPECT_EQ(disk.integral, AreaIntegral::points);
  EXPECT_EQ(disk.points, 64);
  EXPECT_FLOAT_EQ(disk.area(), std::numbers::pi_v<float> / 16.0F);
}

TEST(SceneSettings, SphereLights) {
  const auto lights =
      read("[plane]\n[[light]]\ntype = \"sphere\"\nposition = [0, 1, 2]\nradius = 0.5\nintensity = 3\n").scene.lights;
  const auto& sphere = std::get<AreaLight>(lights.at(0));
  EXPECT_EQ(sphere.shape, AreaShape::sphere);
  EXPECT_EQ(sphere.position, glm::vec3(0, 1, 2));
  EXPECT_EQ(sphere.half_size, glm::vec2(0.5F));
  EXPECT_FLOAT_EQ(sphere.area(), std::numbers::pi_v<float> / 4.0F);
  const std::string start = "[plane]\n[[light]]\ntype = \"sphere\"\nposition = [0, 0, 2]\n";
  expect_settings_error(start, {"`radius` in [[light]] is missing"});
  expect_settings_error(start + "radius = 1\ndirection = [0, 0, 1]\n",
                        {"scene.toml:6", "does not belong to a sphere light"});
}

TEST(SceneSettings, AreaLightsOutOfRangeAreRefused) {
  const std::string start = "[plane]\n[[light]]\nposition = [0, 0, 2]\n", down = "direction = [0, 0, -1]\n";
  const std::string rectangle = start + down + "type = \"rectangle\"\n", disk = start + down + "type = \"disk\"\n";
  expect_settings_error(start + "type = \"disk\"\nradius = 1\n", {"`direction`", "missing"});
  expect_settings_error(rectangle, {"`size` in [[light]] is missing"});
  expect_settings_error(disk, {"`radius` in [[light]] is missing"});
  expect_settings_error(rectangle + "size = [1, 1]\nradius = 1\n", {"scene.toml:7", "does not belong to a rectangle"});
  expect_settings_error(disk + "radius = 1\nup = [0, 1, 0]\n", {"scene.toml:7", "does not belong to a disk light"});
  expect_settings_error(disk + "radius = 1\nrange = 4\n", {"scene.toml:7", "does not belong to a disk light"});
  expect_settings_error(disk + "radius = -1\n", {"scene.toml:6", "not within"});
  expect_settings_error(disk + "radius = 1\npoints = 0\n", {"scene.toml:7", "not within"});
  expect_settings_error(disk + "radius = 1\nintegral = \"lobe\"\n", {"scene.toml:7", "lobes"});
  expect_settings_error(rectangle + "size = [1, 1]\nup = [0, 0, 3]\n", {"scene.toml:7", "parallel"});
}

TEST(SceneSettings, PlacedCameraAndAutomaticExposure) {
  const SceneSettings settings = read(
      "[model]\nfile = \"a.gltf\"\n[frame]\nexposure = \"auto\"\n"
      "[camera]\nposition = [0, 5, 0]\ntarget = [0, 0, 0]\nyfov_degrees = 60\nznear = 0.5\nzfar = 20\n");
  EXPECT_TRUE(settings.automatic_exposure);
  EXPECT_FALSE(settings.scene.exposure);
  const auto& camera = std::get<PlacedCamera>(settings.camera);
  EXPECT_EQ(camera.position, glm::dvec3(0, 5, 0));
  EXPECT_EQ(camera.target, glm::dvec3(0, 0, 0));
  EXPECT_EQ(camera.up, glm::dvec3(0, 1, 0));
  EXPECT_FLOAT_EQ(camera.lens.yfov, std::numbers::pi_v<float> / 3.0F);
  EXPECT_EQ(camera.lens.znear, 0.5F);
  EXPECT_EQ(camera.lens.zfar, 20.0F);
}

TEST(SceneSettings, ShadowsAreDerivedUnlessGiven) {
  EXPECT_FALSE(read("[plane]\n").scene.shadows.cast);
  EXPECT_FALSE(read("[plane]\n[shadows]\n").scene.shadows.cast);
  EXPECT_EQ(read("[plane]\n[shadows]\ncast = true\n").scene.shadows.cast, true);
  expect_settings_error("[plane]\n[shadows]\ncast = \"on\"\n", {"scene.toml:3", "cast"});
  expect_settings_error("[plane]\n[shadows]\ncasts = true\n", {"scene.toml:3", "unknown key `casts`", "`cast`"});
  expect_settings_error("[plane]\n[shadows]\nresolution = 15\n", {"scene.toml:3", "resolution", "16"});
  expect_settings_error("[plane]\n[shadows]\nresolution = 100000\n", {"scene.toml:3", "resolution", "16384"});
  expect_settings_error("[plane]\n[shadows]\nresolution = 64.5\n", {"scene.toml:3", "resolution"});
}

TEST(SceneSettings, ALayerIsHeightsOrNormals) {
  const SceneSettings settings = read("[plane]\n[layer]\nbump_map = \"h.png\"\nuv = [8, 4]\nstrength = 0.02");
  ASSERT_TRUE(settings.parts.front().layer);
  EXPECT_TRUE(std::get<NormalFile>(settings.parts.front().layer->content).heights);
  EXPECT_EQ(std::get<NormalFile>(settings.parts.front().layer->content).path.filename(), "h.png");
  EXPECT_EQ(settings.parts.front().layer->uv, glm::vec2(8.0F, 4.0F));
  EXPECT_EQ(settings.parts.front().layer->strength, 0.02);
  const SceneSettings normals = read("[plane]\n[layer]\nnormal_map = \"n.png\"");
  EXPECT_FALSE(std::get<NormalFile>(normals.parts.front().layer->content).heights);
  EXPECT_EQ(normals.parts.front().layer->strength, 1.0);
  expect_settings_error("[plane]\n[layer]\nuv = [1, 1]", {"scene.toml:2", "bump_map", "surface"});
  expect_settings_error("[plane]\n[layer]\nbump_map = \"a\"\nnormal_map = \"b\"", {"scene.toml:3", "only one"});
  expect_settings_error("[plane]\n[layer]\nbump_map = \"a\"", {"scene.toml:2", "strength", "missing"});
  expect_settings_error("[plane]\n[layer]\nnormal_map = \"a\"\nstrenght = 2", {"scene.toml:4", "strength"});
}

TEST(SceneSettings, HeightsAreReadWhereNormalsAre) {
  const std::string heights = "{ file = \"h.exr\", scale = -0.5, slope_filter = \"scharr\", wrap = \"clamp_to_edge\" }";
  const auto expect_heights = [](const NormalFile& file) {
    EXPECT_EQ(file.path.filename(), "h.exr");
    EXPECT_EQ(file.scale, -0.5);
    EXPECT_EQ(file.heights.value().filter, SlopeFilter::scharr);
    EXPECT_EQ(file.heights->wrap, (std::array{Wrap::clamp_to_edge, Wrap::clamp_to_edge}));
  };
  const PartSettings part =
      read("[plane]\nheight_map = " + heights + "\n[clear_coat]\nheight_map = " + heights).parts[0];
  expect_heights(part.plane->normals.value());
  expect_heights(part.coat->normals.value());
  const std::string model = "[model]\nfile = \"a.gltf\"\n";
  expect_heights(read(model + "[maps]\nheight = " + heights).parts[0].maps.normals.value());
  const NormalFile laid = read(model + "[maps.normal]\nfile = \"n.png\"\nuv = [2, 3]\nscale = 4\nchannels = \"xy\"")
                              .parts[0]
                              .maps.normals.value();
  EXPECT_EQ(laid.uv, glm::vec2(2, 3));
  EXPECT_EQ(laid.scale, 4.0);
  EXPECT_EQ(laid.channels, NormalChannels::xy);
  EXPECT_FALSE(laid.heights);
  const PartSettings plain = read("[plane]\nheight_map = { file = \"h\", scale = 1 }").parts[0];
  EXPECT_EQ(plain.plane->normals->heights->filter, SlopeFilter::central);
  const PartSettings layered =
      read("[plane]\n[layer]\nbump_map = \"h\"\nstrength = 1\nslope_filter = \"sobel\"").parts[0];
  EXPECT_EQ(std::get<NormalFile>(layered.layer->content).heights->filter, SlopeFilter::sobel);
}

TEST(SceneSettings, HeightsAndNormalsExcludeEachOther) {
  const std::string heights = "height_map = { file = \"h\", scale = 1 }\n";
  expect_settings_error("[plane]\nnormal_map = \"n\"\n" + heights, {"scene.toml:3", "`height_map`", "`normal_map`"});
  expect_settings_error("[plane]\n[clear_coat]\nnormal_map = \"n\"\n" + heights, {"scene.toml:4", "`height_map`"});
  expect_settings_error("[plane]\n[maps.normal]\nfile = \"n\"\n[maps.height]\nfile = \"h\"\nscale = 1",
                        {"scene.toml:4", "`height` in [maps] excludes `normal`"});
  expect_settings_error("[plane]\n" + heights + "[maps.height]\nfile = \"h\"\nscale = 1",
                        {"scene.toml:3", "`height` in [maps]", "[plane]"});
  expect_settings_error("[plane]\n[maps.height]\nfile = \"h\"\nscale = 1\n[microgeometry]\nkind = \"grooves\"",
                        {"scene.toml:2", "`height` in [maps]", "[microgeometry]"});
  expect_settings_error("[plane]\nheight_map = { file = \"h\" }", {"scene.toml:2", "scale", "missing"});
  expect_settings_error("[plane]\nheight_map = { scale = 1 }", {"scene.toml:2", "file", "missing"});
  expect_settings_error("[plane]\nheight_map = { file = \"h\", scale = 1, slope_filter = \"sobl\" }",
                        {"scene.toml:2", "`sobl`", "`sobel`"});
  expect_settings_error("[plane]\nnormal_scale = 2\n" + heights, {"scene.toml:2", "normal_scale", "belongs to"});
  expect_settings_error("[plane]\n[layer]\nnormal_map = \"n\"\nslope_filter = \"sobel\"",
                        {"scene.toml:4", "slope_filter", "belongs to"});
}

TEST(SceneSettings, UnknownKeysNameLineAndNeighbour) {
  expect_settings_error("[plane]\nsize = [1, 1]\nnormal_mop = \"a.png\"\n",
                        {"scene.toml:3", "unknown key `normal_mop` in [plane]", "did you mean `normal_map`"});
  expect_settings_error("[plain]\n", {"scene.toml:1", "unknown key `plain`", "plane"});
  expect_settings_error("[plane]\n[[light]]\ntype = \"point\"\npositon = [0, 0, 1]\n",
                        {"scene.toml:4", "unknown key `positon` in [[light]]", "`position`"});
  expect_settings_error("[plane]\n[brdf]\ndistribution = \"ggxx\"\n", {"scene.toml:3", "`ggxx`", "`ggx`"});
}

TEST(SceneSettings, WrongTypesAndRangesNameTheirLine) {
  const std::string plane = "[plane]\n";
  expect_settings_error("= 3", {"scene.toml:1", "not valid TOML"});
  expect_settings_error("plane = 3\n", {"scene.toml:1", "must be a table"});
  expect_settings_error("", {"the file is empty"});
  expect_settings_error(plane + "size = 3\n", {"scene.toml:2", "list of 2 numbers"});
  expect_settings_error(plane + "size = [1, \"2\"]\n", {"scene.toml:2", "must be a number"});
  expect_settings_error(plane + "size = [0, 1]\n", {"scene.toml:2", "not within"});
  expect_settings_error(plane + "roughness = nan\n", {"scene.toml:2", "not within 0 to 1"});
  expect_settings_error(plane + "roughness = inf\n", {"scene.toml:2"});
  expect_settings_error(plane + "normal_map = 4\n", {"scene.toml:2", "must be a string"});
  expect_settings_error(plane + "[brdf]\ndiffuse = 1\n", {"scene.toml:3", "true or false"});
  expect_settings_error(plane + "[frame]\nsize = [0, 0]\n", {"scene.toml:3"});
  expect_settings_error(plane + "[frame]\nsize = [1000000, 1000000]\n", {"scene.toml:3"});
  expect_settings_error(plane + "[frame]\nsize = [2.5, 2]\n", {"scene.toml:3", "whole numbers"});
  expect_settings_error(plane + "[frame]\nexposure = \"bright\"\n", {"scene.toml:3", "auto"});
  expect_settings_error(plane + "[zoom]\ndistances = []\n", {"scene.toml:3"});
  expect_settings_error(plane + "[zoom]\ndistances = [1, -2]\n", {"scene.toml:3"});
  expect_settings_error(plane + "[tiling]\nuv = [0, 1]\n", {"scene.toml:3"});
  expect_settings_error(plane + "light = 3\n", {"unknown key `light` in [plane]"});
  expect_settings_error("light = 3\n" + plane, {"scene.toml:1", "list of tables"});
}

TEST(SceneSettings, WhatExcludesOrNeedsEachOther) {
  const std::string plane = "[plane]\n";
  expect_settings_error("[zoom]\ndistances = [1]\n", {"`model` or `plane`"});
  expect_settings_error("[plane]\n[model]\nfile = \"a.gltf\"\n", {"excludes `model`"});
  expect_settings_error("[model]\n", {"scene.toml:1", "`files`"});
  expect_settings_error("[model]\nfile = \"a.gltf\"\nfiles = [\"b.gltf\"]\n", {"only one"});
  expect_settings_error("[model]\nfiles = [1]\n", {"scene.toml:2", "list of strings"});
  expect_settings_error(plane + "[brdf]\nalpha = 0.1\nexponent = 5\n", {"exponent"});
  expect_settings_error(plane + "[brdf]\ndistribution = \"vmf\"\nalpha = 0.1\n", {"scene.toml:4", "does not belong"});
  expect_settings_error(plane + "[[light]]\nintensity = 1\n", {"scene.toml:2", "`type` in [[light]] is missing"});
  expect_settings_error(plane + "[[light]]\ntype = \"point\"\n", {"`position`", "missing"});
  expect_settings_error(plane + "[[light]]\ntype = \"directional\"\n", {"`direction`", "missing"});
  expect_settings_error(plane + "[[light]]\ntype = \"directional\"\ndirection = [0, 0, 0]\n",
                        {"scene.toml:4", "no length"});
  expect_settings_error(plane + "[[light]]\ntype = \"point\"\nposition = [0, 0, 1]\ndirection = [0, 0, 1]\n",
                        {"scene.toml:5", "does not belong to a point light"});
  expect_settings_error(plane +
                            "[[light]]\ntype = \"spot\"\nposition = [0, 0, 1]\ndirection = [0, 0, 1]\n"
                            "inner_cone_degrees = 50\n",
                        {"scene.toml:6", "less than outer_cone_degrees"});
  expect_settings_error(plane + "[camera]\nposition = [0, 0, 1]\n", {"`target`", "missing"});
  expect_settings_error(plane + "[camera]\nposition = [0, 0, 1]\ntarget = [0, 0, 1]\n",
                        {"equals the position of the camera"});
  expect_settings_error(plane + "[camera]\nframe_bounds = {}\nup = [0, 1, 0]\n", {"scene.toml:4", "excludes"});
  expect_settings_error(plane + "[camera]\nframe_bounds = { direction = [0, 0, 0] }\n", {"scene.toml:3", "no length"});
}

}  // namespace
}  // namespace footprint
