// Reads the attributes, gives vertices their tangents, moves them into the world, and repairs frames.
#include "renderer/scene/gltf/pose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/gtc/type_ptr.hpp>
#include <numeric>

#include "renderer/core/error.hpp"
#include "renderer/scene/geometry.hpp"
#include "renderer/scene/model.hpp"
#include "renderer/scene/tangents.hpp"

namespace footprint {
namespace {

using Json = nlohmann::json;

constexpr int mode_triangles = 4, mode_strip = 5, mode_fan = 6;  // before them points and lines

/// A primitive during conversion; `has_*` are attributes of the file.
struct Builder {
  const GltfDocument& document;
  const Json& primitive;
  std::vector<std::string>& warnings;
  std::string place;  ///< for warnings

  std::vector<Vertex> vertices{};
  std::vector<std::uint32_t> indices{};
  bool has_normals = false, has_tangents = false;

  void warn(std::size_t count, const char* what) const {
    if (count > 0) add_once(warnings, fmt::format("{}: {} {}", place, count, what));
  }
};

/// The values of one of some attributes; none if it is missing. All attributes have as many elements as POSITION.
std::vector<float> read_attribute(const Builder& builder, const Json& attributes, const std::string& name,
                                  int components) {
  if (!attributes.contains(name)) return {};
  auto values = read_floats(builder.document, attributes[name].get<std::size_t>(), components);
  const std::size_t count = values.size() / static_cast<std::size_t>(components);
  if (!builder.vertices.empty() && count != builder.vertices.size()) {
    refuse_gltf(name, fmt::format("has {} elements, POSITION has {}", count, builder.vertices.size()));
  }
  return values;
}

std::vector<float> read_attribute(const Builder& builder, const std::string& name, int components) {
  return read_attribute(builder, builder.primitive["attributes"], name, components);
}

void read_positions(Builder& builder) {
  const auto values = read_attribute(builder, "POSITION", 3);
  builder.vertices.resize(values.size() / 3);
  for (std::size_t i = 0; i < builder.vertices.size(); ++i) {
    const glm::vec3 position = builder.vertices[i].position = glm::make_vec3(&values[3 * i]);
    if (glm::any(glm::isnan(position) || glm::isinf(position)))
      refuse_gltf(fmt::format("vertex {}", i), "the position is not finite");
  }
}

void read_frames(Builder& builder) {
  const auto normals = read_attribute(builder, "NORMAL", 3);
  const auto tangents = read_attribute(builder, "TANGENT", 4);
  builder.has_normals = !normals.empty();
  builder.has_tangents = builder.has_normals && !tangents.empty();  // glTF 2.0: tangents without normals are ignored
  for (std::size_t i = 0; i < builder.vertices.size(); ++i) {
    Vertex& vertex = builder.vertices[i];
    if (builder.has_normals) vertex.normal = glm::make_vec3(&normals[3 * i]);
    if (builder.has_tangents) vertex.tangent = glm::make_vec4(&tangents[4 * i]);
  }
}

/// Reads one set; coordinates that are not finite, or too large for fractions in a float, become 0.
bool read_texture_coordinates(Builder& builder, const std::string& name, glm::vec2 Vertex::*member) {
  constexpr float largest = 1e6F;
  const auto values = read_attribute(builder, name, 2);
  std::size_t replaced = 0;
  for (std::size_t i = 0; i < values.size() / 2; ++i) {
    const glm::vec2 uv{values[2 * i], values[2 * i + 1]};
    const bool usable = std::abs(uv.x) <= largest && std::abs(uv.y) <= largest;  // false for NaN
    replaced += usable ? 0 : 1;
    builder.vertices[i].*member = usable ? uv : glm::vec2{0.0F};
  }
  builder.warn(replaced, "texture coordinates that are not usable were set to 0");
  return !values.empty();
}

/// The components of COLOR_0; glTF 2.0 has RGB and RGBA, floats or normalised integers.
int color_components(const Json& accessor) {
  if (accessor["componentType"] != TINYGLTF_COMPONENT_TYPE_FLOAT && !accessor.value("normalized", false)) {
    refuse_gltf("COLOR_0", "its integers are not normalised, so their meaning is undefined");
  }
  return accessor["type"] == "VEC3" ? 3 : 4;
}

/// Clamps each component to 0 to 1 (glTF 2.0, section 3.7.2.1). A colour that is not finite becomes white.
void read_colors(Builder& builder) {
  const Json& attributes = builder.primitive["attributes"];
  if (!attributes.contains("COLOR_0")) return;
  const int components = color_components(builder.document.json["accessors"][attributes["COLOR_0"].get<std::size_t>()]);
  const auto values = read_attribute(builder, "COLOR_0", components);
  std::size_t replaced = 0;
  for (std::size_t i = 0; i < builder.vertices.size(); ++i) {
    glm::vec4 color(1.0F);
    bool finite = true;
    for (int c = 0; c < components; ++c) {
      color[c] = values[i * static_cast<std::size_t>(components) + static_cast<std::size_t>(c)];
      finite = finite && std::isfinite(color[c]);
    }
    replaced += finite ? 0 : 1;
    builder.vertices[i].color = finite ? glm::clamp(color, 0.0F, 1.0F) : glm::vec4(1.0F);
  }
  builder.warn(replaced, "vertex colours that are not finite were set to white");
}

/// Reads the sets that the maps of a material use as the two of its vertices.
void read_map_coordinates(Builder& builder, const Material& material, const UvSets& sets) {
  const std::array<bool, 2> has{read_texture_coordinates(builder, fmt::format("TEXCOORD_{}", sets[0]), &Vertex::uv0),
                                read_texture_coordinates(builder, fmt::format("TEXCOORD_{}", sets[1]), &Vertex::uv1)};
  for (const TextureMap* map : maps_of(material)) {
    const auto set = static_cast<std::size_t>(map->coordinates.set);
    if (has.at(set)) continue;
    add_once(builder.warnings, fmt::format("{}: no TEXCOORD_{} for the maps of `{}`, its maps show one texel",
                                           builder.place, sets.at(set), material.name));
  }
}

void read_triangles(Builder& builder) {
  std::vector<std::uint32_t> list(builder.vertices.size());
  std::iota(list.begin(), list.end(), 0U);
  if (builder.primitive.contains("indices"))
    list = read_indices(builder.document, builder.primitive["indices"].get<std::size_t>());
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list[i] >= builder.vertices.size())
      refuse_gltf(fmt::format("index {}", i), fmt::format("names vertex {} of {}", list[i], builder.vertices.size()));
  }
  const int mode = builder.primitive.value("mode", mode_triangles);
  const Topology topology = mode == mode_strip ? Topology::strip
                            : mode == mode_fan ? Topology::fan
                                               : Topology::triangles;
  builder.indices = triangle_list(list, topology);
  if (topology == Topology::triangles) builder.warn(list.size() % 3, "indices left over that make no triangle");
}

