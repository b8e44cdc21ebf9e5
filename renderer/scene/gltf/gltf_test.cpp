// What a well-formed glTF file becomes, against values worked out by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "renderer/image/image_io.hpp"
#include "renderer/scene/model.hpp"
#include "tests/support/expect_near.hpp"
#include "tests/support/gltf_builder.hpp"

namespace footprint {
namespace {

using nlohmann::json;
using test::expect_near;
using test::GltfBuilder;
using test::make_quad;

glm::vec3 triangle_normal(const Mesh& mesh, std::size_t triangle) {
  const auto corner = [&](std::size_t k) { return mesh.vertices[mesh.indices[3 * triangle + k]].position; };
  return glm::normalize(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
}

bool mentions(const std::vector<std::string>& lines, const std::string& words) {
  return std::ranges::any_of(lines, [&](const std::string& line) { return line.find(words) != std::string::npos; });
}

TEST(Gltf, QuadComesAsItIs) {
  const Model model = load_gltf(make_quad().write());
  ASSERT_EQ(model.meshes.size(), 1U);
  const Mesh& mesh = model.meshes[0];
  EXPECT_EQ(mesh.vertices.size(), 4U);
  EXPECT_EQ(mesh.indices.size(), 6U);
  for (const Vertex& vertex : mesh.vertices) {
    expect_near(vertex.normal, {0, 0, 1});
    expect_near(glm::vec3{vertex.tangent}, {1, 0, 0});
    EXPECT_EQ(vertex.tangent.w, 1.0F);
    EXPECT_FLOAT_EQ(vertex.uv0.x, (vertex.position.x + 1.0F) / 2.0F);
    EXPECT_FLOAT_EQ(vertex.uv0.y, (1.0F - vertex.position.y) / 2.0F);
  }
  ASSERT_EQ(model.materials.size(), 1U);
  EXPECT_EQ(model.materials[0].metallic, 1.0F);  // glTF's default material
  EXPECT_EQ(model.materials[0].roughness, 1.0F);
  EXPECT_TRUE(model.warnings.empty());
  EXPECT_FALSE(model.camera);
}

TEST(Gltf, GlbEqualsGltf) {
  const Model text = load_gltf(make_quad().write());
  const Model binary = load_gltf(test::write_file("made.glb", make_quad().glb()));
  ASSERT_EQ(binary.meshes.size(), 1U);
  EXPECT_EQ(binary.meshes[0].indices, text.meshes[0].indices);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(binary.meshes[0].vertices[i].position, text.meshes[0].vertices[i].position);
  }
}

TEST(Gltf, MatrixAndTrsAgreeOnTheSameTransform) {
  GltfBuilder trs = make_quad();
  // A quarter turn about y takes +x to -z and +z to +x; then the child is moved by its parent.
  const double half = std::numbers::pi / 4.0;
  trs.json["nodes"] = {{{"children", {1}}, {"translation", {10, 0, 0}}},
                       {{"mesh", 0}, {"rotation", {0, std::sin(half), 0, std::cos(half)}}, {"scale", {2, 3, 1}}}};
  GltfBuilder matrix = make_quad();
  matrix.json["nodes"] = {{{"mesh", 0}, {"matrix", {0, 0, -2, 0, 0, 3, 0, 0, 1, 0, 0, 0, 10, 0, 0, 1}}}};
  for (const GltfBuilder& builder : {trs, matrix}) {
    const Mesh mesh = load_gltf(builder.write()).meshes.at(0);
    const Vertex& vertex = mesh.vertices[mesh.indices[0]];  // (-1, 1, 0)
    expect_near(vertex.position, {10, 3, 2});
    expect_near(vertex.normal, {1, 0, 0});
    expect_near(glm::vec3{vertex.tangent}, {0, 0, -1});
    expect_near(triangle_normal(mesh, 0), {1, 0, 0});
  }
}

// Four colours that all of glTF's forms can represent, as the bytes of an accessor.
struct ColorForm {
  int component_type;
  int components;
  std::vector<std::uint8_t> bytes;
};

template <class Component>
ColorForm color_form(int component_type, int components, const std::vector<Component>& values) {
  std::vector<std::uint8_t> bytes(values.size() * sizeof(Component));
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return {component_type, components, bytes};
}

GltfBuilder colored_quad(const ColorForm& form, bool normalized) {
  GltfBuilder quad = make_quad();
  const int colors = quad.add_accessor(form.bytes, form.component_type, 4, form.components == 3 ? "VEC3" : "VEC4");
  quad.json["accessors"].back()["normalized"] = normalized;
  quad.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = colors;
  return quad;
}

TEST(Gltf, VertexColoursComeInEveryForm) {
  const auto forms = std::to_array<ColorForm>({
      color_form<float>(5126, 4, {1, 0, 0.2F, 1, 0, 1, 0.2F, 0.6F, 1, 1, 1, 0, 0, 0, 0.4F, 1}),
      color_form<float>(5126, 3, {1, 0, 0.2F, 0, 1, 0.2F, 1, 1, 1, 0, 0, 0.4F}),
      color_form<std::uint8_t>(5121, 4, {255, 0, 51, 255, 0, 255, 51, 153, 255, 255, 255, 0, 0, 0, 102, 255}),
      color_form<std::uint8_t>(5121, 3, {255, 0, 51, 0, 255, 51, 255, 255, 255, 0, 0, 102}),
      color_form<std::uint16_t>(
          5123, 4, {65535, 0, 13107, 65535, 0, 65535, 13107, 39321, 65535, 65535, 65535, 0, 0, 0, 26214, 65535}),
      color_form<std::uint16_t>(5123, 3, {65535, 0, 13107, 0, 65535, 13107, 65535, 65535, 65535, 0, 0, 26214}),
  });
  const std::array<glm::vec4, 4> expected{{{1, 0, 0.2F, 1}, {0, 1, 0.2F, 0.6F}, {1, 1, 1, 0}, {0, 0, 0.4F, 1}}};
  for (const ColorForm& form : forms) {
    const Model model = load_gltf(colored_quad(form, form.component_type != 5126).write());
    ASSERT_EQ(model.meshes.at(0).vertices.size(), 4U);
    for (const Vertex& vertex : model.meshes[0].vertices) {
      // Vertices of the quad, in the file's order: upper left, upper right, lower right, lower left.
      const std::size_t i = vertex.position.y > 0 ? (vertex.position.x < 0 ? 0 : 1) : (vertex.position.x > 0 ? 2 : 3);
      expect_near(glm::vec3(vertex.color), glm::vec3(expected.at(i)));
      EXPECT_NEAR(vertex.color.a, form.components == 4 ? expected.at(i).a : 1.0F, 1e-6F);
    }
    EXPECT_TRUE(model.warnings.empty());
  }
}

TEST(Gltf, VertexColoursOutOfRangeAreClampedAndBrokenOnesWhite) {
  const float broken = std::numeric_limits<float>::quiet_NaN();
  const Model model =
      load_gltf(colored_quad(color_form<float>(5126, 3, {2, -1, 0.5F, 0, broken, 0, 0, 0, 0, 0, 0, 0}), false).write());
  expect_near(glm::vec3(model.meshes.at(0).vertices[0].color), {1, 0, 0.5F});
  EXPECT_TRUE(mentions(model.warnings, "1 vertex colours that are not finite"));
  const auto white = [](const Vertex& vertex) { return vertex.color == glm::vec4(1.0F); };
  EXPECT_EQ(std::ranges::count_if(model.meshes[0].vertices, white), 1);
}

TEST(Gltf, IntegerVertexColoursMustBeNormalised) {
  const GltfBuilder quad = colored_quad(color_form<std::uint8_t>(5121, 3, std::vector<std::uint8_t>(12, 9)), false);
  const std::string message = test::usage_error([&] { return load_gltf(quad.write()); });
  EXPECT_NE(message.find("COLOR_0"), std::string::npos);
  EXPECT_NE(message.find("not normalised"), std::string::npos);
}

TEST(Gltf, NormalsGoByTheInverseTranspose) {
  GltfBuilder quad = make_quad();
  const float r = std::numbers::sqrt2_v<float> / 2.0F;
  const int normals = quad.add_floats({r, 0, r, r, 0, r, r, 0, r, r, 0, r}, "VEC3");
  quad.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = normals;
  quad.json["nodes"][0]["scale"] = {2, 1, 1};
  const Mesh mesh = load_gltf(quad.write()).meshes.at(0);
  expect_near(mesh.vertices[0].normal, glm::normalize(glm::vec3{0.5F, 0.0F, 1.0F}));
}

TEST(Gltf, MirroringTurnsWindingAndHandedness) {
  for (const bool given_tangents : {false, true}) {
    GltfBuilder quad = make_quad();
    if (given_tangents) {
      const int tangents = quad.add_floats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4");
      quad.json["meshes"][0]["primitives"][0]["attributes"]["TANGENT"] = tangents;
    }
    quad.json["nodes"][0]["scale"] = {-1, 1, 1};
    const Mesh mesh = load_gltf(quad.write()).meshes.at(0);
    expect_near(triangle_normal(mesh, 0), {0, 0, 1});
    expect_near(triangle_normal(mesh, 1), {0, 0, 1});
    for (const Vertex& vertex : mesh.vertices) {
      expect_near(vertex.normal, {0, 0, 1});
      expect_near(glm::vec3{vertex.tangent}, {-1, 0, 0});
      EXPECT_EQ(vertex.tangent.w, -1.0F);  // the bitangent stays +y
    }
  }
}

TEST(Gltf, MissingNormalsAreFlat) {
  GltfBuilder quad = make_quad();
  quad.json["meshes"][0]["primitives"][0]["attributes"].erase("NORMAL");
  const Mesh mesh = load_gltf(quad.write()).meshes.at(0);
  EXPECT_EQ(mesh.vertices.size(), 6U);
  for (const Vertex& vertex : mesh.vertices) expect_near(vertex.normal, {0, 0, 1});
}

TEST(Gltf, ZeroNormalsAreReplacedWithAWarning) {
  GltfBuilder quad = make_quad();
  const int normals = quad.add_floats(std::vector<float>(12, 0.0F), "VEC3");
  quad.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = normals;
  const Model model = load_gltf(quad.write());
  for (const Vertex& vertex : model.meshes.at(0).vertices) expect_near(vertex.normal, {0, 0, 1});
  EXPECT_TRUE(mentions(model.warnings, "primitive 0: 4 normals without a direction"));
}

TEST(Gltf, UnusableTextureCoordinatesBecomeZeroWithAWarning) {
  GltfBuilder quad = make_quad();
  const int uvs = quad.add_floats({NAN, 0, 1, 0, 1, INFINITY, 0, 1}, "VEC2");
  quad.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = uvs;
  const Model model = load_gltf(quad.write());
  EXPECT_TRUE(mentions(model.warnings, "2 texture coordinates"));
  for (const Vertex& vertex : model.meshes.at(0).vertices) EXPECT_TRUE(std::isfinite(vertex.uv0.x + vertex.uv0.y));
}

TEST(Gltf, IndicesMayBeLeftOutOrOfAnyWidth) {
  for (const int type : {5121, 5123, 5125}) {
    GltfBuilder quad = make_quad();
    const std::vector<std::uint32_t> indices{0, 3, 2};
    std::vector<std::uint8_t> bytes;
    const std::size_t width = type == 5121 ? 1 : type == 5123 ? 2 : 4;
    for (const std::uint32_t index : indices) {
      for (std::size_t b = 0; b < width; ++b) bytes.push_back(static_cast<std::uint8_t>(index >> (8 * b)));
    }
    quad.json["meshes"][0]["primitives"][0]["indices"] = quad.add_accessor(bytes, type, 3, "SCALAR");
    const Mesh mesh = load_gltf(quad.write()).meshes.at(0);
    EXPECT_EQ(mesh.indices.size(), 3U);
    expect_near(mesh.vertices[mesh.indices[1]].position, {-1, -1, 0});
  }
  GltfBuilder fan = make_quad();
  auto& primitive = fan.json["meshes"][0]["primitives"][0];
  primitive.erase("indices");
  primitive["mode"] = 6;
  EXPECT_EQ(load_gltf(fan.write()).meshes.at(0).indices.size(), 6U);
}

TEST(Gltf, StridesAndOffsetsAreFollowed) {
  GltfBuilder quad = make_quad();
  std::vector<float> interleaved{99};
  for (const glm::vec3& p : {glm::vec3{-1, 1, 0}, {1, 1, 0}, {1, -1, 0}, {-1, -1, 0}}) {
    interleaved.insert(interleaved.end(), {p.x, p.y, p.z, 7, 7});
  }
  const int accessor = quad.add_floats(interleaved, "SCALAR");
  auto& a = quad.json["accessors"][static_cast<std::size_t>(accessor)];
  a["type"] = "VEC3";
  a["count"] = 4;
  a["byteOffset"] = 4;
  quad.json["bufferViews"].back()["byteStride"] = 20;
  quad.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = accessor;
  const Mesh mesh = load_gltf(quad.write()).meshes.at(0);
  expect_near(mesh.vertices[mesh.indices[1]].position, {-1, -1, 0});
  expect_near(mesh.vertices[mesh.indices[5]].position, {1, 1, 0});
}

TEST(Gltf, NormalizedIntegersAreFractions) {
  GltfBuilder quad = make_quad();
  const std::vector<std::uint8_t> bytes{0, 0, 0, 0, 255, 0, 0, 0, 255, 51, 0, 0, 0, 255, 0, 0};
  const int accessor = quad.add_accessor(bytes, 5121, 4, "VEC2");
  quad.json["accessors"].back()["normalized"] = true;
  quad.json["bufferViews"].back()["byteStride"] = 4;
  quad.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = accessor;
  const Mesh mesh = load_gltf(quad.write()).meshes.at(0);
  const Vertex& third = mesh.vertices[mesh.indices[2]];
  EXPECT_FLOAT_EQ(third.uv0.x, 1.0F);
  EXPECT_FLOAT_EQ(third.uv0.y, 0.2F);
}

TEST(Gltf, SparseAccessorsReplaceElements) {
  GltfBuilder quad = make_quad();
  const int indices = quad.add_view(std::vector<std::uint8_t>{1, 3});
  const std::vector<float> values{5, 1, 0, -1, -6, 0};
  std::vector<std::uint8_t> bytes(values.size() * 4);
  std::memcpy(bytes.data(), values.data(), bytes.size());
  const int replacements = quad.add_view(bytes);
  quad.json["accessors"][0]["sparse"] = {{"count", 2},
                                         {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                                         {"values", {{"bufferView", replacements}}}};
  const Mesh mesh = load_gltf(quad.write()).meshes.at(0);
  expect_near(mesh.vertices[mesh.indices[0]].position, {-1, 1, 0});
  expect_near(mesh.vertices[mesh.indices[1]].position, {-1, -6, 0});
  expect_near(mesh.vertices[mesh.indices[5]].position, {5, 1, 0});
}

TEST(Gltf, InstancesOfOneMaterialAreMerged) {
  GltfBuilder quad = make_quad();
  quad.json["materials"] = {{{"name", "a"}}, {{"name", "b"}}, {{"name", "unused"}}};
  quad.json["meshes"].push_back(quad.json["meshes"][0]);
  quad.json["meshes"][0]["primitives"][0]["material"] = 1;
  quad.json["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"translation", {5, 0, 0}}}, {{"mesh", 1}}};
  quad.json["scenes"] = {{{"nodes", {0, 1, 2}}}};
  const Model model = load_gltf(quad.write());
  ASSERT_EQ(model.meshes.size(), 2U);
  ASSERT_EQ(model.materials.size(), 2U);
  EXPECT_EQ(model.materials[static_cast<std::size_t>(model.meshes[0].material)].name, "b");
  EXPECT_EQ(model.meshes[0].vertices.size(), 8U);
  EXPECT_EQ(model.meshes[0].vertices[4].position.x, model.meshes[0].vertices[0].position.x + 5.0F);
  EXPECT_EQ(model.meshes[1].vertices.size(), 4U);
}

TEST(Gltf, SceneSelectionFollowsTheFile) {
  GltfBuilder quad = make_quad();
  quad.json["nodes"] = {{{"mesh", 0}, {"translation", {1, 0, 0}}}, {{"mesh", 0}, {"translation", {2, 0, 0}}}};
  quad.json["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
  const auto centre = [](const GltfBuilder& builder) {
    const Mesh mesh = load_gltf(builder.write()).meshes.at(0);
    return 0.5F * (mesh.vertices[0].position.x + mesh.vertices[2].position.x);
  };
  EXPECT_EQ(load_gltf(quad.write()).meshes.at(0).vertices.size(), 4U);
  const float first = centre(quad);
  quad.json["scene"] = 1;
  EXPECT_EQ(centre(quad), first + 1.0F);
  quad.json.erase("scene");
  quad.json.erase("scenes");
  EXPECT_EQ(load_gltf(quad.write()).meshes.at(0).vertices.size(), 8U);  // all root nodes
}

TEST(Gltf, CamerasAreTakenExactly) {
  GltfBuilder quad = make_quad();
  quad.json["cameras"] = {
      {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"aspectRatio", 1.5}, {"znear", 0.1}, {"zfar", 50}}}},
      {{"type", "orthographic"}, {"orthographic", {{"xmag", 4}, {"ymag", 2}, {"znear", 0}, {"zfar", 9}}}}};
  // Turned by half a turn about y and scaled: the scale must not reach the camera.
  quad.json["nodes"] = {{{"mesh", 0}},
                        {{"camera", 0}, {"rotation", {0, 1, 0, 0}}, {"translation", {1, 2, 3}}, {"scale", {2, 5, 7}}},
                        {{"camera", 1}}};
  quad.json["scenes"][0]["nodes"] = {0, 1, 2};
  const Model model = load_gltf(quad.write());
  ASSERT_TRUE(model.camera);
  EXPECT_FLOAT_EQ(model.camera->yfov, 0.5F);
  EXPECT_FLOAT_EQ(*model.camera->aspect, 1.5F);
  EXPECT_FLOAT_EQ(model.camera->znear, 0.1F);
  EXPECT_FLOAT_EQ(*model.camera->zfar, 50.0F);
  expect_near(glm::vec3{model.camera->world[0]}, {-1, 0, 0});
  expect_near(glm::vec3{model.camera->world[1]}, {0, 1, 0});
  expect_near(glm::vec3{model.camera->world[2]}, {0, 0, -1});
  expect_near(glm::vec3{model.camera->world[3]}, {1, 2, 3});
  EXPECT_TRUE(mentions(model.warnings, "the first of 2 cameras"));

  quad.json["scenes"][0]["nodes"] = {0, 2, 1};
  const auto orthographic = load_gltf(quad.write()).camera;
  ASSERT_TRUE(orthographic);
  EXPECT_TRUE(orthographic->orthographic);
  EXPECT_FLOAT_EQ(orthographic->ymag, 2.0F);
  EXPECT_FLOAT_EQ(*orthographic->aspect, 2.0F);
  EXPECT_FLOAT_EQ(orthographic->znear, 0.0F);
}

TEST(Gltf, PunctualLightsAreTakenExactly) {
  GltfBuilder quad = make_quad();
  quad.json["extensionsUsed"] = {"KHR_lights_punctual"};
  quad.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "point"}, {"intensity", 20}, {"color", {1, 0.5, 0}}, {"range", 8}},
      {{"type", "directional"}},
      {{"type", "spot"}, {"intensity", 3}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.3}}}}};
  const auto light = [](int index, json node) {
    node["extensions"]["KHR_lights_punctual"]["light"] = index;
    return node;
  };
  const double half = std::numbers::pi / 4.0;
  const json turned = {0, std::sin(half), 0, std::cos(half)};  // takes -z to -x
  quad.json["nodes"] = {{{"mesh", 0}},
                        light(0, {{"translation", {1, 2, 3}}}),
                        light(1, {{"rotation", turned}, {"scale", {1, 1, 9}}}),
                        light(2, {{"rotation", turned}})};
  quad.json["scenes"][0]["nodes"] = {0, 1, 2, 3};
  const Model model = load_gltf(quad.write());
  ASSERT_EQ(model.lights.size(), 3U);
  const auto& point = std::get<PointLight>(model.lights[0]);
  expect_near(point.position, {1, 2, 3});
  expect_near(point.intensity, {20, 10, 0});
  EXPECT_FLOAT_EQ(point.range.value(), 8.0F);
  const auto& sun = std::get<DirectionalLight>(model.lights[1]);
  expect_near(sun.direction, {-1, 0, 0});
  expect_near(sun.illuminance, {1, 1, 1});
  const auto& spot = std::get<SpotLight>(model.lights[2]);
  expect_near(spot.direction, {-1, 0, 0});
  EXPECT_FLOAT_EQ(spot.inner_cone_angle, 0.1F);
  EXPECT_FLOAT_EQ(spot.outer_cone_angle, 0.3F);
  EXPECT_FALSE(spot.point.range);
}

