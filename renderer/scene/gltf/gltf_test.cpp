// What a well-formed glTF file becomes, against values worked out by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

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

Image one_colour(const glm::vec3& bytes) {
  Image image(2, 2, 3);
  for (std::size_t i = 0; i < image.texels.size(); ++i) image.texels[i] = bytes[static_cast<int>(i % 3)] / 255.0F;
  return image;
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

TEST(Gltf, MaterialFactorsAndFlags) {
  GltfBuilder quad = make_quad();
  quad.json["materials"] = {
      {{"name", "m"},
       {"doubleSided", true},
       {"alphaMode", "MASK"},
       {"alphaCutoff", 0.25},
       {"emissiveFactor", {0, 1, 0}},
       {"extensions", {{"KHR_materials_ior", {{"ior", 2.0}}}}},
       {"pbrMetallicRoughness",
        {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"metallicFactor", 0.5}, {"roughnessFactor", 0.75}}}}};
  quad.json["extensionsUsed"] = {"KHR_materials_ior", "KHR_materials_sheen"};
  quad.json["meshes"][0]["primitives"][0]["material"] = 0;
  const Model model = load_gltf(quad.write());
  const Material& material = model.materials.at(0);
  EXPECT_EQ(material.base_color, glm::vec4(0.1F, 0.2F, 0.3F, 0.4F));
  EXPECT_EQ(material.metallic, 0.5F);
  EXPECT_EQ(material.roughness, 0.75F);
  EXPECT_EQ(material.alpha_cutoff, 0.25F);
  EXPECT_TRUE(material.double_sided);
  EXPECT_NEAR(material.dielectric_specular.g, 1.0 / 9.0, 1e-6);
  EXPECT_TRUE(mentions(model.warnings, "KHR_materials_sheen"));
  EXPECT_TRUE(mentions(model.warnings, "emissive"));
  EXPECT_FALSE(mentions(model.warnings, "KHR_materials_ior"));
}

TEST(Gltf, MapsAreDecodedAndShared) {
  GltfBuilder quad = make_quad();
  Image stored(2, 2, 3, 1.0F);
  stored.at(0, 0)[0] = 128.0F / 255.0F;
  const int texture = quad.add_texture(stored);
  const json info = {{"index", texture}};
  quad.json["materials"] = {{{"pbrMetallicRoughness",
                              {{"baseColorTexture", info},
                               {"metallicRoughnessTexture", info},
                               {"metallicFactor", 0.5},
                               {"roughnessFactor", 0.25}}},
                             {"normalTexture", info}},
                            {{"normalTexture", info}}};
  auto& primitives = quad.json["meshes"][0]["primitives"];
  primitives.push_back(primitives[0]);
  primitives[0]["material"] = 0;
  primitives[1]["material"] = 1;
  const Model model = load_gltf(quad.write());
  const Material& material = model.materials.at(0);
  ASSERT_TRUE(material.base_color_map && material.metallic_roughness_map && material.normal_map);
  // IEC 61966-2-1 at 128 / 255.
  EXPECT_NEAR(material.base_color_map->image.decoded().at(0, 0)[0], 0.2158605, 1e-5);
  EXPECT_EQ(material.base_color_map->image.decoded().at(1, 1)[3], 1.0F);
  EXPECT_FLOAT_EQ(material.metallic_roughness_map->image.decoded().at(0, 0)[0], 0.25F);
  EXPECT_FLOAT_EQ(material.metallic_roughness_map->image.decoded().at(0, 0)[1], 0.5F);
  // (0.0039, 1, 1) normalised.
  EXPECT_NEAR(material.normal_map->image.decoded().at(0, 0)[2], std::sqrt(0.5), 1e-5);
  EXPECT_EQ(material.normal_map->image, model.materials.at(1).normal_map->image);
}