/// Adds the morph targets (glTF 2.0, section 3.7.2.2).
void morph(Builder& builder, const std::vector<double>& weights) {
  const Json targets = builder.primitive.value("targets", Json::array());
  const std::size_t count = std::min(targets.size(), weights.size());
  for (std::size_t t = 0; t < count; ++t) {
    const auto weight = static_cast<float>(weights[t]);
    if (weight == 0.0F) continue;
    const auto add = [&](const std::string& name, auto to) {
      const std::vector<float> values = read_attribute(builder, targets[t], name, 3);
      for (std::size_t i = 0; i < values.size() / 3; ++i)
        to(builder.vertices[i], weight * glm::make_vec3(&values[3 * i]));
    };
    add("POSITION", [](Vertex& vertex, const glm::vec3& shift) { vertex.position += shift; });
    if (builder.has_normals) add("NORMAL", [](Vertex& vertex, const glm::vec3& shift) { vertex.normal += shift; });
    if (builder.has_tangents)
      add("TANGENT", [](Vertex& vertex, const glm::vec3& shift) { vertex.tangent += glm::vec4{shift, 0.0F}; });
  }
}

/// The transforms of all vertices by the joints of a skin; empty if the primitive does not name joints. Weights that do
/// not sum to 1 are divided by their sum, and without a sum a vertex follows its first joint.
std::vector<glm::dmat4> skinned(Builder& builder, const std::vector<glm::dmat4>& joints) {
  std::vector<glm::dmat4> out(builder.vertices.size(), glm::dmat4{0.0});
  std::vector<double> sums(out.size(), 0.0);
  std::vector<std::size_t> first(out.size(), 0);
  for (int set = 0;; ++set) {
    const auto named = read_attribute(builder, fmt::format("JOINTS_{}", set), 4);
    const auto weights = read_attribute(builder, fmt::format("WEIGHTS_{}", set), 4);
    if (named.empty() || weights.empty()) {
      if (set == 0) return {};
      break;
    }
    for (std::size_t i = 0; i < named.size(); ++i) {
      const auto joint = static_cast<std::size_t>(std::max(named[i], 0.0F));
      if (joint >= joints.size())
        refuse_gltf(fmt::format("vertex {}", i / 4), fmt::format("names joint {} of {}", joint, joints.size()));
      if (set == 0 && i % 4 == 0) first[i / 4] = joint;
      const double weight = std::isfinite(weights[i]) ? std::max(weights[i], 0.0F) : 0.0;
      out[i / 4] += weight * joints[joint];
      sums[i / 4] += weight;
    }
  }
  constexpr double rounding = 0.02;  // of four weights in bytes
  builder.warn(
      static_cast<std::size_t>(std::ranges::count_if(sums, [](double sum) { return std::abs(sum - 1.0) > rounding; })),
      "vertices whose joints' weights do not sum to 1 were weighed by their sum");
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = sums[i] > 0.0 ? out[i] / sums[i] : joints[first[i]];
  return out;
}

