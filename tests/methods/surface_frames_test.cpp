// The directions of a normal map on surfaces of glTF files, in every combination of signs, against a formula in double
// precision.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "renderer/pipeline/base_surface.hpp"
#include "renderer/scene/model.hpp"
#include "tests/support/gltf_builder.hpp"
#include "tests/support/rendering.hpp"

namespace footprint::testing {
namespace {

using nlohmann::json;
using test::GltfBuilder;

constexpr glm::dvec3 texel{190.0, 142.0, 0.0};  // red and green; blue follows

// The stored normal with x and y times `scale`.
glm::dvec3 mapped_normal(double scale) {
  const glm::dvec2 side = glm::dvec2{texel} / 255.0 * 2.0 - 1.0;
  const double z = std::round((std::sqrt(1.0 - glm::dot(side, side)) + 1.0) / 2.0 * 255.0) / 255.0 * 2.0 - 1.0;
  return glm::normalize(glm::dvec3{scale * side, z});
}

Image normal_map() {
  const glm::dvec3 n = mapped_normal(1.0);
  Image image(2, 2, 3);
  for (std::size_t i = 0; i < image.texels.size(); i += 3) {
    for (std::size_t c = 0; c < 3; ++c) image.texels[i + c] = static_cast<float>(0.5 * (n[static_cast<int>(c)] + 1.0));
  }
  return image;
}

// KHR_texture_transform of a material, and the scale of its normal map.
struct MapForm {
  double degrees = 0;
  glm::dvec2 scale{1.0};
  double normal_scale = 1;
};

// Texture coordinates of a quad, and whether its file has tangents.
struct MeshForm {
  glm::dvec2 signs{1.0};
  bool has_tangents = false;
};

// A node turns by half a turn about an axis, none for 3, after its scale.
struct NodeForm {
  int axis = 3;
  glm::dvec3 signs{1.0};
};

std::vector<MapForm> map_forms() {
  std::vector<MapForm> forms;
  for (const double scale : {1.0, -0.7}) {
    forms.push_back({.normal_scale = scale});
    forms.push_back({90, {1, 1}, scale});
    forms.push_back({30, {1, 1}, scale});
    forms.push_back({0, {-1, 1}, scale});
    forms.push_back({-120, {1, -1}, scale});
  }
  return forms;
}

std::vector<MeshForm> mesh_forms() {
  std::vector<MeshForm> forms;
  for (const bool has_tangents : {false, true}) {
    for (const double u : {1.0, -1.0}) {
      for (const double v : {1.0, -1.0}) forms.push_back({{u, v}, has_tangents});
    }
  }
  return forms;
}

std::vector<NodeForm> node_forms() {
  std::vector<NodeForm> forms;
  for (const int axis : {3, 0, 1}) {
    for (int signs = 0; signs < 8; ++signs)
      forms.push_back({axis, {(signs & 1) != 0 ? -1 : 1, (signs & 2) != 0 ? -1 : 1, (signs & 4) != 0 ? -1 : 1}});
  }
  return forms;
}

// d uv / d (x, y) of a quad whose coordinates grow to the right and downwards, before its signs.
glm::dmat2 uv_slopes(const MeshForm& mesh) { return {glm::dvec2{mesh.signs.x, 0.0}, glm::dvec2{0.0, -mesh.signs.y}}; }

// Offset, rotation and scale of the extension's example: counter-clockwise with v downwards.
glm::dmat2 uv_transform(const MapForm& map) {
  const double c = std::cos(glm::radians(map.degrees)), s = std::sin(glm::radians(map.degrees));
  return {glm::dvec2{c, -s} * map.scale.x, glm::dvec2{s, c} * map.scale.y};
}

glm::dmat3 linear_part(const NodeForm& node) {
  glm::dmat3 linear{1.0};
  for (int column = 0; column < 3; ++column) {
    linear[column] *= node.signs[column];
    for (int row = 0; row < 3; ++row) {
      if (node.axis < 3 && row != node.axis) linear[column][row] *= -1.0;
    }
  }
  return linear;
}

// The shading normal by the words of the specification: u grows along the tangent, v against the bitangent, nodes move
// them as they move the surface, and a back reverses the whole normal.
glm::dvec3 expected_normal(const MapForm& map, const MeshForm& mesh, const NodeForm& node, bool keeps_x_on_backs) {
  const glm::dmat2 per_uv = glm::inverse(uv_transform(map) * uv_slopes(mesh));  // d (x, y) / d uv
  const glm::dmat3 linear = linear_part(node);
  const glm::dvec3 tangent = linear * glm::dvec3{glm::normalize(per_uv[0]), 0.0},
                   bitangent = linear * glm::dvec3{-glm::normalize(per_uv[1]), 0.0};
  const glm::dvec3 up = glm::inverse(glm::transpose(linear)) * glm::dvec3{0.0, 0.0, 1.0};
  const glm::dvec3 n = mapped_normal(map.normal_scale);
  const double side = up.z > 0.0 ? 1.0 : -1.0;  // the camera is above
  return (keeps_x_on_backs ? 1.0 : side) * n.x * tangent + side * n.y * bitangent + side * n.z * up;
}

constexpr std::array<glm::dvec3, 3> to_lights{{{0.6, 0.0, 0.8}, {-0.6, 0.0, 0.8}, {0.0, 0.6, 0.8}}};

// What a white Lambert surface shows under a red, a green and a blue light of pi lux.
glm::dvec3 expected_color(const glm::dvec3& normal) {
  glm::dvec3 color;
  for (int c = 0; c < 3; ++c) color[c] = std::max(0.0, glm::dot(normal, to_lights.at(static_cast<std::size_t>(c))));
  return color;
}

void add_quad(GltfBuilder& file, const MeshForm& form, json& attributes) {
  const std::vector<float> x{-0.5F, 0.5F, 0.5F, -0.5F}, y{0.5F, 0.5F, -0.5F, -0.5F};
  std::vector<float> positions, normals, uvs, tangents;
  for (std::size_t i = 0; i < 4; ++i) {
    positions.insert(positions.end(), {x[i], y[i], 0.0F});
    normals.insert(normals.end(), {0, 0, 1});
    const glm::vec2 uv{uv_slopes(form) * glm::dvec2{x[i], y[i]}};
    uvs.insert(uvs.end(), {uv.x, uv.y});
    const auto signs = glm::vec2{form.signs};
    tangents.insert(tangents.end(), {signs.x, 0, 0, signs.x * signs.y});
  }
  attributes = {{"POSITION", file.add_floats(positions, "VEC3")},
                {"NORMAL", file.add_floats(normals, "VEC3")},
                {"TEXCOORD_0", file.add_floats(uvs, "VEC2")}};
  if (form.has_tangents) attributes["TANGENT"] = file.add_floats(tangents, "VEC4");
}

json gltf_material(const MapForm& form, int texture) {
  return {{"doubleSided", true},
          {"pbrMetallicRoughness", {{"metallicFactor", 0}}},
          {"normalTexture",
           {{"index", texture},
            {"scale", form.normal_scale},
            {"extensions",
             {{"KHR_texture_transform",
               {{"rotation", glm::radians(form.degrees)}, {"scale", {form.scale.x, form.scale.y}}}}}}}}};
}

// A quad for each combination, on a square of cells of 1 m.
class Quilt {
 public:
  Quilt() {
    for (const MapForm& map : map_forms()) {
      for (const MeshForm& mesh : mesh_forms()) {
        for (const NodeForm& node : node_forms()) cells_.push_back({map, mesh, node});
      }
    }
    side_ = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(cells_.size()))));
  }

  struct Cell {
    MapForm map;
    MeshForm mesh;
    NodeForm node;
  };
  [[nodiscard]] const std::vector<Cell>& cells() const { return cells_; }
  [[nodiscard]] glm::ivec2 size() const { return glm::ivec2{3 * side_}; }
  // The pixel in the middle of a cell.
  [[nodiscard]] glm::ivec2 pixel(std::size_t cell) const { return 3 * place(cell) + 1; }

  [[nodiscard]] Scene scene() const {
    Model model = load_gltf(file().write());
    EXPECT_TRUE(model.warnings.empty());
    Scene scene;
    scene.meshes = std::move(model.meshes);
    scene.materials = std::move(model.materials);
    for (Material& material : scene.materials) {
      material.brdf = {NormalDistribution::ggx, GeometryTerm::none, FresnelTerm::none, true};
      material.dielectric_specular = glm::vec3(0.0F);
    }
    for (int c = 0; c < 3; ++c) {
      DirectionalLight light{-glm::vec3{to_lights.at(static_cast<std::size_t>(c))}, glm::vec3{0.0F}};
      light.illuminance[c] = std::numbers::pi_v<float>;
      scene.lights.emplace_back(light);
    }
    scene.horizon = Horizon::open;
    scene.shadows.cast = false;
    const float half = 0.5F * static_cast<float>(side_);
    scene.bounds = {{-half, -half, 0.0F}, {half, half, 0.0F}};
    scene.camera.orthographic = true;
    scene.camera.ymag = half;
    scene.camera.world[3] = {0.0F, 0.0F, 5.0F, 1.0F};
    scene.camera.zfar = 10.0F;
    return scene;
  }

 private:
  [[nodiscard]] glm::ivec2 place(std::size_t cell) const {
    return {static_cast<int>(cell) % side_, static_cast<int>(cell) / side_};
  }

  [[nodiscard]] GltfBuilder file() const {
    GltfBuilder file;
    const int texture = file.add_texture(normal_map());
    const int indices = file.add_indices({0, 3, 2, 0, 2, 1});
    for (const MapForm& map : map_forms()) file.json["materials"].push_back(gltf_material(map, texture));
    std::vector<json> attributes(mesh_forms().size());
    for (std::size_t i = 0; i < attributes.size(); ++i) add_quad(file, mesh_forms()[i], attributes[i]);
    for (std::size_t m = 0; m < map_forms().size(); ++m) {
      for (const json& own : attributes)
        file.json["meshes"].push_back({{"primitives", {{{"attributes", own}, {"indices", indices}, {"material", m}}}}});
    }
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const NodeForm& node = cells_[i].node;
      std::array<double, 4> turn{0, 0, 0, 0};
      turn.at(static_cast<std::size_t>(node.axis)) = 1;  // the fourth is none
      const glm::dvec2 at = glm::dvec2{place(i)} + 0.5 - 0.5 * side_;
      file.json["nodes"].push_back({{"mesh", i / node_forms().size()},
                                    {"translation", {at.x, -at.y, 0}},
                                    {"rotation", turn},
                                    {"scale", {node.signs.x, node.signs.y, node.signs.z}}});
    }
    return file;
  }

  std::vector<Cell> cells_;
  int side_ = 0;
};

