// Walks the node tree with an explicit stack, joins all primitives of a material, and converts lights and cameras.
#include "renderer/scene/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "renderer/core/error.hpp"
#include "renderer/core/memory.hpp"
#include "renderer/core/process.hpp"
#include "renderer/scene/geometry.hpp"
#include "renderer/scene/gltf/document.hpp"
#include "renderer/scene/gltf/material.hpp"
#include "renderer/scene/gltf/model_file.hpp"
#include "renderer/scene/gltf/pose.hpp"

namespace footprint {
namespace {

using Json = nlohmann::json;

constexpr double largest = 1e15;
constexpr double smallest_znear = 1e-18;  // over `largest` it still is a 32-bit float's normal number

void require(bool condition, const std::string& place, const std::string& message) {
  if (!condition) refuse_gltf(place, message);
}

/// The direction in which a light or camera looks: its own -z.
glm::dvec3 view_direction(const glm::dmat4& world, const std::string& place) {
  const glm::dvec3 axis{world[2]};
  const double length = glm::length(axis);
  require(std::isfinite(length) && length > 0.0, place, "its node's transform leaves it no direction");
  return -axis / length;
}

/// Where a light or a camera is.
struct Placing {
  std::string place;         ///< in the file, for messages
  const glm::dmat4& world;   ///< of its node
  const glm::dvec3& origin;  ///< of the model
};

glm::vec3 position_of(const Placing& placing) {
  const glm::dvec3 position{placing.world[3]};
  require(glm::length(position) <= largest, placing.place, fmt::format("is beyond {:g} m in the world", largest));
  return glm::vec3{position - placing.origin};
}

/// The rigid part of a transform, right-handed. It preserves the -z axis, and the y axis as far as possible.
glm::mat4 rigid_part(const Placing& placing) {
  const glm::dvec3 back = -view_direction(placing.world, placing.place);
  const glm::dvec3 right = glm::cross(glm::dvec3{placing.world[1]}, back);
  const double length = glm::length(right);
  require(std::isfinite(length) && length > 0.0, placing.place, "its node's transform leaves it no upright");
  const glm::dvec3 x = right / length;
  return glm::mat4{glm::dmat4{glm::dvec4{x, 0.0}, glm::dvec4{glm::cross(back, x), 0.0}, glm::dvec4{back, 0.0},
                              glm::dvec4{glm::dvec3{position_of(placing)}, 1.0}}};
}

Camera convert_perspective(const Json& source, const std::string& place) {
  const double yfov = source.value("yfov", 0.0), znear = source.value("znear", 0.0), zfar = source.value("zfar", 0.0),
               aspect = source.value("aspectRatio", 0.0);  // 0: not given
  require(yfov > 0.0 && yfov < std::numbers::pi, place, "yfov must lie between 0 and pi");
  require(znear >= smallest_znear && znear < largest, place,
          fmt::format("znear must be at least {:g} m", smallest_znear));
  require(zfar == 0.0 || (zfar > znear && zfar < largest), place, "zfar must be beyond znear");
  require(aspect == 0.0 || (aspect > 1e-4 && aspect < 1e4), place, "aspectRatio must be within 1e-4 to 1e4");
  Camera camera;
  camera.yfov = static_cast<float>(yfov);
  camera.znear = static_cast<float>(znear);
  if (zfar != 0.0) camera.zfar = static_cast<float>(zfar);
  if (aspect != 0.0) camera.aspect = static_cast<float>(aspect);
  return camera;
}

Camera convert_orthographic(const Json& source, const std::string& place) {
  const double xmag = std::abs(source.value("xmag", 0.0)), ymag = std::abs(source.value("ymag", 0.0)),
               znear = source.value("znear", 0.0), zfar = source.value("zfar", 0.0);
  require(xmag > 0.0 && xmag < largest && ymag > 0.0 && ymag < largest, place, "xmag and ymag must not be 0");
  require(znear >= 0.0 && zfar > znear && zfar < largest, place, "zfar must be beyond znear");
  Camera camera;
  camera.orthographic = true;
  camera.ymag = static_cast<float>(ymag);
  camera.znear = static_cast<float>(znear);
  camera.zfar = static_cast<float>(zfar);
  camera.aspect = static_cast<float>(xmag / ymag);
  return camera;
}

Camera convert_camera(const Json& source, const Placing& placing) {
  const std::string& place = placing.place;
  const std::string type = source["type"];
  require(type == "perspective" || type == "orthographic", place,
          fmt::format("`{:.40}` is none of perspective, orthographic", type));
  const Json projection = source.value(type, Json::object());
  Camera camera =
      type == "perspective" ? convert_perspective(projection, place) : convert_orthographic(projection, place);
  camera.world = rigid_part(placing);
  return camera;
}

PointLight convert_point(const Json& source, const Placing& placing, std::vector<std::string>& warnings) {
  const double intensity = source.value("intensity", 1.0), range = source.value("range", 0.0);
  require(range >= 0.0 && range < largest, placing.place, "range must not be negative");
  if (source.contains("range") && range == 0.0)
    add_once(warnings, placing.place + ": its range of 0 counts as none, because a range is above 0");
  const auto color = source.value("color", std::vector(3, 1.0));
  PointLight point{position_of(placing), glm::vec3{glm::dvec3(glm::make_vec3(color.data())) * intensity}, std::nullopt};
  if (range > 0.0) point.range = static_cast<float>(range);
  return point;
}

SpotLight convert_spot(const Json& source, const Placing& placing, std::vector<std::string>& warnings) {
  constexpr double rounding = 1e-6;
  const Json spot = source.value("spot", Json::object());
  if (!source.contains("spot"))
    add_once(warnings, placing.place + ": it has no `spot`, so its cone is the default, from 0 to 45 degrees");
  const double inner = spot.value("innerConeAngle", 0.0), outer = spot.value("outerConeAngle", std::numbers::pi / 4.0);
  require(inner >= 0.0 && inner <= outer + rounding && outer > 0.0 && outer <= std::numbers::pi / 2 + rounding,
          placing.place, "needs 0 <= innerConeAngle < outerConeAngle <= pi / 2");
  SpotLight light{convert_point(source, placing, warnings), glm::vec3{view_direction(placing.world, placing.place)}};
  light.outer_cone_angle = static_cast<float>(outer);
  light.inner_cone_angle = std::min(static_cast<float>(inner), light.outer_cone_angle);
  if (light.inner_cone_angle == light.outer_cone_angle)
    add_once(warnings, placing.place + ": its cone has a hard edge, because both of its angles are equal");
  return light;
}

/// None, with a warning, if a node scales the light to nothing (glTF 2.0, section 3.7.3.1: so scenes hide content).
std::optional<Light> convert_light(const Json& source, const Placing& placing, std::vector<std::string>& warnings) {
  const std::string type = source["type"];
  require(type == "point" || type == "spot" || type == "directional", placing.place,
          "is none of point, spot, directional");
  const double intensity = source.value("intensity", 1.0);
  require(intensity >= 0.0 && intensity < largest, placing.place, "intensity must not be negative");
  for (const double value : source.value("color", std::vector(3, 1.0)))
    require(value >= 0.0 && value < 1e6, placing.place, "color must not be negative");
  const glm::dmat3 axes{placing.world};
  if (axes == glm::dmat3{0.0} || (type != "point" && axes[2] == glm::dvec3{0.0})) {
    add_once(warnings, placing.place + " is left out, because its node or one above scales it to nothing");
    return std::nullopt;
  }
  if (type == "spot") return convert_spot(source, placing, warnings);
  const PointLight point = convert_point(source, placing, warnings);
  if (type == "point") return point;
  return DirectionalLight{glm::vec3{view_direction(placing.world, placing.place)}, point.intensity};
}

using Pointer = Json::json_pointer;

const Pointer lights("/extensions/KHR_lights_punctual/lights"), node_light("/extensions/KHR_lights_punctual/light"),
    node_visible("/extensions/KHR_node_visibility/visible");

/// The entries of one kind, with the index of the `wanted` one; else `otherwise`, if there are any.
ModelChoice choose(const Json& document, const char* kind, const Pointer& entries,
                   const std::optional<std::string>& wanted, std::optional<std::size_t> otherwise = {}) {
  ModelChoice choice{kind, {}, {}};
  if (document.contains(entries)) {
    for (const Json& entry : document[entries]) {
      const std::string name = entry.value("name", "");
      choice.names.push_back(name.empty() ? fmt::format("{} {}", kind, choice.names.size()) : name);
    }
  }
  choice.taken = wanted ? find_choice(choice, *wanted) : choice.names.empty() ? std::nullopt : otherwise;
  return choice;
}

int material_in_variant(const Json& primitive, const std::optional<std::size_t>& variant) {
  const Pointer mappings("/extensions/KHR_materials_variants/mappings");
  if (variant && primitive.contains(mappings)) {
    for (const Json& mapping : primitive[mappings]) {
      if (std::ranges::find(mapping["variants"], Json(*variant)) != mapping["variants"].end())
        return mapping["material"].get<int>();
    }
  }
  return primitive.value("material", -1);
}

constexpr int deepest_node = 1000;

using Nodes = std::vector<std::size_t>;

Nodes children_of(const Json& node, const char* member) { return node.value(member, Nodes()); }

Nodes root_nodes(const Json& document, const std::optional<std::size_t>& scene) {
  if (scene) return children_of(document["scenes"][*scene], "nodes");
  const Json nodes = document.value("nodes", Json::array());
  std::vector<bool> is_child(nodes.size(), false);
  for (const Json& node : nodes) {
    for (const std::size_t child : children_of(node, "children")) is_child[child] = true;
  }
  Nodes roots;
  for (std::size_t i = 0; i < is_child.size(); ++i) {
    if (!is_child[i]) roots.push_back(i);
  }
  return roots;
}

/// A camera with its node's transform.
struct NodeCamera {
  std::string name;
  std::size_t camera;
  glm::dmat4 world;
};

/// Calls `visit` with each node of a scene, parents first, its transform, and whether it is visible.
template <class Visit>
void walk(const Pose& pose, const Nodes& roots, const Visit& visit) {
  struct Pending {
    std::size_t node;
    glm::dmat4 parent;
    bool visible;
    int depth;
  };
  std::vector<Pending> stack;
  std::vector<bool> seen(pose.nodes.size(), false);
  const auto push = [&](const Nodes& nodes, const glm::dmat4& parent, bool visible, int depth) {
    std::for_each(nodes.rbegin(), nodes.rend(), [&](std::size_t node) {
      stack.push_back({node, parent, visible, depth});
    });
  };
  push(roots, glm::dmat4{1.0}, true, 1);
  while (!stack.empty()) {
    throw_if_interrupted();
    const auto [index, parent, above, depth] = stack.back();
    stack.pop_back();
    const std::string place = fmt::format("nodes[{}]", index);
    if (seen[index]) refuse_gltf(place, "is reached twice: the nodes are a cycle or share a child, glTF wants a tree");
    seen[index] = true;
    if (depth > deepest_node) refuse_gltf(place, fmt::format("is more than {} nodes deep", deepest_node));
    const Json& node = pose.nodes[index];
    const glm::dmat4 world = parent * local_transform(node, place);
    const bool visible = above && node.value(node_visible, true);
    visit(node, world, visible);
    push(children_of(node, "children"), world, visible, depth + 1);
  }
}

/// The bounds of all visible triangles in the world.
WideBounds bounds_of_scene(const GltfDocument& document, const Pose& pose, const Nodes& roots) {
  WideBounds bounds;
  walk(pose, roots, [&](const Json& node, const glm::dmat4& world, bool visible) {
    if (!visible || !node.contains("mesh")) return;
    const auto mesh = node["mesh"].get<std::size_t>();
    const MeshPose posed = mesh_pose(document, pose, node, world);
    for (std::size_t i = 0; i < document.json["meshes"][mesh]["primitives"].size(); ++i)
      bounds.add(primitive_bounds(document, mesh, i, posed));
  });
  return bounds;
}

/// Collects the content of nodes.
class Gatherer {
 public:
  Gatherer(GltfModelFile& file, const Pose& pose, const std::optional<std::size_t>& variant, Model& result)
      : document_(file.document),
        pose_(pose),
        variant_(variant),
        result_(result),
        materials_(file.document, file.maps, result.warnings) {}