// The quad with one light of a node, below a node with `above`.
GltfBuilder lit_quad(const json& light, const json& node = json::object(), const json& above = json::object()) {
  GltfBuilder quad = make_quad();
  quad.json["extensions"]["KHR_lights_punctual"]["lights"] = {light};
  quad.json["nodes"] = {{{"mesh", 0}}, node, above};
  quad.json["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = 0;
  quad.json["nodes"][2]["children"] = {1};
  quad.json["scenes"][0]["nodes"] = {0, 2};
  return quad;
}

TEST(Gltf, ConesWithoutAnInnerPartAreHard) {
  const auto cone = [](double inner, double outer) {
    return lit_quad({{"type", "spot"}, {"spot", {{"innerConeAngle", inner}, {"outerConeAngle", outer}}}});
  };
  for (const auto& [inner, outer] :
       {std::pair{0.4, 0.4}, {0.7853981633974484, 0.785398163397448}, {0.39999999999, 0.4}, {1.5707964, 1.5707964}}) {
    const Model model = load_gltf(cone(inner, outer).write());
    const auto& spot = std::get<SpotLight>(model.lights.at(0));
    EXPECT_EQ(spot.inner_cone_angle, spot.outer_cone_angle);
    EXPECT_EQ(spot.outer_cone_angle, static_cast<float>(outer));
    EXPECT_TRUE(mentions(model.warnings, "hard edge")) << inner;
  }
  EXPECT_TRUE(load_gltf(cone(0.3, 0.4).write()).warnings.empty());
  for (const auto& [inner, outer] : {std::pair{0.5, 0.4}, {-0.1, 0.4}, {0.1, 1.6}, {0.0, 0.0}})
    EXPECT_NE(test::usage_error([&] { return load_gltf(cone(inner, outer).write()); }), "") << inner;
}

TEST(Gltf, LightsHaveTheValuesThatTheFormatSupplies) {
  const auto light = [](const json& source) { return load_gltf(lit_quad(source).write()).lights.at(0); };
  const auto spot = std::get<SpotLight>(light({{"type", "spot"}, {"spot", json::object()}}));
  EXPECT_EQ(spot.inner_cone_angle, 0.0F);
  EXPECT_FLOAT_EQ(spot.outer_cone_angle, std::numbers::pi_v<float> / 4.0F);
  EXPECT_EQ(spot.point.intensity, glm::vec3(1.0F));
  EXPECT_FALSE(spot.point.range);
  const Model no_range = load_gltf(lit_quad({{"type", "point"}, {"range", 0}}).write());
  EXPECT_FALSE(std::get<PointLight>(no_range.lights.at(0)).range);
  EXPECT_TRUE(mentions(no_range.warnings, "range of 0"));
}

TEST(Gltf, SpotLightsWithoutAConeHaveTheDefault) {
  const Model model = load_gltf(lit_quad({{"type", "spot"}, {"intensity", 3}}).write());
  EXPECT_TRUE(mentions(model.warnings, "from 0 to 45 degrees"));
  const auto& spot = std::get<SpotLight>(model.lights.at(0));
  EXPECT_EQ(spot.inner_cone_angle, 0.0F);
  EXPECT_FLOAT_EQ(spot.outer_cone_angle, std::numbers::pi_v<float> / 4.0F);
  EXPECT_EQ(spot.point.intensity, glm::vec3(3.0F));
}

TEST(Gltf, LightsThatAreScaledToNothingAreLeftOut) {
  const json nothing{{"scale", {0, 0, 0}}}, flat{{"scale", {1, 1, 0}}}, whole = json::object();
  const json spot{{"type", "spot"}, {"spot", json::object()}}, point{{"type", "point"}}, sun{{"type", "directional"}};
  for (const json& light : {spot, point, sun}) {
    for (const auto& [node, above] : {std::pair{nothing, whole}, {whole, nothing}}) {
      const Model model = load_gltf(lit_quad(light, node, above).write());
      EXPECT_TRUE(model.lights.empty()) << light;
      EXPECT_TRUE(mentions(model.warnings, "scales it to nothing")) << light;
    }
    const Model model = load_gltf(lit_quad(light, flat).write());  // a point needs no direction
    EXPECT_EQ(model.lights.size(), light == point ? 1U : 0U) << light;
  }
}

// Node 1 is below node 0; meshes and lights of hidden nodes are left out, cameras stay.
TEST(Gltf, HiddenNodesAreLeftOutWithAllBelow) {
  const auto model_of = [](const std::optional<bool>& parent, const std::optional<bool>& child) {
    GltfBuilder quad = make_quad();
    quad.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}}};
    quad.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    quad.json["nodes"] = {{{"children", {1}}}, {{"mesh", 0}, {"camera", 0}}, {{"mesh", 0}}};
    quad.json["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    quad.json["scenes"][0]["nodes"] = {0, 2};
    quad.json["extensionsUsed"] = quad.json["extensionsRequired"] = {"KHR_node_visibility"};
    if (parent) quad.json["nodes"][0]["extensions"]["KHR_node_visibility"]["visible"] = *parent;
    if (child) quad.json["nodes"][1]["extensions"]["KHR_node_visibility"]["visible"] = *child;
    return load_gltf(quad.write());
  };
  for (const auto& [parent, child, visible] : {std::tuple<std::optional<bool>, std::optional<bool>, bool>{{}, {}, true},
                                               {true, true, true},
                                               {true, {}, true},
                                               {{}, false, false},
                                               {false, {}, false},
                                               {false, true, false},
                                               {true, false, false}}) {
    const Model model = model_of(parent, child);
    EXPECT_EQ(model.meshes.at(0).indices.size(), visible ? 12U : 6U);
    EXPECT_EQ(model.lights.size(), visible ? 1U : 0U);
    EXPECT_TRUE(model.camera);
    EXPECT_TRUE(model.warnings.empty());
  }
}