/// What moves each vertex of a file into the world.
class Movement {
 public:
  Movement(const MeshPose& pose, std::vector<glm::dmat4> by_joints)
      : world_(pose.world), by_joints_(std::move(by_joints)), mirrored_(mirrors(pose.world)) {}

  /// vertex: of the file.
  [[nodiscard]] const glm::dmat4& matrix(std::uint32_t vertex) const {
    return by_joints_.empty() ? world_ : by_joints_[vertex];
  }
  [[nodiscard]] bool is_mirrored(std::uint32_t vertex) const {
    return by_joints_.empty() ? mirrored_ : mirrors(by_joints_[vertex]);
  }

 private:
  static bool mirrors(const glm::dmat4& matrix) { return glm::determinant(glm::dmat3{matrix}) < 0.0; }

  glm::dmat4 world_;
  std::vector<glm::dmat4> by_joints_;  // replace `world_` (glTF 2.0, section 3.7.3.3)
  bool mirrored_;
};

/// The bounds of the used vertices of a primitive in the world.
WideBounds triangle_bounds(Builder& builder, const MeshPose& pose) {
  constexpr double farthest = 1e15;  // metres: squares of it still fit a float
  WideBounds bounds;
  if (builder.primitive.value("mode", mode_triangles) < mode_triangles) return bounds;
  read_positions(builder);
  if (builder.vertices.empty()) return bounds;
  morph(builder, pose.weights);
  read_triangles(builder);
  const Movement movement(pose, pose.joints.empty() ? std::vector<glm::dmat4>() : skinned(builder, pose.joints));
  std::vector<bool> seen(builder.vertices.size(), false);
  for (const std::uint32_t index : builder.indices) {
    if (seen[index]) continue;
    seen[index] = true;
    const glm::dvec3 at{movement.matrix(index) * glm::dvec4{glm::dvec3{builder.vertices[index].position}, 1.0}};
    for (int axis = 0; axis < 3; ++axis) {
      if (!(std::abs(at[axis]) <= farthest))
        refuse_gltf(fmt::format("vertex {}", index), fmt::format("is beyond {:g} m in the world", farthest));
    }
    bounds.add(at);
  }
  return bounds;
}

/// Into the world. Normals go by the inverse transpose, which is the cofactor matrix over the determinant.
void move(Vertex& vertex, const glm::dmat4& world, bool mirrored) {
  const glm::dmat3 linear{world};
  const glm::dmat3 cofactors{glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                             glm::cross(linear[0], linear[1])};
  const double sign = mirrored ? -1.0 : 1.0;
  vertex.position = glm::vec3{world * glm::dvec4{glm::dvec3{vertex.position}, 1.0}};
  // Through double and scaled to about 1: tiny node scales would underflow in float.
  const glm::dvec3 normal = sign * (cofactors * glm::dvec3{vertex.normal});
  const glm::dvec3 tangent = linear * glm::dvec3{vertex.tangent};
  const double normal_length = glm::length(normal), tangent_length = glm::length(tangent);
  vertex.normal = normal_length > 0.0 ? glm::vec3{normal / normal_length} : glm::vec3{0.0F};
  const glm::vec3 direction = tangent_length > 0.0 ? glm::vec3{tangent / tangent_length} : glm::vec3{0.0F};
  vertex.tangent = {direction, (vertex.tangent.w < 0.0F ? -1.0F : 1.0F) * static_cast<float>(sign)};
}

void move_vertices(Builder& builder, const Movement& movement, const std::vector<std::uint32_t>& file_vertices) {
  std::vector<bool> moved(builder.vertices.size(), false);
  for (std::size_t corner = 0; corner < builder.indices.size(); ++corner) {
    const std::uint32_t index = builder.indices[corner], file_vertex = file_vertices[corner];
    if (moved[index]) continue;
    moved[index] = true;
    move(builder.vertices[index], movement.matrix(file_vertex), movement.is_mirrored(file_vertex));
  }
}

/// A mirroring transform turns the winding round. Of a triangle whose joints differ in that, most corners decide.
void turn_mirrored_triangles(Builder& builder, const Movement& movement,
                             const std::vector<std::uint32_t>& file_vertices) {
  for (std::size_t i = 0; i + 2 < builder.indices.size(); i += 3) {
    int mirrored = 0;
    for (std::size_t corner = i; corner < i + 3; ++corner)
      mirrored += movement.is_mirrored(file_vertices[corner]) ? 1 : 0;
    if (mirrored >= 2) std::swap(builder.indices[i + 1], builder.indices[i + 2]);
  }
}

