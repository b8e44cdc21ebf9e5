// Walks the node tree with a stack of its own and joins all primitives of a material to one mesh.
#include "renderer/scene/gltf/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <map>

#include "renderer/core/error.hpp"
#include "renderer/core/interrupt.hpp"
#include "renderer/core/memory.hpp"
#include "renderer/scene/gltf/accessor.hpp"
#include "renderer/scene/gltf/check.hpp"
#include "renderer/scene/gltf/document.hpp"
#include "renderer/scene/gltf/lights_cameras.hpp"
#include "renderer/scene/gltf/material.hpp"
#include "renderer/scene/gltf/mesh.hpp"
#include "renderer/scene/gltf/refusal.hpp"
#include "renderer/scene/gltf/selection.hpp"

namespace footprint {
namespace {

constexpr int deepest_node = 1000;

glm::dvec3 vector_or(const std::vector<double>& values, double otherwise) {
  return values.size() == 3 ? glm::dvec3{values[0], values[1], values[2]} : glm::dvec3{otherwise};
}

/// A node's own transform: its matrix, or translation * rotation * scale.
glm::dmat4 local_transform(const tinygltf::Node& node, const std::string& place) {
  glm::dmat4 local{1.0};
  if (node.matrix.size() == 16) {
    for (int i = 0; i < 16; ++i) local[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
    return local;
  }
  if (node.rotation.size() == 4) {
    const auto& q = node.rotation;  // x, y, z, w
    const glm::dquat rotation{q[3], q[0], q[1], q[2]};
    const double length = glm::length(rotation);
    if (!std::isfinite(length) || length < 1e-6) refuse_gltf(place, "the rotation has no length");
    local = glm::mat4_cast(rotation / length);
  }
  const glm::dvec3 scale = vector_or(node.scale, 1.0);
  for (int axis = 0; axis < 3; ++axis) local[axis] *= scale[axis];
  local[3] = glm::dvec4{vector_or(node.translation, 0.0), 1.0};
  return local;
}

std::vector<int> root_nodes(const tinygltf::Model& model, const std::optional<std::size_t>& scene) {
  if (scene) return model.scenes[*scene].nodes;
  std::vector<bool> is_child(model.nodes.size(), false);
  for (const auto& node : model.nodes) {
    for (const int child : node.children) is_child[static_cast<std::size_t>(child)] = true;
  }
  std::vector<int> roots;
  for (std::size_t i = 0; i < is_child.size(); ++i) {
    if (!is_child[i]) roots.push_back(static_cast<int>(i));
  }
  return roots;
}

/// A camera's node, and where it stands.
struct PlacedCamera {
  int camera;
  glm::dmat4 world;
};

/// Walks the hierarchy and gathers what the nodes hold.
class Gatherer {
 public:
  Gatherer(const GltfDocument& document, const std::optional<std::size_t>& variant, Model& result)
      : document_(document), variant_(variant), result_(result), materials_(document, result.warnings) {}

  void gather(const std::vector<int>& roots) {
    std::vector<Pending> stack;
    std::vector<bool> seen(document_.model.nodes.size(), false);
    const auto push = [&](const std::vector<int>& nodes, const glm::dmat4& parent, int depth) {
      std::for_each(nodes.rbegin(), nodes.rend(), [&](int node) { stack.push_back({node, parent, depth}); });
    };
    push(roots, glm::dmat4{1.0}, 1);
    while (!stack.empty()) {
      throw_if_interrupted();
      const auto [index, parent, depth] = stack.back();
      stack.pop_back();
      const std::string place = fmt::format("nodes[{}]", index);
      if (seen[static_cast<std::size_t>(index)]) {
        refuse_gltf(place, "is reached twice: the nodes are a cycle or share a child, glTF wants a tree");
      }
      seen[static_cast<std::size_t>(index)] = true;
      if (depth > deepest_node) refuse_gltf(place, fmt::format("lies more than {} nodes deep", deepest_node));
      const auto& node = document_.model.nodes[static_cast<std::size_t>(index)];
      const glm::dmat4 world = parent * local_transform(node, place);
      gather_node(node, world);
      push(node.children, world, depth + 1);
    }
    result_.materials = materials_.materials();
    for (auto& [material, mesh] : meshes_) result_.meshes.push_back(std::move(mesh));
  }

  /// In the order of the nodes, and what they are called.
  [[nodiscard]] const std::vector<PlacedCamera>& cameras() const { return cameras_; }
  [[nodiscard]] const std::vector<std::string>& camera_names() const { return camera_names_; }

 private:
  struct Pending {
    int node;
    glm::dmat4 parent;
    int depth;
  };

  void gather_node(const tinygltf::Node& node, const glm::dmat4& world) {
    if (node.camera >= 0) {
      const std::string& own = document_.model.cameras[static_cast<std::size_t>(node.camera)].name;
      const std::string numbered = fmt::format("camera {}", cameras_.size());
      camera_names_.push_back(!own.empty() ? own : !node.name.empty() ? node.name : numbered);
      cameras_.push_back({node.camera, world});
    }
    if (const auto light = node.extensions.find("KHR_lights_punctual"); light != node.extensions.end()) {
      result_.lights.push_back(convert_light(document_.model, light->second.Get("light").GetNumberAsInt(), world));
    }
    if (node.skin >= 0) add_once(result_.warnings, "skins are left out: meshes stand in their rest pose");
    if (node.mesh < 0) return;
    const auto& mesh = document_.model.meshes[static_cast<std::size_t>(node.mesh)];
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
      const int material = materials_.use(material_in_variant(mesh.primitives[i], variant_));
      auto part = convert_primitive(document_.model, node.mesh, static_cast<int>(i), world,
                                    materials_.materials()[static_cast<std::size_t>(material)], result_.warnings);
      if (part) merge(std::move(*part), material);
    }
  }

  /// One mesh per material: fewer draw calls.
  void merge(Mesh part, int material) {
    index_count_ += part.indices.size();
    if (index_count_ / 3 > largest_element_count) {
      refuse_gltf({}, fmt::format("more than {} triangles", largest_element_count), "use a smaller model");
    }
    Mesh& whole = meshes_[material];
    whole.name = materials_.materials()[static_cast<std::size_t>(material)].name;
    whole.material = material;
    const auto base = static_cast<std::uint32_t>(whole.vertices.size());
    whole.vertices.insert(whole.vertices.end(), part.vertices.begin(), part.vertices.end());
    for (const std::uint32_t index : part.indices) whole.indices.push_back(base + index);
  }

  const GltfDocument& document_;
  std::optional<std::size_t> variant_;
  Model& result_;
  std::vector<PlacedCamera> cameras_;
  std::vector<std::string> camera_names_;
  GltfMaterials materials_;
  std::map<int, Mesh> meshes_;
  std::uint64_t index_count_ = 0;
};

void warn_left_out(const tinygltf::Model& source, Model& result) {
  for (const std::string& name : source.extensionsUsed) {
    if (!reads_gltf_extension(name)) {
      const std::string_view layer = gltf_layer(name);
      add_once(result.warnings,
               fmt::format("extension {:.80} is left out{}{}", name, layer.empty() ? "" : ": ", layer));
    }
  }
  if (!source.animations.empty()) add_once(result.warnings, "animations are left out");
}

/// Takes the camera that is asked for, else the first.
void take_camera(const tinygltf::Model& source, const Gatherer& gathered, const std::optional<std::string>& wanted,
                 Model& result) {
  const std::vector<PlacedCamera>& cameras = gathered.cameras();
  ModelChoice& choice = result.choices.emplace_back(ModelChoice{"camera", gathered.camera_names(), {}});
  if (wanted) {
    choice.taken = find_choice(choice, *wanted);
  } else if (!cameras.empty()) {
    choice.taken = 0;
    if (cameras.size() > 1) add_once(result.warnings, fmt::format("the first of {} cameras is used", cameras.size()));
  }
  if (choice.taken) {
    const PlacedCamera& taken = cameras[*choice.taken];
    result.camera = convert_camera(source, taken.camera, taken.world);
  }
}

}  // namespace

Model load_gltf(const std::filesystem::path& file, const ModelSelection& selection) {
  const GltfDocument document = read_gltf(file);
  Model result;
  warn_left_out(document.model, result);
  try {
    const ModelChoice& scene = result.choices.emplace_back(scene_choice(document.model, selection.scene));
    const std::vector<int> roots = root_nodes(document.model, scene.taken);
    const ModelChoice variant = variant_choice(document.model, selection.variant);
    require_memory(decoded_map_bytes(document), "decoding the model's maps", "scale its textures down, or free memory");
    Gatherer gathered(document, variant.taken, result);
    gathered.gather(roots);
    take_camera(document.model, gathered, selection.camera, result);
    result.choices.push_back(variant);
    std::erase_if(result.choices, [](const ModelChoice& choice) { return choice.names.empty(); });
  } catch (const Error& error) {
    throw error.within(file.string());
  }
  return result;
}

}  // namespace footprint
