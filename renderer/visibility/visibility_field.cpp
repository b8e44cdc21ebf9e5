// Principal components of the signed distances of some vertices, interpolated at the others.
#include "renderer/visibility/visibility_field.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "renderer/core/bytes.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/memory.hpp"
#include "renderer/environment/radiance_stack.hpp"
#include "renderer/environment/reference_tables.hpp"
#include "renderer/scene/scene.hpp"
#include "renderer/visibility/signed_distance.hpp"

namespace footprint {
namespace {

constexpr int map_texels = visibility_map_edge * visibility_map_edge;
constexpr int bordered_edge = visibility_map_edge + 2;
constexpr std::size_t vertices_at_once = 512;  // between two reports of progress
constexpr std::size_t channels = 4;
constexpr int fewest_columns = 512;  // of an environment, eight or so for each cell along the equator

using Distances = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;  // a row per vertex

std::vector<glm::vec3> map_directions() {
  std::vector<glm::vec3> directions;
  for (int y = 0; y < visibility_map_edge; ++y) {
    for (int x = 0; x < visibility_map_edge; ++x) {
      directions.emplace_back(bordered_texel_direction(bordered_edge, x + 1, y + 1));
    }
  }
  return directions;
}

// A vertex of the scene, counted over all meshes.
std::vector<const Vertex*> all_vertices(const Scene& scene) {
  std::vector<const Vertex*> vertices;
  for (const Mesh& mesh : scene.meshes) {
    for (const Vertex& vertex : mesh.vertices) vertices.push_back(&vertex);
  }
  return vertices;
}

glm::vec3 diffuse_share(const SphereVisibility& visible, const glm::vec3& normal, std::span<const glm::dvec3> light) {
  glm::dvec3 above(0.0), seen(0.0);
  const std::vector<glm::vec3>& directions = visibility_directions();
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const glm::dvec3 arriving = static_cast<double>(std::max(glm::dot(directions[i], normal), 0.0F)) * light[i];
    above += arriving;
    if (visible[i]) seen += arriving;
  }
  glm::vec3 share(1.0F);
  for (int c = 0; c < 3; ++c) {
    if (above[c] > 0.0) share[c] = static_cast<float>(seen[c] / above[c]);
  }
  return share;
}

// Solid angles of the grid's cells but for a factor: an octahedron's, seen from its centre.
std::vector<glm::dvec3> even_light() {
  std::vector<glm::dvec3> light;
  for (const glm::vec3& d : visibility_directions())
    light.emplace_back(std::pow(std::abs(d.x) + std::abs(d.y) + std::abs(d.z), 3.0));
  return light;
}

float hidden_share(const SphereVisibility& visible, const glm::vec3& normal) {
  constexpr float least = 0.005F;  // grazing rays meet a smooth surface's own triangles
  static const std::vector<glm::dvec3> even = even_light();
  const float hidden = 1.0F - diffuse_share(visible, normal, even).x;
  return hidden < least ? 0.0F : hidden;
}

// Distances and shares of all samples before compression.
struct Measured {
  Distances distances;
  std::vector<VertexVisibility> shares;  // without weights
};

std::uint64_t bytes_of(std::size_t vertices, std::size_t samples) {
  return vertices * sizeof(VertexVisibility) + 2 * samples * map_texels * sizeof(float);
}

Measured measure(const std::vector<const Vertex*>& vertices, const Occluders& occluders, Horizon horizon,
                 std::span<const glm::dvec3> light, const Progress& progress) {
  Measured measured{Distances(static_cast<Eigen::Index>(vertices.size()), map_texels),
                    std::vector<VertexVisibility>(vertices.size())};
  const std::vector<glm::vec3> directions = map_directions();
  for (std::size_t start = 0; start < vertices.size(); start += vertices_at_once) {
    progress("visibility at vertices", static_cast<double>(start) / static_cast<double>(vertices.size()));
    const std::size_t end = std::min(start + vertices_at_once, vertices.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(start, end, 16), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        const glm::vec3& given = vertices[i]->normal;
        const glm::vec3 normal = given / std::max(glm::length(given), 1e-20F);
        const SphereVisibility visible = visibility_at(occluders, vertices[i]->position, normal, horizon);
        const std::vector<float> distances = signed_distances(visible, directions);
        std::ranges::copy(distances, measured.distances.row(static_cast<Eigen::Index>(i)).data());
        measured.shares[i].diffuse_share = diffuse_share(visible, normal, light);
        measured.shares[i].hidden = hidden_share(visible, normal);
      }
    });
  }
  return measured;
}