// The texture coordinates that tangents follow: the normal map's, or the coat's where only the coat has a normal map.
TextureCoordinates tangent_coordinates(const Material& material) {
  if (material.normal_map) return material.normal_map->coordinates;
  return material.coat && material.coat->normal_map ? material.coat->normal_map->coordinates : TextureCoordinates{};
}

/// Gives the vertices tangents in the space of the mesh, before nodes and joints move it (glTF 2.0, section 3.7.2.1).
void add_tangents(Builder& builder, const Material& material) {
  if (!builder.has_normals) make_flat_normals(builder.vertices, builder.indices);
  if (builder.has_tangents) {
    turn_tangents(builder.vertices, builder.indices, tangent_coordinates(material));
  } else {
    compute_tangents(builder.vertices, builder.indices, tangent_coordinates(material));
  }
}

/// Makes the frames orthonormal that were moved into the world.
void complete_frames(Builder& builder) {
  if (builder.has_normals) {
    builder.warn(repair_normals(builder.vertices, builder.indices),
                 "normals without a direction were replaced by the triangles' own");
  } else {
    make_flat_normals(builder.vertices, builder.indices);
  }
  const std::size_t replaced = repair_tangents(builder.vertices);
  if (builder.has_tangents) builder.warn(replaced, "tangents without a direction were replaced");
}

/// Frames and positions in the world.
void place(Builder& builder, const MeshPose& pose, const Material& material) {
  const Movement movement(pose, pose.joints.empty() ? std::vector<glm::dmat4>() : skinned(builder, pose.joints));
  const std::vector<std::uint32_t> file_vertices = builder.indices;  // of each corner
  add_tangents(builder, material);
  move_vertices(builder, movement, file_vertices);
  turn_mirrored_triangles(builder, movement, file_vertices);
  drop_unused_vertices(builder.vertices, builder.indices);
  complete_frames(builder);
}

std::optional<Mesh> convert(Builder& builder, const MeshPose& pose, const Material& material, const UvSets& sets) {
  const int mode = builder.primitive.value("mode", mode_triangles);
  if (mode > mode_fan) refuse_gltf("mode", fmt::format("{} is none of 0 to 6", mode));
  if (mode < mode_triangles) {
    add_once(builder.warnings, "points and lines are left out");
    return std::nullopt;
  }
  read_positions(builder);
  if (builder.vertices.empty()) {
    add_once(builder.warnings, builder.place + " has no POSITION and is left out");
    return std::nullopt;
  }
  read_frames(builder);
  morph(builder, pose.weights);
  read_map_coordinates(builder, material, sets);
  read_colors(builder);
  if (builder.primitive["attributes"].contains("COLOR_1")) {
    add_once(builder.warnings, "vertex colours beyond the first set are left out");
  }
  read_triangles(builder);
  if (builder.indices.empty()) return std::nullopt;
  place(builder, pose, material);
  return Mesh{builder.place, std::move(builder.vertices), std::move(builder.indices), 0};
}

Builder read_primitive(const GltfDocument& document, std::size_t mesh_index, std::size_t primitive_index,
                       std::vector<std::string>& warnings) {
  const Json& mesh = document.json["meshes"][mesh_index];
  return {document, mesh["primitives"][primitive_index], warnings,
          fmt::format("mesh {} `{:.80}`, primitive {}", mesh_index, mesh.value("name", ""), primitive_index)};
}

/// Adds the place of a primitive to the errors of an action on it.
template <class Action>
auto within_place(const Builder& builder, const Action& action) {
  try {
    return action();
  } catch (const Error& error) {
    throw error.within(builder.place);
  }
}

}  // namespace

WideBounds primitive_bounds(const GltfDocument& document, std::size_t mesh_index, std::size_t primitive_index,
                            const MeshPose& pose) {
  std::vector<std::string> told_by_conversion;
  Builder builder = read_primitive(document, mesh_index, primitive_index, told_by_conversion);
  return within_place(builder, [&] { return triangle_bounds(builder, pose); });
}

std::optional<Mesh> convert_primitive(const GltfDocument& document, std::size_t mesh_index, std::size_t primitive_index,
                                      const MeshPose& pose, const Material& material, const UvSets& sets,
                                      std::vector<std::string>& warnings) {
  Builder builder = read_primitive(document, mesh_index, primitive_index, warnings);
  return within_place(builder, [&] { return convert(builder, pose, material, sets); });
}

}  // namespace footprint