std::string words(const Quilt::Cell& cell) {
  return "transform " + std::to_string(cell.map.degrees) + " degrees, " + std::to_string(cell.map.scale.x) + ", " +
         std::to_string(cell.map.scale.y) + "; normal scale " + std::to_string(cell.map.normal_scale) + "; uv " +
         std::to_string(cell.mesh.signs.x) + ", " + std::to_string(cell.mesh.signs.y) +
         (cell.mesh.has_tangents ? ", tangents" : "") + "; node turned about " + std::to_string(cell.node.axis) +
         ", scale " + std::to_string(cell.node.signs.x) + ", " + std::to_string(cell.node.signs.y) + ", " +
         std::to_string(cell.node.signs.z);
}

double largest_difference(const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 off = glm::abs(a - b);
  return std::max({off.x, off.y, off.z});
}

// How many cells of a picture differ from the formula.
int wrong_cells(const Quilt& quilt, const Image& picture, bool keeps_x_on_backs) {
  int wrong = 0;
  for (std::size_t i = 0; i < quilt.cells().size(); ++i) {
    const Quilt::Cell& cell = quilt.cells()[i];
    const auto shown = picture.at(quilt.pixel(i).x, quilt.pixel(i).y);
    const glm::dvec3 expected = expected_color(expected_normal(cell.map, cell.mesh, cell.node, keeps_x_on_backs));
    if (largest_difference({shown[0], shown[1], shown[2]}, expected) < 2e-3) continue;
    if (++wrong == 1 && !keeps_x_on_backs)
      ADD_FAILURE() << words(cell) << ": " << shown[0] << ", " << shown[1] << ", " << shown[2] << " instead of "
                    << expected.x << ", " << expected.y << ", " << expected.z;
  }
  return wrong;
}

TEST(SurfaceFrames, FollowTheFormulaInEveryCombinationOfSigns) {
  const Quilt quilt;
  TestRenderer renderer(quilt.scene(), quilt.size());
  for (const Image& picture : {renderer.frame(base_surface()), renderer.reference(4).mean})
    EXPECT_EQ(wrong_cells(quilt, picture, false), 0) << "of " << quilt.cells().size();
  // Must fail: of backs, a half of all cells, x stays.
  EXPECT_EQ(wrong_cells(quilt, renderer.frame(base_surface()), true), static_cast<int>(quilt.cells().size() / 2));
}

}  // namespace
}  // namespace footprint::testing