  void gather(const Nodes& roots) {
    walk(pose_, roots, [&](const Json& node, const glm::dmat4& world, bool visible) {
      add_camera(node, world);
      if (!visible) {
        hides_mesh_ = hides_mesh_ || node.contains("mesh");
        return;
      }
      add_light(node, world);
      add_mesh(node, world);
    });
    result_.materials = materials_.materials();
    for (auto& [material, mesh] : meshes_) result_.meshes.push_back(std::move(mesh));
    if (hides_mesh_ && result_.meshes.empty())
      add_once(result_.warnings, "no mesh is left: nodes with meshes are hidden by KHR_node_visibility");
  }

  /// In the order of the nodes.
  [[nodiscard]] const std::vector<NodeCamera>& cameras() const { return cameras_; }

 private:
  void add_camera(const Json& node, const glm::dmat4& world) {
    if (!node.contains("camera")) return;
    const auto camera = node["camera"].get<std::size_t>();
    const std::string own = document_.json["cameras"][camera].value("name", ""), name = node.value("name", ""),
                      numbered = fmt::format("camera {}", cameras_.size());
    cameras_.push_back({!own.empty() ? own : !name.empty() ? name : numbered, camera, world});
  }

  void add_light(const Json& node, const glm::dmat4& world) {
    if (!node.contains(node_light)) return;
    const auto index = node[node_light].get<std::size_t>();
    const Placing placing{fmt::format("KHR_lights_punctual.lights[{}]", index), world, result_.origin};
    if (const auto light = convert_light(document_.json[lights][index], placing, result_.warnings))
      result_.lights.push_back(*light);
  }

