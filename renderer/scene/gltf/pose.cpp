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

namespace footprint {
namespace {

using Json = nlohmann::json;

constexpr std::size_t deepest_joint = 1000;

glm::dvec3 vector_or(const Json& node, const char* member, double otherwise) {
  const auto values = node.value(member, std::vector(3, otherwise));
  return glm::make_vec3(values.data());
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

Keys read_keys(const GltfDocument& document, const Json& sampler, const std::string& path, const std::string& place) {
  Keys keys{.times = read_floats(document, sampler["input"].get<std::size_t>(), 1),
            .values = read_floats(document, sampler["output"].get<std::size_t>(), components_of(path)),
            .width = static_cast<std::size_t>(components_of(path)),
            .spline = sampler.value("interpolation", "") == "CUBICSPLINE"};
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

void apply_channel(const GltfDocument& document, const Json& animation, const Json& channel, double time,
                   const std::string& place, Json& nodes, Motion& motion) {
  const Json& target = channel["target"];
  const auto path = target["path"].get<std::string>();
  if (!target.contains("node")) return;  // as an extension targets it
  if (path != "translation" && path != "rotation" && path != "scale" && path != "weights") return;
  const auto index = channel["sampler"].get<std::size_t>();
  const std::size_t samplers = animation["samplers"].size();
  if (index >= samplers) refuse_gltf(place, fmt::format("sampler {} is none of {}", index, samplers));
  const Json& sampler = animation["samplers"][index];
  const auto moved = target["node"].get<std::size_t>();
  if (path != "weights" && nodes[moved].contains("matrix"))
    refuse_gltf(place, fmt::format("moves nodes[{}], which has a matrix", moved));
  const Keys keys = read_keys(document, sampler, path, place);
  motion.last_key = std::max(motion.last_key, static_cast<double>(keys.times.back()));
  for (const std::vector<float>& numbers : {keys.times, keys.values})
    motion.content = fnv1a(std::as_bytes(std::span(numbers)), motion.content);
  nodes[moved][path] = value_at(keys, time, sampler.value("interpolation", ""), path == "rotation", place);
}

glm::dmat4 world_of(const Pose& pose, std::size_t node) {
  glm::dmat4 world{1.0};
  std::size_t depth = 0;
  for (int i = static_cast<int>(node); i >= 0; i = pose.parents[static_cast<std::size_t>(i)]) {
    const std::string place = fmt::format("nodes[{}]", i);
    if (++depth > deepest_joint) refuse_gltf(place, "a joint is in a cycle, or too deep: glTF wants a tree");
    world = local_transform(pose.nodes[static_cast<std::size_t>(i)], place) * world;
  }
  return world;
}

}  // namespace

glm::dmat4 local_transform(const Json& node, const std::string& place) {
  glm::dmat4 local{1.0};
  if (node.contains("matrix")) return glm::make_mat4(node["matrix"].get<std::vector<double>>().data());
  if (node.contains("rotation")) local = glm::mat4_cast(unit(node["rotation"].get<std::vector<double>>(), place));
  const glm::dvec3 scale = vector_or(node, "scale", 1.0);
  for (int axis = 0; axis < 3; ++axis) local[axis] *= scale[axis];
  local[3] = glm::dvec4{vector_or(node, "translation", 0.0), 1.0};
  return local;
}

Pose pose_at(const GltfDocument& document, const std::optional<std::size_t>& animation, double time) {
  Pose pose{document.json.value("nodes", Json::array()), {}};
  pose.parents.assign(pose.nodes.size(), -1);
  for (std::size_t i = 0; i < pose.nodes.size(); ++i) {
    for (const auto child : pose.nodes[i].value("children", std::vector<std::size_t>()))
      pose.parents[child] = static_cast<int>(i);
  }
  if (!animation) return pose;
  const Json& source = document.json["animations"][*animation];
  pose.motion.emplace();
  for (std::size_t i = 0; i < source["channels"].size(); ++i)
    apply_channel(document, source, source["channels"][i], time,
                  fmt::format("animations[{}].channels[{}]", *animation, i), pose.nodes, *pose.motion);
  return pose;
}

MeshPose seen_from(const glm::dvec3& origin, MeshPose pose) {
  const auto shift = [&](glm::dmat4& matrix) { matrix[3] -= matrix[3].w * glm::dvec4{origin, 0.0}; };
  shift(pose.world);
  std::ranges::for_each(pose.joints, shift);
  return pose;
}

MeshPose mesh_pose(const GltfDocument& document, const Pose& pose, const Json& node, const glm::dmat4& world) {
  MeshPose out{.world = world, .joints = {}, .weights = node.value("weights", std::vector<double>())};
  const Json& mesh = document.json["meshes"][node["mesh"].get<std::size_t>()];
  if (out.weights.empty()) out.weights = mesh.value("weights", std::vector<double>());
  if (!node.contains("skin")) return out;
  const auto index = node["skin"].get<std::size_t>();
  const Json& skin = document.json["skins"][index];
  const auto joints = skin["joints"].get<std::vector<std::size_t>>();
  std::vector<float> inverse;  // column by column
  if (skin.contains("inverseBindMatrices"))
    inverse = read_floats(document, skin["inverseBindMatrices"].get<std::size_t>(), 16);
  if (!inverse.empty() && inverse.size() < 16 * joints.size())
    refuse_gltf(fmt::format("skins[{}]", index), "has fewer inverse bind matrices than joints");
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const glm::mat4 to_joint = inverse.empty() ? glm::mat4{1.0F} : glm::make_mat4(&inverse[16 * j]);
    out.joints.push_back(world_of(pose, joints[j]) * glm::dmat4{to_joint});
  }
  return out;
}

}  // namespace footprint