TEST(Gltf, ClearCoatsHaveFactorsAndMapsOfTheirOwn) {
  GltfBuilder quad = make_quad();
  const int texture = quad.add_texture(one_colour({51.0F, 102.0F, 255.0F}));
  const json shifted = {{"index", texture},
                        {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0.0}}, {"texCoord", 0}}}}}};
  const json coat = {{"clearcoatFactor", 0.5},
                     {"clearcoatTexture", {{"index", texture}}},
                     {"clearcoatRoughnessFactor", 0.25},
                     {"clearcoatRoughnessTexture", shifted},
                     {"clearcoatNormalTexture", {{"index", texture}, {"scale", 2.0}}}};
  quad.json["materials"] = {{{"extensions", {{"KHR_materials_clearcoat", coat}}}},
                            {{"extensions", {{"KHR_materials_clearcoat", {{"clearcoatFactor", 0.75}}}}}},
                            {{"extensions", {{"KHR_materials_clearcoat", {{"clearcoatRoughnessFactor", 0.5}}}}}}};
  quad.json["extensionsUsed"] = {"KHR_materials_clearcoat"};
  auto& primitives = quad.json["meshes"][0]["primitives"];
  for (int i = 0; i < 3; ++i) {
    if (i > 0) primitives.push_back(primitives[0]);
    primitives[static_cast<std::size_t>(i)]["material"] = i;
  }
  const Model model = load_gltf(quad.write());
  EXPECT_TRUE(model.warnings.empty());
  const std::optional<ClearCoat>& mapped = model.materials.at(0).coat;
  ASSERT_TRUE(mapped && mapped->weight_map && mapped->roughness_map && mapped->normal_map);
  EXPECT_FLOAT_EQ(mapped->weight_map->image.decoded().at(0, 0)[0], 0.5F * 51.0F / 255.0F);       // red
  EXPECT_FLOAT_EQ(mapped->roughness_map->image.decoded().at(0, 0)[0], 0.25F * 102.0F / 255.0F);  // green
  EXPECT_EQ(mapped->roughness_map->coordinates.transform[2], glm::vec2(0.5F, 0.0F));
  const glm::vec3 leaning = glm::normalize(glm::vec3(2.0F * -0.6F, 2.0F * -0.2F, 1.0F));
  const Image normals = mapped->normal_map->image.decoded();
  expect_near({normals.at(0, 0)[0], normals.at(0, 0)[1], normals.at(0, 0)[2]}, leaning);
  const std::optional<ClearCoat>& constant = model.materials.at(1).coat;
  ASSERT_TRUE(constant);
  EXPECT_EQ(constant->weight, 0.75F);
  EXPECT_EQ(constant->roughness, 0.0F);
  EXPECT_FALSE(constant->weight_map || constant->roughness_map || constant->normal_map);
  EXPECT_FALSE(model.materials.at(2).coat) << "a weight of 0, the default, is not a coat";
}

// KHR_materials_unlit: the base colour alone. What is about light is left out, without a warning.
TEST(Gltf, UnlitMaterialsHaveTheirColourAlone) {
  GltfBuilder quad = make_quad();
  const int texture = quad.add_texture(one_colour({51.0F, 102.0F, 255.0F}));
  quad.json["materials"] = {{{"extensions", {{"KHR_materials_unlit", json::object()}}},
                             {"normalTexture", {{"index", texture}}},
                             {"doubleSided", true},
                             {"pbrMetallicRoughness",
                              {{"baseColorFactor", {0.5, 0.25, 1.0, 0.75}},
                               {"roughnessFactor", 0.5},
                               {"metallicRoughnessTexture", {{"index", texture}}},
                               {"baseColorTexture", {{"index", texture}}}}}}};
  quad.json["extensionsRequired"] = quad.json["extensionsUsed"] = {"KHR_materials_unlit"};
  quad.json["meshes"][0]["primitives"][0]["material"] = 0;
  const Model model = load_gltf(quad.write());
  EXPECT_TRUE(model.warnings.empty());
  const Material& material = model.materials.at(0);
  EXPECT_TRUE(material.unlit && material.double_sided && material.base_color_map);
  EXPECT_EQ(material.base_color, glm::vec4(0.5F, 0.25F, 1.0F, 0.75F));
  EXPECT_FALSE(material.normal_map || material.metallic_roughness_map);
}

json glossy_material(const json& extension) {
  return {{"extensions", {{"KHR_materials_pbrSpecularGlossiness", extension}}},
          {"pbrMetallicRoughness", {{"baseColorFactor", {1, 0, 0, 1}}}}};  // for readers without the extension
}