  void add_mesh(const Json& node, const glm::dmat4& world) {
    if (!node.contains("mesh")) return;
    const auto mesh = node["mesh"].get<std::size_t>();
    const MeshPose pose = seen_from(result_.origin, mesh_pose(document_, pose_, node, world));
    const Json& primitives = document_.json["meshes"][mesh]["primitives"];
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      const int material = materials_.use(material_in_variant(primitives[i], variant_));
      auto part =
          convert_primitive(document_, mesh, i, pose, materials_.materials()[static_cast<std::size_t>(material)],
                            materials_.sets(material), result_.warnings);
      if (part) merge(*part, material);
    }
  }

  /// One mesh per material: fewer draw calls.
  void merge(const Mesh& part, int material) {
    index_count_ += part.indices.size();
    if (index_count_ / 3 > largest_element_count) {
      refuse_gltf({}, fmt::format("more than {} triangles", largest_element_count), "use a smaller model");
    }
    Mesh& whole = meshes_[material];
    whole.name = materials_.materials()[static_cast<std::size_t>(material)].name;
    whole.material = material;
    append(whole, part);
  }

  const GltfDocument& document_;
  const Pose& pose_;
  std::optional<std::size_t> variant_;
  Model& result_;
  std::vector<NodeCamera> cameras_;
  GltfMaterials materials_;
  std::map<int, Mesh> meshes_;
  std::uint64_t index_count_ = 0;
  bool hides_mesh_ = false;
};

void warn_left_out(const Json& document, Model& result) {
  for (const std::string name : document.value("extensionsUsed", Json::array())) {
    if (!reads_gltf_extension(name)) {
      const std::string_view layer = gltf_layer(name);
      add_once(result.warnings,
               fmt::format("extension {:.80} is left out{}{}", name, layer.empty() ? "" : ": ", layer));
    }
  }
}

/// Selects the requested camera, else the first.
void take_camera(const Json& document, const std::vector<NodeCamera>& cameras, const std::optional<std::string>& wanted,
                 Model& result) {
  ModelChoice& choice = result.choices.emplace_back(ModelChoice{"camera", {}, {}});
  for (const NodeCamera& camera : cameras) choice.names.push_back(camera.name);
  if (wanted) {
    choice.taken = find_choice(choice, *wanted);
  } else if (!cameras.empty()) {
    choice.taken = 0;
    if (cameras.size() > 1) add_once(result.warnings, fmt::format("the first of {} cameras is used", cameras.size()));
  }
  if (choice.taken) {
    const NodeCamera& taken = cameras[*choice.taken];
    result.camera = convert_camera(document["cameras"][taken.camera],
                                   {fmt::format("cameras[{}]", taken.camera), taken.world, result.origin});
  }
}

}  // namespace