TEST(Gltf, PointsAndLinesAreLeftOutOnce) {
  GltfBuilder quad = make_quad();
  auto& primitives = quad.json["meshes"][0]["primitives"];
  primitives.push_back(primitives[0]);
  primitives.push_back(primitives[0]);
  primitives[1]["mode"] = 0;
  primitives[2]["mode"] = 3;
  const Model model = load_gltf(quad.write());
  EXPECT_EQ(model.meshes.at(0).indices.size(), 6U);
  EXPECT_EQ(model.warnings.size(), 1U);
}

TEST(Gltf, DegenerateTrianglesStay) {
  GltfBuilder quad = make_quad();
  const int indices = quad.add_indices({0, 3, 2, 1, 1, 1, 0, 2, 2});
  quad.json["meshes"][0]["primitives"][0]["indices"] = indices;
  const Model model = load_gltf(quad.write());
  EXPECT_EQ(model.meshes.at(0).indices.size(), 9U);
  for (const Vertex& vertex : model.meshes[0].vertices) EXPECT_TRUE(std::isfinite(glm::length(vertex.tangent)));
}

TEST(Gltf, ExternalFilesAreReadWithEscapedNames) {
  GltfBuilder quad = make_quad();
  std::string bytes(quad.data.begin(), quad.data.end());
  test::write_file("external/buffer one.bin", bytes);
  json document = quad.json;
  document["buffers"] = {{{"byteLength", bytes.size()}, {"uri", "../external/buffer%20one.bin"}}};
  EXPECT_EQ(load_gltf(test::write_file("sub/made.gltf", document.dump())).meshes.at(0).vertices.size(), 4U);
}

TEST(Gltf, ImagesAreReadFromAbsolutePathsToo) {
  GltfBuilder quad = make_quad();
  const std::filesystem::path file = std::filesystem::absolute(test::write_file("apart/wall.png", ""));
  write_png(file, Image(2, 2, 3, 1.0F));
  quad.json["images"] = {{{"uri", file.parent_path().string() + "/w%61ll.png"}}};
  quad.json["textures"] = {{{"source", 0}}};
  quad.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  quad.json["meshes"][0]["primitives"][0]["material"] = 0;
  const Model model = load_gltf(quad.write());
  ASSERT_TRUE(model.materials.at(0).base_color_map);
  EXPECT_EQ(model.materials[0].base_color_map->image.decoded().at(1, 1)[0], 1.0F);
}

}  // namespace
}  // namespace footprint