GltfBuilder glossy_quad(GltfBuilder quad, const json& extension) {
  quad.json["materials"] = {glossy_material(extension)};
  quad.json["extensionsRequired"] = quad.json["extensionsUsed"] = {"KHR_materials_pbrSpecularGlossiness"};
  quad.json["meshes"][0]["primitives"][0]["material"] = 0;
  return quad;
}

// The diffuse albedo is diffuse (1 - max specular), F0 is specular, and roughness is 1 - glossiness.
TEST(Gltf, GlossyMaterialsKeepTheirReflectances) {
  const Model model = load_gltf(glossy_quad(make_quad(), {{"diffuseFactor", {0.8, 0.4, 0.2, 0.5}},
                                                          {"specularFactor", {0.1, 0.25, 0.2}},
                                                          {"glossinessFactor", 0.7}})
                                    .write());
  EXPECT_TRUE(model.warnings.empty());
  const Material& material = model.materials.at(0);
  EXPECT_EQ(material.metallic, 0.0F);
  EXPECT_FLOAT_EQ(material.roughness, 0.3F);
  EXPECT_EQ(material.dielectric_specular, glm::vec3(0.1F, 0.25F, 0.2F));
  for (const auto& [channel, wanted] : {std::pair{0, 0.6F}, {1, 0.3F}, {2, 0.15F}, {3, 0.5F}})
    EXPECT_FLOAT_EQ(material.base_color[channel], wanted);
  const Material defaults = load_gltf(glossy_quad(make_quad(), json::object()).write()).materials.at(0);
  EXPECT_EQ(defaults.roughness, 0.0F);
  EXPECT_EQ(defaults.dielectric_specular, glm::vec3(1.0F));
  EXPECT_EQ(defaults.base_color, glm::vec4(0.0F, 0.0F, 0.0F, 1.0F));
}

// Texel by texel: colours are sRGB, glossiness is linear, and a smaller texture is looked up by its nearest texel.
TEST(Gltf, GlossyTexturesAreConvertedTexelByTexel) {
  GltfBuilder quad = make_quad();
  Image diffuse(1, 2, 4, 1.0F), specular(4, 2, 4, 0.0F);
  diffuse.at(0, 1)[1] = 128.0F / 255.0F;  // linear 0.2158605, IEC 61966-2-1
  diffuse.at(0, 1)[3] = 0.2F;
  specular.at(3, 1)[0] = 128.0F / 255.0F;
  specular.at(3, 1)[3] = 0.6F;
  const json extension = {{"diffuseTexture", {{"index", quad.add_texture(diffuse)}}},
                          {"diffuseFactor", {0.5, 1.0, 1.0, 1.0}},
                          {"specularFactor", {0.5, 1.0, 1.0}},
                          {"specularGlossinessTexture", {{"index", quad.add_texture(specular)}}},
                          {"glossinessFactor", 0.5}};
  const Material material = load_gltf(glossy_quad(quad, extension).write()).materials.at(0);
  ASSERT_TRUE(material.base_color_map && material.specular_map && material.metallic_roughness_map);
  const Image color = material.base_color_map->image.decoded(), f0 = material.specular_map->image.decoded(),
              rough = material.metallic_roughness_map->image.decoded();
  EXPECT_EQ(glm::ivec2(color.width, color.height), glm::ivec2(4, 2));
  const double rest = 1.0 - 0.5 * 0.2158605;
  EXPECT_NEAR(color.at(3, 1)[0], rest, 1e-5);
  EXPECT_NEAR(color.at(3, 1)[1], 0.2158605 * rest, 1e-5);
  EXPECT_NEAR(color.at(3, 1)[3], 0.2, 1e-5);
  EXPECT_NEAR(color.at(2, 1)[1], 0.2158605, 1e-5);
  EXPECT_NEAR(color.at(3, 0)[1], 1.0, 1e-5);
  EXPECT_EQ(material.base_color, glm::vec4(0.5F, 1.0F, 1.0F, 1.0F));
  EXPECT_NEAR(f0.at(3, 1)[0], 0.2158605, 1e-5);
  EXPECT_EQ(material.dielectric_specular, glm::vec3(0.5F, 1.0F, 1.0F));
  EXPECT_NEAR(rough.at(3, 1)[0], 1.0 - 0.5 * 0.6, 1e-5);
  EXPECT_EQ(rough.at(0, 0)[0], 1.0F);
  EXPECT_EQ(rough.at(3, 1)[1], 0.0F);
}