Model load_gltf(GltfModelFile& file, const ModelSelection& selection) {
  const GltfDocument& document = file.document;
  const Json& json = document.json;
  Model result;
  warn_left_out(json, result);
  try {
    const ModelChoice scene =
        choose(json, "scene", Pointer("/scenes"), selection.scene, json.value("scene", std::size_t{0}));
    const ModelChoice variant =
        choose(json, "variant", Pointer("/extensions/KHR_materials_variants/variants"), selection.variant);
    require_memory(decoded_map_bytes(document), "decoding the model's maps", "scale its textures down, or free memory");
    const bool first_animation = selection.time && !selection.animation;
    const ModelChoice animation = choose(json, "animation", Pointer("/animations"),
                                         first_animation ? std::optional<std::string>("0") : selection.animation);
    const Pose pose = pose_at(document, animation.taken, selection.time.value_or(0.0));
    result.motion = pose.motion;
    const Nodes roots = root_nodes(json, scene.taken);
    result.origin = origin_for(bounds_of_scene(document, pose, roots));
    Gatherer gathered(file, pose, variant.taken, result);
    gathered.gather(roots);
    result.choices.push_back(scene);
    take_camera(json, gathered.cameras(), selection.camera, result);
    result.choices.push_back(variant);
    result.choices.push_back(animation);
    std::erase_if(result.choices, [](const ModelChoice& choice) { return choice.names.empty(); });
  } catch (const Error& error) {
    throw error.within(document.file.string());
  }
  for (const std::string& warning : file.warnings) add_once(result.warnings, warning);
  file.warnings = result.warnings;
  return result;
}

Model load_gltf(const std::filesystem::path& file, const ModelSelection& selection) {
  GltfModelFile read{.document = read_gltf(file)};
  return load_gltf(read, selection);
}

}  // namespace footprint
