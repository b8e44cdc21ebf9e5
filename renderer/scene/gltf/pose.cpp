// Evaluates the channels of an animation, writes their values into copies of the nodes, and follows joints to their
// roots.
#include "renderer/scene/gltf/pose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <span>

#include "renderer/core/error.hpp"
#include "renderer/scene/gltf/check.hpp"
#include "renderer/scene/gltf/document.hpp"

namespace footprint {
namespace {

constexpr std::size_t deepest_joint = 1000;

glm::dvec3 vector_or(const std::vector<double>& values, double otherwise) {
  return values.size() == 3 ? glm::make_vec3(values.data()) : glm::dvec3{otherwise};
}

glm::dquat unit(const std::vector<double>& q, const std::string& place) {  // x, y, z, w
  const glm::dquat rotation{q[3], q[0], q[1], q[2]};
  const double length = glm::length(rotation);
  if (!std::isfinite(length) || length < 1e-6) refuse_gltf(place, "the rotation has no length");
  return rotation / length;
}

// The keys of a sampler. A cubic spline has three elements per key: the tangent before it, its value, the tangent
// after.
struct Keys {
  std::vector<float> times, values;
  std::size_t width;  // numbers per element
  bool spline;

  [[nodiscard]] std::span<const float> element(std::size_t key, std::size_t which) const {
    return std::span(values).subspan((spline ? 3 * key + which : key) * width, width);
  }
  [[nodiscard]] std::vector<double> value(std::size_t key) const {
    const std::span<const float> own = element(key, 1);
    return {own.begin(), own.end()};
  }
};

// The number of components of a channel's values; 1 for weights.
int components_of(const std::string& path) { return path == "rotation" ? 4 : path == "weights" ? 1 : 3; }

Keys read_keys(const tinygltf::Model& model, const tinygltf::AnimationSampler& sampler, const std::string& path,
               const std::string& place) {
  Keys keys{.times = read_floats(model, sampler.input, 1),
            .values = read_floats(model, sampler.output, components_of(path)),
            .width = static_cast<std::size_t>(components_of(path)),
            .spline = sampler.interpolation == "CUBICSPLINE"};
  for (std::size_t i = 0; i < keys.times.size(); ++i) {
    if (!std::isfinite(keys.times[i]) || (i > 0 && keys.times[i] <= keys.times[i - 1]))
      refuse_gltf(place, fmt::format("key {} is not later than the one before", i));
  }
  const std::size_t elements = keys.times.size() * (keys.spline ? 3 : 1);
  if (path == "weights") keys.width = keys.values.size() / elements;
  if (keys.width == 0 || keys.values.size() != elements * keys.width)
    refuse_gltf(place, fmt::format("has {} numbers for {} keys", keys.values.size(), keys.times.size()));
  if (!std::ranges::all_of(keys.values, [](float value) { return std::isfinite(value); }))
    refuse_gltf(place, "has a value that is not finite");
  return keys;
}

// Along the shorter arc (glTF 2.0, appendix C.4).
std::vector<double> slerp(const Keys& keys, std::size_t key, double part, const std::string& place) {
  const glm::dquat q = glm::slerp(unit(keys.value(key), place), unit(keys.value(key + 1), place), part);
  return {q.x, q.y, q.z, q.w};
}

// The cubic Hermite spline of glTF 2.0, appendix C.5.
std::vector<double> spline(const Keys& keys, std::size_t key, double part) {
  const double length = static_cast<double>(keys.times[key + 1]) - keys.times[key];
  const double square = part * part, cube = square * part;
  const auto from = keys.element(key, 1), leave = keys.element(key, 2), arrive = keys.element(key + 1, 0),
             to = keys.element(key + 1, 1);
  std::vector<double> out(keys.width);
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = (2.0 * cube - 3.0 * square + 1.0) * from[i] + length * (cube - 2.0 * square + part) * leave[i] +
             (3.0 * square - 2.0 * cube) * to[i] + length * (cube - square) * arrive[i];
  }
  return out;
}

std::vector<double> value_at(const Keys& keys, double time, const std::string& interpolation, bool rotates,
                             const std::string& place) {
  if (time <= keys.times.front()) return keys.value(0);
  if (time >= keys.times.back()) return keys.value(keys.times.size() - 1);
  const auto next = std::ranges::upper_bound(keys.times, time);
  const auto key = static_cast<std::size_t>(next - keys.times.begin()) - 1;
  if (interpolation == "STEP") return keys.value(key);
  const double part = (time - keys.times[key]) / (static_cast<double>(keys.times[key + 1]) - keys.times[key]);
  if (keys.spline) return spline(keys, key, part);
  if (rotates) return slerp(keys, key, part, place);
  std::vector<double> out = keys.value(key);
  const std::vector<double> to = keys.value(key + 1);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = std::lerp(out[i], to[i], part);
  return out;
}

void apply_channel(const tinygltf::Model& model, const tinygltf::Animation& animation,
                   const tinygltf::AnimationChannel& channel, double time, const std::string& place,
                   std::vector<tinygltf::Node>& nodes, Motion& motion) {
  const std::string& path = channel.target_path;
  if (channel.target_node < 0) return;  // as an extension targets it
  if (path != "translation" && path != "rotation" && path != "scale" && path != "weights") return;
  if (channel.sampler < 0 || channel.sampler >= static_cast<int>(animation.samplers.size()))
    refuse_gltf(place, fmt::format("sampler {} is none of {}", channel.sampler, animation.samplers.size()));
  const tinygltf::AnimationSampler& sampler = animation.samplers[static_cast<std::size_t>(channel.sampler)];
  tinygltf::Node& node = nodes[static_cast<std::size_t>(channel.target_node)];
  if (path != "weights" && !node.matrix.empty())
    refuse_gltf(place, fmt::format("moves nodes[{}], which has a matrix", channel.target_node));
  const Keys keys = read_keys(model, sampler, path, place);
  motion.last_key = std::max(motion.last_key, static_cast<double>(keys.times.back()));
  for (const std::vector<float>& numbers : {keys.times, keys.values})
    motion.content = fnv1a(std::as_bytes(std::span(numbers)), motion.content);
  std::vector<double> value = value_at(keys, time, sampler.interpolation, path == "rotation", place);
  (path == "translation" ? node.translation
   : path == "rotation"  ? node.rotation
   : path == "scale"     ? node.scale
                         : node.weights) = std::move(value);
}

}  // namespace