TEST(Gltf, GlossyTexturesMayHaveCoordinatesOfTheirOwn) {
  GltfBuilder quad = make_quad();
  Image specular(2, 1, 4, 0.0F);
  specular.at(1, 0)[2] = 1.0F;
  const json shifted = {{"index", quad.add_texture(specular)},
                        {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0.0}}}}}}};
  json extension = {{"specularGlossinessTexture", shifted}, {"specularFactor", {1.0, 1.0, 0.5}}};
  const Model alone = load_gltf(glossy_quad(quad, extension).write());
  EXPECT_TRUE(alone.warnings.empty());
  EXPECT_FLOAT_EQ(alone.materials.at(0).base_color_map->image.decoded().at(1, 0)[0], 0.5F);
  EXPECT_EQ(alone.materials.at(0).base_color_map->coordinates.transform[2], glm::vec2(0.5F, 0.0F));
  extension["diffuseTexture"] = {{"index", quad.add_texture(Image(2, 2, 3, 1.0F))}};
  const Model both = load_gltf(glossy_quad(quad, extension).write());
  EXPECT_TRUE(mentions(both.warnings, "the mean over the texture, 0.75"));
  EXPECT_EQ(both.materials.at(0).base_color, glm::vec4(0.75F, 0.75F, 0.75F, 1.0F));
  EXPECT_EQ(both.materials.at(0).base_color_map->image.decoded().at(1, 0)[0], 1.0F);
}

/// The example of KHR_texture_transform: the lower left quadrant of the image, turned clockwise by 90 degrees.
TEST(Gltf, TextureTransformTurnsAsTheExtensionsExample) {
  GltfBuilder quad = make_quad();
  const int texture = quad.add_texture(Image(1, 1, 3, 1.0F));
  quad.json["textures"][0]["sampler"] = 0;
  quad.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}}};
  quad.json["materials"] = {
      {{"normalTexture",
        {{"index", texture},
         {"extensions",
          {{"KHR_texture_transform",
            {{"offset", {0, 1}}, {"rotation", std::numbers::pi / 2.0}, {"scale", {0.5, 0.5}}}}}}}}}};
  quad.json["meshes"][0]["primitives"][0]["material"] = 0;
  const Model model = load_gltf(quad.write());
  const TextureCoordinates& coordinates = model.materials.at(0).normal_map->coordinates;
  const auto look_up = [&](float u, float v) { return coordinates.transform * glm::vec3{u, v, 1.0F}; };
  const auto expect_at = [&](const glm::vec2& actual, const glm::vec2& expected) {
    EXPECT_NEAR(actual.x, expected.x, 1e-6F);
    EXPECT_NEAR(actual.y, expected.y, 1e-6F);
  };
  expect_at(look_up(0, 0), {0.0F, 1.0F});  // the image's lower left corner comes to the top left: clockwise
  expect_at(look_up(1, 0), {0.0F, 0.5F});
  expect_at(look_up(0, 1), {0.5F, 1.0F});
  expect_at(look_up(1, 1), {0.5F, 0.5F});
  EXPECT_EQ(coordinates.wrap, (std::array{Wrap::clamp_to_edge, Wrap::mirrored_repeat}));
  // u' grows with v, which points down on the quad; v' falls with u.
  for (const Vertex& vertex : model.meshes.at(0).vertices) {
    expect_near(glm::vec3{vertex.tangent}, {0, -1, 0});
    expect_near(glm::cross(vertex.normal, glm::vec3{vertex.tangent}) * vertex.tangent.w, {1, 0, 0});
  }
}

TEST(Gltf, TextureTransformMayNameAnotherSet) {
  GltfBuilder quad = make_quad();
  const int texture = quad.add_texture(Image(1, 1, 3, 1.0F));
  quad.json["materials"] = {
      {{"normalTexture", {{"index", texture}, {"extensions", {{"KHR_texture_transform", {{"texCoord", 1}}}}}}}}};
  quad.json["meshes"][0]["primitives"][0]["material"] = 0;
  const Model model = load_gltf(quad.write());
  EXPECT_EQ(model.materials.at(0).normal_map->coordinates.set, 1);
  EXPECT_TRUE(mentions(model.warnings, "no TEXCOORD_1"));
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

}  // namespace
}  // namespace footprint