// Half of the longest edge of a refined mesh: between vertices so far apart the rasteriser interpolates.
float sample_spacing(const Scene& scene) {
  return std::max(0.5F * scene.bounds.radius() / visibility_edges_in_radius, std::numeric_limits<float>::min());
}

struct ChosenVertices {
  VertexSamples samples;
  double coarseness;
};

// Doubles the distance of computed vertices until they fit in memory.
ChosenVertices chosen_vertices(const std::vector<const Vertex*>& vertices, const Scene& scene, std::uint64_t memory) {
  constexpr double coarsest = 64.0;  // farther apart than the whole scene is wide
  const float spacing = sample_spacing(scene);
  for (double coarseness = 1.0;; coarseness *= 2.0) {
    VertexSamples samples(vertices, static_cast<float>(coarseness) * spacing);
    const std::uint64_t bytes = bytes_of(vertices.size(), samples.samples().size());
    if (bytes <= memory) return {std::move(samples), coarseness};
    if (coarseness < coarsest) continue;
    throw Error(ErrorKind::machine, {},
                fmt::format("visibility at {} vertices takes {}, and {} are free", vertices.size(),
                            readable_bytes(bytes), readable_bytes(memory)),
                "set `cast = false` in [shadows] of a scene.toml, or use a coarser model");
  }
}

VertexVisibility interpolated(const VertexSamples& samples, const Vertex& vertex, const Eigen::MatrixXf& weights,
                              const std::vector<VertexVisibility>& shares) {
  VertexVisibility value{.weights = {}, .diffuse_share = glm::vec3(0.0F)};
  samples.interpolate(vertex, [&](std::size_t sample, float share) {
    for (std::size_t k = 0; k < visibility_components; ++k) {
      value.weights.at(k) += share * weights(static_cast<Eigen::Index>(sample), static_cast<Eigen::Index>(k));
    }
    value.diffuse_share += share * shares[sample].diffuse_share;
    value.hidden += share * shares[sample].hidden;
  });
  return value;
}

// The directions of greatest variance, the greatest first.
Eigen::MatrixXf principal_components(const Distances& centred) {
  const Eigen::MatrixXd covariance = (centred.transpose() * centred).cast<double>();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance);
  return solver.eigenvectors().rightCols(visibility_components).rowwise().reverse().cast<float>();
}

// Mean and components side by side in the channels of bordered maps.
std::vector<Image> make_layers(const Eigen::RowVectorXf& mean, const Eigen::MatrixXf& components) {
  std::vector<Image> layers((visibility_components + channels) / channels,
                            Image(bordered_edge, bordered_edge, channels));
  for (int y = 0; y < bordered_edge; ++y) {
    for (int x = 0; x < bordered_edge; ++x) {
      const glm::dvec2 uv = octahedral_uv(bordered_texel_direction(bordered_edge, x, y));
      const glm::ivec2 inside =
          glm::min(glm::ivec2(uv * static_cast<double>(visibility_map_edge)), visibility_map_edge - 1);
      const int texel = inside.y * visibility_map_edge + inside.x;
      layers[0].at(x, y)[0] = mean[texel];
      for (std::size_t k = 0; k < visibility_components; ++k) {
        layers[(k + 1) / channels].at(x, y)[(k + 1) % channels] = components(texel, static_cast<Eigen::Index>(k));
      }
    }
  }
  return layers;
}

