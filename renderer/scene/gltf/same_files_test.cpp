// Files that mean the same give the same triangles: indexed or not, with tangents or without, rigid or by a joint.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "renderer/scene/model.hpp"
#include "renderer/scene/tangents.hpp"
#include "tests/support/gltf_builder.hpp"

namespace footprint {
namespace {

using nlohmann::json;
using test::GltfBuilder;

constexpr std::uint16_t rows = 6;

// A bumpy sheet whose texture coordinates are mirrored beyond its middle.
Mesh make_sheet() {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> shift(-0.2F, 0.2F);
  Mesh sheet;
  for (std::uint32_t y = 0; y < rows; ++y) {
    for (std::uint32_t x = 0; x < rows; ++x) {
      Vertex& vertex = sheet.vertices.emplace_back();
      const glm::vec2 at{static_cast<float>(x), static_cast<float>(y)};
      vertex.position = {at.x + shift(random), at.y + shift(random), shift(random)};
      vertex.normal = glm::normalize(glm::vec3{shift(random), shift(random), 1.0F});
      vertex.uv0 = {std::abs(at.x - 3.0F) + 0.3F * at.y, -0.7F * at.y + shift(random)};
    }
  }
  for (std::uint32_t y = 0; y + 1 < rows; ++y) {
    for (std::uint32_t x = 0; x + 1 < rows; ++x) {
      const std::uint32_t a = y * rows + x, b = a + 1, c = a + rows, d = c + 1;
      sheet.indices.insert(sheet.indices.end(), {a, b, d, a, d, c});
    }
  }
  return sheet;
}

// How a file writes the sheet.
struct Form {
  bool indexed = true, tangents = false, skin = false;
};

// What the file means.
struct Meaning {
  glm::dvec3 scale{1.0};
  double degrees = 0;
  glm::dvec2 uv_scale{1.0};
};

Mesh in_form(const Form& form) {
  Mesh sheet = make_sheet();
  if (form.tangents) compute_tangents(sheet.vertices, sheet.indices, {});  // of the coordinates as they are
  if (form.indexed) return sheet;
  Mesh out;
  for (const std::uint32_t index : sheet.indices) {
    out.indices.push_back(static_cast<std::uint32_t>(out.vertices.size()));
    out.vertices.push_back(sheet.vertices[index]);
  }
  return out;
}

template <class Value>
std::vector<float> floats_of(const Mesh& mesh, Value Vertex::*member) {
  std::vector<float> all;
  for (const Vertex& vertex : mesh.vertices) {
    for (int i = 0; i < Value::length(); ++i) all.push_back((vertex.*member)[i]);
  }
  return all;
}

void add_skin(GltfBuilder& file, std::size_t vertices, json& attributes) {
  std::vector<float> weights;
  for (std::size_t i = 0; i < vertices; ++i) weights.insert(weights.end(), {1, 0, 0, 0});
  attributes["JOINTS_0"] = file.add_accessor(std::vector<std::uint8_t>(4 * vertices, 0), 5121, vertices, "VEC4");
  attributes["WEIGHTS_0"] = file.add_floats(weights, "VEC4");
  file.json["skins"] = {{{"joints", {1}}}};
}

Mesh loaded(const Form& form, const Meaning& meaning) {
  const Mesh mesh = in_form(form);
  GltfBuilder file;
  json attributes{{"POSITION", file.add_floats(floats_of(mesh, &Vertex::position), "VEC3")},
                  {"NORMAL", file.add_floats(floats_of(mesh, &Vertex::normal), "VEC3")},
                  {"TEXCOORD_0", file.add_floats(floats_of(mesh, &Vertex::uv0), "VEC2")}};
  if (form.tangents) attributes["TANGENT"] = file.add_floats(floats_of(mesh, &Vertex::tangent), "VEC4");
  const json placed{{"scale", {meaning.scale.x, meaning.scale.y, meaning.scale.z}}, {"rotation", {0.6, 0, 0.8, 0}}};
  file.json["nodes"] = {{{"mesh", 0}}, placed};
  file.json["nodes"][1]["children"] = {0};
  file.json["scenes"] = {{{"nodes", {1}}}};
  if (form.skin) {
    add_skin(file, mesh.vertices.size(), attributes);
    file.json["nodes"][0]["skin"] = 0;
  }
  json primitive{{"attributes", attributes}, {"material", 0}};
  if (form.indexed) primitive["indices"] = file.add_indices({mesh.indices.begin(), mesh.indices.end()});
  file.json["meshes"] = {{{"primitives", {primitive}}}};
  json texture{{"index", file.add_texture(Image(1, 1, 3, 0.5F))}};
  texture["extensions"]["KHR_texture_transform"] = {{"rotation", glm::radians(meaning.degrees)},
                                                    {"scale", {meaning.uv_scale.x, meaning.uv_scale.y}}};
  file.json["materials"] = {{{"normalTexture", texture}}};
  return load_gltf(file.write()).meshes.at(0);
}

const Vertex& corner(const Mesh& mesh, std::size_t i) { return mesh.vertices[mesh.indices[i]]; }

// The largest difference of a position, a normal or a tangent at a corner; infinite for other triangles.
double difference(const Mesh& a, const Mesh& b) {
  if (a.indices.size() != b.indices.size()) return std::numeric_limits<double>::infinity();
  double largest = 0.0;
  for (std::size_t i = 0; i < a.indices.size(); ++i) {
    const Vertex &one = corner(a, i), &two = corner(b, i);
    largest = std::max<double>({largest, glm::length(one.position - two.position), glm::length(one.normal - two.normal),
                                glm::length(one.tangent - two.tangent)});
  }
  return largest;
}

bool faces_outwards(const Mesh& mesh, std::size_t triangle) {
  const Vertex &a = corner(mesh, 3 * triangle), &b = corner(mesh, 3 * triangle + 1),
               &c = corner(mesh, 3 * triangle + 2);
  return glm::dot(glm::cross(b.position - a.position, c.position - a.position), a.normal + b.normal + c.normal) > 0.0F;
}

const std::array<glm::dvec3, 6> scales{{{1, 1, 1}, {-1, 1, 1}, {1, -1, -1}, {-1, -1, -1}, {2, 0.5, 1}, {-0.5, 1, 3}}};

std::vector<Meaning> meanings() {
  std::vector<Meaning> all;
  for (const glm::dvec3& scale : scales) {
    all.push_back({.scale = scale});
    all.push_back({scale, 90, {1, 1}});
    all.push_back({scale, 0, {-1, 1}});
    all.push_back({scale, 25, {0.5, -3}});
  }
  return all;
}

TEST(SameFiles, GiveTheSameTriangles) {
  for (const Meaning& meaning : meanings()) {
    const Mesh expected = loaded({}, meaning);
    for (int form = 1; form < 8; ++form) {
      const Mesh mesh =
          loaded({.indexed = (form & 1) == 0, .tangents = (form & 2) != 0, .skin = (form & 4) != 0}, meaning);
      EXPECT_LT(difference(mesh, expected), 2e-5)
          << "form " << form << ", scale " << meaning.scale.x << ", " << meaning.scale.y << ", " << meaning.scale.z
          << ", transform " << meaning.degrees << " degrees, " << meaning.uv_scale.x << ", " << meaning.uv_scale.y;
    }
    for (std::size_t i = 0; i < expected.indices.size() / 3; ++i) EXPECT_TRUE(faces_outwards(expected, i)) << i;
  }
}

TEST(SameFiles, DifferWhereTheMeaningDoes) {  // must fail
  const std::vector<Meaning> all = meanings();
  for (std::size_t i = 1; i < all.size(); ++i) EXPECT_GT(difference(loaded({}, all[i]), loaded({}, all[0])), 0.5) << i;
}

// One of two joints mirrors: each triangle has the winding of what moves most of its corners.
TEST(SameFiles, WindingGoesByTheJointsOfATriangle) {
  for (const int mirrored_corners : {0, 1, 2, 3}) {
    GltfBuilder file;
    const int positions = file.add_floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
    const int normals = file.add_floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    std::vector<std::uint8_t> joints(12, 0);
    for (int i = 0; i < mirrored_corners; ++i) joints[static_cast<std::size_t>(4 * i)] = 1;
    const json attributes{{"POSITION", positions},
                          {"NORMAL", normals},
                          {"JOINTS_0", file.add_accessor(joints, 5121, 3, "VEC4")},
                          {"WEIGHTS_0", file.add_floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4")}};
    file.json["meshes"] = {{{"primitives", {{{"attributes", attributes}}}}}};
    file.json["nodes"] = {{{"mesh", 0}, {"skin", 0}}, json::object(), {{"scale", {-1, 1, 1}}}};
    file.json["skins"] = {{{"joints", {1, 2}}}};
    file.json["scenes"] = {{{"nodes", {0, 1, 2}}}};
    const Mesh mesh = load_gltf(file.write()).meshes.at(0);
    const bool turned = corner(mesh, 1).position.y == 1.0F;  // the file's third corner comes second
    EXPECT_EQ(turned, mirrored_corners >= 2) << mirrored_corners;
  }
}

}  // namespace
}  // namespace footprint
