// What the materials and the textures of a well-formed glTF file become, against values worked out by hand.
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <webp/encode.h>

#include <array>
#include <cmath>
#include <numbers>

#include "renderer/image/image_io.hpp"
#include "renderer/scene/model.hpp"
#include "tests/support/expect_near.hpp"
#include "tests/support/gltf_builder.hpp"
#include "tests/support/says.hpp"

namespace footprint {
namespace {

using nlohmann::json;
using test::expect_near;
using test::GltfBuilder;
using test::make_quad;
using test::says;

Image one_colour(const glm::vec3& bytes) {
  Image image(2, 2, 3);
  for (std::size_t i = 0; i < image.texels.size(); ++i) image.texels[i] = bytes[static_cast<int>(i % 3)] / 255.0F;
  return image;
}

TEST(Gltf, MaterialFactorsAndFlags) {
  GltfBuilder quad = make_quad();
  quad.json["materials"] = {
      {{"name", "m"},
       {"doubleSided", true},
       {"alphaMode", "MASK"},
       {"alphaCutoff", 0.25},
       {"emissiveFactor", {0, 1, 0.5}},
       {"extensions",
        {{"KHR_materials_ior", {{"ior", 2.0}}}, {"KHR_materials_emissive_strength", {{"emissiveStrength", 4.0}}}}},
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
  EXPECT_TRUE(says(fmt::format("{}", fmt::join(model.warnings, "; ")), "KHR_materials_sheen"));
  EXPECT_EQ(material.emission, glm::vec3(0.0F, 4.0F, 2.0F));
  EXPECT_FALSE(says(fmt::format("{}", fmt::join(model.warnings, "; ")), "emissive"));
  EXPECT_FALSE(says(fmt::format("{}", fmt::join(model.warnings, "; ")), "KHR_materials_ior"));
}

// A file of floats as a texture: normals must be encoded like those of a PNG, roughness must be 0 to 1.
TEST(Gltf, FloatsInTexturesAreCheckedAsTheirUseDemands) {
  GltfBuilder quad = make_quad();
  Image unit(2, 1, 3);
  unit.texels = {0.6F, 0.0F, 0.8F, 0.0F, -0.6F, 0.8F};
  const std::filesystem::path file = test::write_file("floats/model.gltf", "");
  write_exr(file.parent_path() / "floats.exr", unit);
  quad.json["images"] = {{{"uri", "floats.exr"}}};
  quad.json["textures"] = {{{"source", 0}}};
  quad.json["meshes"][0]["primitives"][0]["material"] = 0;
  quad.json["materials"] = {{{"normalTexture", {{"index", 0}}}}};
  const auto load = [&] { return load_gltf(test::write_file("floats/model.gltf", quad.text())); };
  const std::string error = test::usage_error(load);
  EXPECT_TRUE(says(error, "floats.exr")) << error;
  EXPECT_TRUE(says(error, "normals of -1 to 1")) << error;
  quad.json["materials"] = {{{"pbrMetallicRoughness", {{"metallicRoughnessTexture", {{"index", 0}}}}}}};
  EXPECT_TRUE(says(fmt::format("{}", fmt::join(load().warnings, "; ")), "1 values are outside of 0 to 1 (-0.6 to 1)"));
}

TEST(Gltf, MaterialsOfOneNameAreToldApart) {
  GltfBuilder quad = make_quad();
  quad.json["materials"] = {{{"name", "steel"}}, json::object(), {{"name", "steel"}}, {{"name", "material 1"}}};
  json& primitives = quad.json["meshes"][0]["primitives"];
  for (int material = 3; material >= 0; --material) {
    if (material < 3) primitives.push_back(primitives[0]);
    primitives.back()["material"] = material;
  }
  std::vector<std::string> names;
  for (const Material& material : load_gltf(quad.write()).materials) names.push_back(material.name);
  EXPECT_EQ(names, (std::vector<std::string>{"material 1 [3]", "steel [2]", "material 1 [1]", "steel [0]"}));
}

// EXT_texture_webp: the WebP, required or not, whatever the fallback; without the extension the source.
TEST(Gltf, WebpTexturesAreReadBeforeTheirFallback) {
  GltfBuilder quad = make_quad();
  const int texture = quad.add_texture(one_colour({255, 0, 0}));
  const std::array<std::uint8_t, 3> blue{0, 0, 255};
  std::uint8_t* encoded = nullptr;
  const std::size_t size = WebPEncodeLosslessRGB(blue.data(), 1, 1, 3, &encoded);
  const int view = quad.add_view({encoded, size});
  WebPFree(encoded);
  const std::size_t webp = quad.json["images"].size();
  quad.json["images"].push_back({{"bufferView", view}, {"mimeType", "image/webp"}});
  quad.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", texture}}}}}}};
  quad.json["meshes"][0]["primitives"][0]["material"] = 0;
  const json fallback = quad.json["textures"][0];
  json both = fallback, alone;
  both["extensions"]["EXT_texture_webp"]["source"] = webp;
  alone["extensions"] = both["extensions"];
  for (const json& entry : {both, alone}) {
    for (const char* const list : {"extensionsUsed", "extensionsRequired"}) {
      quad.json["textures"][0] = entry;
      quad.json[list] = {"EXT_texture_webp"};
      const Model model = load_gltf(quad.write());
      EXPECT_TRUE(model.warnings.empty()) << model.warnings.front();
      EXPECT_EQ(model.materials.at(0).base_color_map->image.decoded().texels, (std::vector{0.0F, 0.0F, 1.0F, 1.0F}));
    }
  }
  quad.json["textures"][0]["extensions"]["EXT_texture_webp"]["source"] = 7;
  EXPECT_TRUE(says(test::usage_error([&] { return load_gltf(quad.write()); }), "EXT_texture_webp.source"));
  quad.json["textures"][0] = fallback;
  EXPECT_EQ(load_gltf(quad.write()).materials.at(0).base_color_map->image.decoded().texels[0], 1.0F);
}

// The quad with eight sets of texture coordinates, set n shifted by n, and the sets of its three maps.
GltfBuilder quad_with_sets(int normal, int base_color, int rough) {
  GltfBuilder quad = make_quad();
  json& primitive = quad.json["meshes"][0]["primitives"][0];
  for (int set = 0; set < 8; ++set) {
    const auto shift = static_cast<float>(set);
    primitive["attributes"][fmt::format("TEXCOORD_{}", set)] =
        quad.add_floats({shift, 0, shift + 1, 0, shift + 1, 1, shift, 1}, "VEC2");
  }
  const int texture = quad.add_texture(one_colour({128, 128, 255}));
  const auto map = [&](int set) { return json{{"index", texture}, {"texCoord", set}}; };
  quad.json["materials"] = {
      {{"normalTexture", map(normal)},
       {"pbrMetallicRoughness", {{"baseColorTexture", map(base_color)}, {"metallicRoughnessTexture", map(rough)}}}}};
  primitive["material"] = 0;
  return quad;
}

// The set of the file that a map looks up, by the values of the vertices.
int set_of(const Model& model, const std::optional<TextureMap>& map) {
  const Vertex& vertex = model.meshes.at(0).vertices.at(0);
  const TextureCoordinates& coordinates = map.value().coordinates;
  const float u = (coordinates.set == 1 ? vertex.uv1 : vertex.uv0).x;
  const int set = static_cast<int>(u - 0.5F * (vertex.position.x + 1.0F));
  EXPECT_EQ(coordinates.texcoord.value_or(coordinates.set), set);
  return set;
}

TEST(Gltf, MapsReadAnySetOfTextureCoordinates) {
  for (const int normal : {0, 1, 2, 7}) {
    for (const int base : {0, 1, 2, 7}) {
      const Model model = load_gltf(quad_with_sets(normal, base, normal).write());
      const Material& material = model.materials.at(0);
      EXPECT_EQ(set_of(model, material.normal_map), normal);
      EXPECT_EQ(set_of(model, material.base_color_map), base);
      EXPECT_EQ(set_of(model, material.metallic_roughness_map), normal);
      EXPECT_TRUE(model.warnings.empty()) << normal << ", " << base;
    }
  }
}

TEST(Gltf, MapsOfAThirdSetAreLeftOutButNotTheNormals) {
  const Model model = load_gltf(quad_with_sets(5, 0, 3).write());
  EXPECT_EQ(set_of(model, model.materials.at(0).normal_map), 5);
  EXPECT_EQ(set_of(model, model.materials[0].base_color_map), 0);
  EXPECT_FALSE(model.materials[0].metallic_roughness_map);
  EXPECT_TRUE(says(fmt::format("{}", fmt::join(model.warnings, "; ")), "TEXCOORD_3"));
  GltfBuilder coated = quad_with_sets(5, 0, 5);
  json& coat = coated.json["materials"][0]["extensions"]["KHR_materials_clearcoat"];
  coat = {{"clearcoatFactor", 1}, {"clearcoatNormalTexture", {{"index", 0}, {"texCoord", 4}}}};
  const Model with_coat = load_gltf(coated.write());
  EXPECT_EQ(set_of(with_coat, with_coat.materials.at(0).normal_map), 5);
  EXPECT_EQ(set_of(with_coat, with_coat.materials[0].coat.value().normal_map), 4);
  EXPECT_FALSE(with_coat.materials[0].base_color_map);
}

TEST(Gltf, CoatsWhoseNormalsAreTurnedOtherwiseAreNamed) {
  const auto warnings = [](const json& coat_transform) {
    GltfBuilder quad = quad_with_sets(0, 0, 0);
    json map{{"index", 0}};
    map["extensions"]["KHR_texture_transform"] = coat_transform;
    quad.json["materials"][0]["extensions"]["KHR_materials_clearcoat"] = {{"clearcoatFactor", 1},
                                                                          {"clearcoatNormalTexture", map}};
    return fmt::format("{}", fmt::join(load_gltf(quad.write()).warnings, "; "));
  };
  EXPECT_EQ(warnings({{"scale", {3, 2}}, {"offset", {0.5, 0}}}), "");
  for (const json& turned : {json{{"rotation", 0.3}}, json{{"scale", {-1, 1}}}, json{{"texCoord", 2}}})
    EXPECT_TRUE(says(warnings(turned), "turned against the one below")) << turned;
}

// glTF 2.0, section 3.9.3: light times its texture, which alone has no effect, and 1 + strength (red - 1).
TEST(Gltf, EmissiveAndOcclusionTextures) {
  GltfBuilder quad = make_quad();
  Image stored(2, 2, 3, 1.0F);
  stored.at(0, 0)[0] = 128.0F / 255.0F;
  const json info = {{"index", quad.add_texture(stored)}};
  json occlusion = info;
  occlusion["strength"] = 0.25;
  quad.json["materials"] = {{{"emissiveFactor", {1, 1, 1}}, {"emissiveTexture", info}, {"occlusionTexture", occlusion}},
                            {{"emissiveTexture", info}}};
  auto& primitives = quad.json["meshes"][0]["primitives"];
  primitives.push_back(primitives[0]);
  primitives[0]["material"] = 0;
  primitives[1]["material"] = 1;
  const Model model = load_gltf(quad.write());
  const Material& first = model.materials.at(0);
  EXPECT_NEAR(first.emission_map.value().image.decoded().at(0, 0)[0], 0.21586, 1e-4);  // IEC 61966-2-1
  EXPECT_NEAR(first.occlusion_map.value().image.decoded().at(0, 0)[0], 1.0 + 0.25 * (128.0 / 255.0 - 1.0), 1e-6);
  EXPECT_EQ(first.occlusion_map->image.decoded().at(1, 0)[0], 1.0F);
  EXPECT_EQ(model.materials.at(1).emission, glm::vec3(0.0F));
  EXPECT_FALSE(model.materials.at(1).emission_map);
  EXPECT_TRUE(model.warnings.empty());
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

// KHR_materials_anisotropy: two factors, and a texture of directions and strengths. Strength 0 is no anisotropy.
TEST(Gltf, AnisotropyHasAStrengthARotationAndATexture) {
  GltfBuilder quad = make_quad();
  quad.json["extensionsUsed"] = {"KHR_materials_anisotropy"};
  quad.json["meshes"][0]["primitives"][0]["material"] = 0;
  const auto loaded = [&](const json& extension) {
    quad.json["materials"] = {{{"extensions", {{"KHR_materials_anisotropy", extension}}}}};
    return load_gltf(quad.write());
  };
  const Model model = loaded({{"anisotropyStrength", 0.6}, {"anisotropyRotation", 1.25}});
  EXPECT_TRUE(model.warnings.empty());
  EXPECT_EQ(model.materials.at(0).anisotropy, (Anisotropy{0.6F, 1.25F}));
  EXPECT_FALSE(loaded({{"anisotropyRotation", 1.25}}).materials.at(0).anisotropy) << "a strength of 0 is the default";
  const auto textured = [&](const Image& texels) {
    const int texture = quad.add_texture(texels);
    return loaded(
        {{"anisotropyStrength", 0.6}, {"anisotropyRotation", 0.5}, {"anisotropyTexture", {{"index", texture}}}});
  };
  const auto expect = [](const Model& read, float strength, float rotation) {
    ASSERT_TRUE(read.materials.at(0).anisotropy);
    EXPECT_NEAR(read.materials.at(0).anisotropy->strength, strength, 1e-6F);
    EXPECT_NEAR(read.materials.at(0).anisotropy->rotation, rotation, 1e-6F);
  };
  // (x, y) = (1, 1) is 45 degrees, whatever its length; blue 51 is a fifth of the strength.
  const Model constant = textured(one_colour({255.0F, 255.0F, 51.0F}));
  EXPECT_TRUE(constant.warnings.empty());
  EXPECT_FALSE(constant.materials.at(0).anisotropy_map);
  expect(constant, 0.6F * 0.2F, 0.5F + std::numbers::pi_v<float> / 4.0F);
}

// Each texel of the texture has s^2 (cos 2 phi, sin 2 phi): directions are axes, and blue is a share of the strength.
TEST(Gltf, AnisotropyVariesWithItsTexture) {
  GltfBuilder quad = make_quad();
  quad.json["extensionsUsed"] = {"KHR_materials_anisotropy"};
  quad.json["meshes"][0]["primitives"][0]["material"] = 0;
  Image stored(2, 2, 3, 1.0F);  // 45 degrees, its opposite, x at a fifth of the strength, and y
  stored.texels = {1.0F, 1.0F, 1.0F, 0.0F, 0.0F, 1.0F, 1.0F, 128.0F / 255.0F, 0.2F, 128.0F / 255.0F, 1.0F, 1.0F};
  const int texture = quad.add_texture(stored);
  quad.json["materials"] = {
      {{"extensions",
        {{"KHR_materials_anisotropy",
          {{"anisotropyStrength", 0.5}, {"anisotropyRotation", 0.25}, {"anisotropyTexture", {{"index", texture}}}}}}}}};
  const Model model = load_gltf(quad.write());
  EXPECT_TRUE(model.warnings.empty());
  const Material& material = model.materials.at(0);
  ASSERT_TRUE(material.anisotropy_map && material.anisotropy);
  const Image axes = material.anisotropy_map->image.decoded();
  const auto expect = [&](std::size_t texel, double squared, double degrees) {
    const double angle = 2.0 * (glm::radians(degrees) + 0.25);
    EXPECT_NEAR(axes.texels[2 * texel], squared * std::cos(angle), 1e-2 * squared);
    EXPECT_NEAR(axes.texels[2 * texel + 1], squared * std::sin(angle), 1e-2 * squared);
  };
  expect(0, 0.25, 45.0);
  expect(1, 0.25, 45.0);
  expect(2, 0.01, 0.0);
  expect(3, 0.25, 90.0);
  const double x = axes.texels[0] + axes.texels[2] + axes.texels[4] + axes.texels[6];
  const double y = axes.texels[1] + axes.texels[3] + axes.texels[5] + axes.texels[7];
  EXPECT_NEAR(material.anisotropy->strength, std::sqrt(0.25 * std::hypot(x, y)), 1e-6);
  EXPECT_NEAR(material.anisotropy->rotation, 0.5 * std::atan2(y, x), 1e-6);
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
  EXPECT_TRUE(says(fmt::format("{}", fmt::join(both.warnings, "; ")), "the mean over the texture, 0.75"));
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
  EXPECT_TRUE(says(fmt::format("{}", fmt::join(model.warnings, "; ")), "no TEXCOORD_1"));
}

}  // namespace
}  // namespace footprint