constexpr std::string_view form = "footprint visibility 4";  // another layout below: another number here

template <class Value>
void add_values(ContentHash& hash, const std::vector<Value>& values) {
  hash.add(std::as_bytes(std::span(values)));
}

void add_mesh(ContentHash& hash, const Mesh& mesh, const Material& material, bool both_sides) {
  std::vector<glm::vec3> surface;
  std::vector<glm::vec2> cut_out;  // what an alpha mask reads
  for (const Vertex& vertex : mesh.vertices) {
    surface.insert(surface.end(), {vertex.position, vertex.normal});
    if (material.alpha_cutoff) cut_out.insert(cut_out.end(), {vertex.uv0, vertex.uv1, glm::vec2(vertex.color.a)});
  }
  add_values(hash, surface);
  add_values(hash, mesh.indices);
  add_values(hash, cut_out);
  hash.add(material.double_sided || both_sides ? "both sides" : "front");
  if (material.alpha_cutoff) add_content(hash, material);
}

}  // namespace

std::vector<glm::dvec3> visibility_light(const Environment& environment) {
  return light_of_cells(
      environment,
      {.count = visibility_directions().size(), .cell_of = visibility_cell, .fewest_columns = fewest_columns});
}

VisibilityField visibility_field(const Scene& scene, const Occluders& occluders, const Environment& environment,
                                 const Progress& progress, std::uint64_t memory) {
  const auto [samples, coarseness] = chosen_vertices(all_vertices(scene), scene, memory);
  Measured measured = measure(samples.samples(), occluders, scene.horizon, visibility_light(environment), progress);
  const Eigen::RowVectorXf mean = measured.distances.colwise().mean();
  measured.distances.rowwise() -= mean;
  const Eigen::MatrixXf components = principal_components(measured.distances);
  const Eigen::MatrixXf weights = measured.distances * components;
  VisibilityField field{.layers = make_layers(mean, components), .meshes = {}};
  for (const Mesh& mesh : scene.meshes) {
    std::vector<VertexVisibility>& values = field.meshes.emplace_back(mesh.vertices.size());
    tbb::parallel_for(std::size_t{0}, values.size(), [&, &from = samples](std::size_t i) {
      values[i] = interpolated(from, mesh.vertices[i], weights, measured.shares);
    });
  }
  const double left_out = (measured.distances - weights * components.transpose()).squaredNorm();
  field.error = std::sqrt(left_out / static_cast<double>(measured.distances.size()));
  field.coarseness = coarseness;
  return field;
}

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
  std::vector<std::uint8_t> bytes;
  write_checksummed(form, field, appending_to(bytes));
  return bytes;
}

std::optional<VisibilityField> visibility_from_bytes(const ByteSource& bytes, const Scene& scene) {
  std::optional<VisibilityField> field = read_checksummed<VisibilityField>(form, bytes);
  const auto vertices = [](const Mesh& mesh) { return mesh.vertices.size(); };
  const bool fits = field && std::ranges::equal(field->meshes, scene.meshes, std::ranges::equal_to(),
                                                &std::vector<VertexVisibility>::size, vertices);
  return fits ? std::move(field) : std::nullopt;
}

VisibilityField cached_visibility_field(const Scene& scene, const Environment& environment, const DiskCache* cache,
                                        const Progress& progress) {
  if (cache == nullptr) return visibility_field(scene, Occluders(scene), environment, progress);
  const std::string key = visibility_key(scene, environment);
  const std::optional<ByteSource> bytes = cache->find(key);
  if (auto cached = bytes ? visibility_from_bytes(*bytes, scene) : std::nullopt) return *std::move(cached);
  VisibilityField field = visibility_field(scene, Occluders(scene), environment, progress);
  if (field.coarseness == 1.0) cache->store(key, to_bytes(field));
  return field;
}

}  // namespace footprint