glm::dmat4 local_transform(const tinygltf::Node& node, const std::string& place) {
  glm::dmat4 local{1.0};
  if (node.matrix.size() == 16) return glm::make_mat4(node.matrix.data());
  if (node.rotation.size() == 4) local = glm::mat4_cast(unit(node.rotation, place));
  const glm::dvec3 scale = vector_or(node.scale, 1.0);
  for (int axis = 0; axis < 3; ++axis) local[axis] *= scale[axis];
  local[3] = glm::dvec4{vector_or(node.translation, 0.0), 1.0};
  return local;
}

Pose::Pose(const tinygltf::Model& model, const std::optional<std::size_t>& animation, double time)
    : model_(model), nodes_(model.nodes), parents_(model.nodes.size(), -1) {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    for (const int child : nodes_[i].children) parents_[static_cast<std::size_t>(child)] = static_cast<int>(i);
  }
  if (!animation) return;
  const tinygltf::Animation& source = model.animations[*animation];
  motion_.emplace();
  for (std::size_t i = 0; i < source.channels.size(); ++i)
    apply_channel(model, source, source.channels[i], time, fmt::format("animations[{}].channels[{}]", *animation, i),
                  nodes_, *motion_);
}

glm::dmat4 Pose::world_of(int node) const {
  glm::dmat4 world{1.0};
  std::size_t depth = 0;
  for (int i = node; i >= 0; i = parents_[static_cast<std::size_t>(i)]) {
    const std::string place = fmt::format("nodes[{}]", i);
    if (++depth > deepest_joint) refuse_gltf(place, "a joint is in a cycle, or too deep: glTF wants a tree");
    world = local_transform(nodes_[static_cast<std::size_t>(i)], place) * world;
  }
  return world;
}

MeshPose Pose::of_mesh(const tinygltf::Node& node, const glm::dmat4& world) const {
  MeshPose pose{.world = world, .joints = {}, .weights = node.weights};
  if (pose.weights.empty()) pose.weights = model_.meshes[static_cast<std::size_t>(node.mesh)].weights;
  if (node.skin < 0) return pose;
  const tinygltf::Skin& skin = model_.skins[static_cast<std::size_t>(node.skin)];
  std::vector<float> inverse;  // column by column
  if (skin.inverseBindMatrices >= 0) inverse = read_floats(model_, skin.inverseBindMatrices, 16);
  if (!inverse.empty() && inverse.size() < 16 * skin.joints.size())
    refuse_gltf(fmt::format("skins[{}]", node.skin), "has fewer inverse bind matrices than joints");
  for (std::size_t j = 0; j < skin.joints.size(); ++j) {
    const glm::mat4 to_joint = inverse.empty() ? glm::mat4{1.0F} : glm::make_mat4(&inverse[16 * j]);
    pose.joints.push_back(world_of(skin.joints[j]) * glm::dmat4{to_joint});
  }
  return pose;
}

}  // namespace footprint
