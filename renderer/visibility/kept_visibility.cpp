// A file of the cache: layers, a block of values for each mesh, the error.
#include "renderer/visibility/kept_visibility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "renderer/core/hash.hpp"
#include "renderer/core/sealed_bytes.hpp"
#include "renderer/scene/material_content.hpp"

namespace footprint {
namespace {

constexpr std::string_view form = "footprint visibility 2";  // another layout below: another number here

template <class Value>
void add_values(ContentHash& hash, const std::vector<Value>& values) {
  hash.add(std::as_bytes(std::span(values)));
}

void add_mesh(ContentHash& hash, const Mesh& mesh, const Material& material, bool both_sides) {
  std::vector<glm::vec3> points, normals;
  for (const Vertex& vertex : mesh.vertices) {
    points.push_back(vertex.position);
    normals.push_back(vertex.normal);
  }
  add_values(hash, points);
  add_values(hash, normals);
  add_values(hash, mesh.indices);
  hash.add(material.double_sided || both_sides ? "both sides" : "front");
  hash.add(material.alpha_cutoff ? "cut out" : "whole");
  if (!material.alpha_cutoff) return;
  std::vector<glm::vec2> coordinates;
  std::vector<float> alphas;
  for (const Vertex& vertex : mesh.vertices) {
    coordinates.insert(coordinates.end(), {vertex.uv0, vertex.uv1});
    alphas.push_back(vertex.color.a);
  }
  add_values(hash, coordinates);
  add_values(hash, alphas);
  add_content(hash, material);
}

// Whether a field has layers of one size and a value for each vertex.
bool fits(const VisibilityField& field, const Scene& scene) {
  const Image& first = field.layers.front();
  const auto like_first = [&](const Image& layer) {
    return layer.width == first.width && layer.height == first.height && layer.channels == first.channels &&
           layer.texels.size() == layer.texel_count() * static_cast<std::size_t>(layer.channels);
  };
  const auto vertices = [](const Mesh& mesh) { return mesh.vertices.size(); };
  return first.width > 0 && first.height > 0 && first.channels > 0 && std::ranges::all_of(field.layers, like_first) &&
         std::ranges::equal(field.meshes, scene.meshes, std::ranges::equal_to(), &std::vector<VertexVisibility>::size,
                            vertices);
}

}  // namespace

std::string visibility_key(const Scene& scene, const Environment& environment) {
  ContentHash hash;
  add_program(hash);
  hash.add(std::as_bytes(std::span(&scene.bounds, 1)));  // rays start off the surface by a share of it
  for (const Mesh& mesh : scene.meshes) {
    add_mesh(hash, mesh, scene.materials[static_cast<std::size_t>(mesh.material)], scene.shadows.both_sides);
  }
  hash.add(scene.horizon == Horizon::open ? "open" : "cut");
  add_values(hash, visibility_light(environment));
  return fmt::format("visibility-{}", hash.hex());
}

std::vector<std::uint8_t> to_bytes(const VisibilityField& field) {
  return sealed(form, [&](SealedWriter& out) {
    out.add<std::uint64_t>(field.layers.size());
    for (const Image& layer : field.layers) {
      out.add(layer.width);
      out.add(layer.height);
      out.add(layer.channels);
      out.add_values(layer.texels);
    }
    out.add<std::uint64_t>(field.meshes.size());
    for (const std::vector<VertexVisibility>& mesh : field.meshes) out.add_values(mesh);
    out.add(field.error);
  });
}

std::optional<VisibilityField> visibility_from_bytes(const StoredBytes& bytes, const Scene& scene) {
  std::optional<SealedReader> in = SealedReader::open(bytes, form);
  if (!in) return {};
  VisibilityField field;
  for (std::uint64_t count = in->get_count(3 * sizeof(int)); count > 0; --count) {
    Image& layer = field.layers.emplace_back();
    layer.width = in->get<int>();
    layer.height = in->get<int>();
    layer.channels = in->get<int>();
    layer.texels = in->get_values<float>();
  }
  for (std::uint64_t count = in->get_count(sizeof(std::uint64_t)); count > 0; --count) {
    field.meshes.push_back(in->get_values<VertexVisibility>());
  }
  field.error = in->get<double>();
  if (!in->finished() || field.layers.empty() || !fits(field, scene)) return {};
  return field;
}

VisibilityField kept_visibility_field(const Scene& scene, const Environment& environment, const DiskCache* cache,
                                      const Progress& progress) {
  if (cache == nullptr) return visibility_field(scene, Occluders(scene), environment, progress);
  const std::string key = visibility_key(scene, environment);
  const std::optional<StoredBytes> bytes = cache->find(key);
  if (auto kept = bytes ? visibility_from_bytes(*bytes, scene) : std::nullopt) return *std::move(kept);
  VisibilityField field = visibility_field(scene, Occluders(scene), environment, progress);
  cache->keep(key, to_bytes(field));
  return field;
}

}  // namespace footprint
