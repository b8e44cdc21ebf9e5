// An Embree scene whose filters let rays through the holes that alpha cuts out, and through one-sided triangles from
// behind.
#include "renderer/visibility/occluders.hpp"

#include <algorithm>
#include <cmath>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

// 32-bit positions are off by 6e-8 of their size; triangles of one smooth surface meet within far more than that.
constexpr float relative_offset = 1e-4F;

// The factor that brings lengths of a very small or very large scene near 1, because Embree multiplies four of them. A
// power of two rounds nothing.
float scale_for(float radius) {
  constexpr int most = 20;  // of the exponent: a micrometre to a thousand kilometres
  if (!(radius > 0.0F)) return 1.0F;
  const int exponent = std::ilogb(radius);
  return std::abs(exponent) <= most ? 1.0F : std::ldexp(1.0F, -exponent);
}

[[noreturn]] void throw_out_of_memory(const Scene& scene) {
  throw Error(ErrorKind::machine, scene.source, "the search of what casts shadows gets no memory, or no thread",
              "set `cast = false` in [shadows] of a scene.toml, free memory, or raise `ulimit -v` or `ulimit -u`");
}

int wrapped(int texel, int size, Wrap wrap) {
  if (wrap == Wrap::clamp_to_edge) return std::clamp(texel, 0, size - 1);
  const int period = wrap == Wrap::repeat ? size : 2 * size;
  const int there = ((texel % period) + period) % period;
  return there < size ? there : 2 * size - 1 - there;
}

// Texture coordinates may be a million tiles away, which still fits an int for 16384 texels, but no more.
int texel_of(float coordinate, int size, Wrap wrap) {
  constexpr float most = 1e9F;
  return wrapped(static_cast<int>(std::clamp(std::floor(coordinate * static_cast<float>(size)), -most, most)), size,
                 wrap);
}

std::array<const Vertex*, 3> corners_of(const Mesh& mesh, std::size_t triangle) {
  return {&mesh.vertices[mesh.indices[3 * triangle]], &mesh.vertices[mesh.indices[3 * triangle + 1]],
          &mesh.vertices[mesh.indices[3 * triangle + 2]]};
}

// A value of vertices at a point of a triangle.
template <class ValueOf>
auto interpolated(const std::array<const Vertex*, 3>& corners, const SurfacePoint& point, const ValueOf& value_of) {
  return (1.0F - point.u - point.v) * value_of(*corners[0]) + point.u * value_of(*corners[1]) +
         point.v * value_of(*corners[2]);
}

// The last channel of the base-colour map, where an alpha mask needs it.
Image alpha_of(const Material& material) {
  if (!material.alpha_cutoff || !material.base_color_map) return {};
  return mapped(material.base_color_map->image.decoded(), 1, [](const auto& in, const auto& out) { out[0] = in[3]; });
}

bool is_there(const Mesh& mesh, const Material& material, const Image& alpha_map, const SurfacePoint& point) {
  if (!material.alpha_cutoff) return true;
  const auto corners = corners_of(mesh, point.triangle);
  float alpha =
      material.base_color.a * interpolated(corners, point, [](const Vertex& vertex) { return vertex.color.a; });
  if (material.base_color_map) {
    const TextureCoordinates& coordinates = material.base_color_map->coordinates;
    const glm::vec2 uv = interpolated(
        corners, point, [&](const Vertex& vertex) { return coordinates.set == 0 ? vertex.uv0 : vertex.uv1; });
    const glm::vec2 mapped = coordinates.transform * glm::vec3(uv, 1.0F);
    alpha *= alpha_map.at(texel_of(mapped.x, alpha_map.width, coordinates.wrap[0]),
                          texel_of(mapped.y, alpha_map.height, coordinates.wrap[1]))[0];
  }
  return alpha >= *material.alpha_cutoff;
}

}  // namespace

Occluders::Occluders(const Scene& scene)
    : scene_(&scene),
      offset_(relative_offset * std::max(scene.bounds.radius(), std::numeric_limits<float>::min())),
      scale_(scale_for(scene.bounds.radius())),
      device_(rtcNewDevice(nullptr)),
      rays_(device_ ? rtcNewScene(device_.get()) : nullptr) {
  if (!rays_) throw_out_of_memory(scene);
  rtcSetSceneFlags(rays_.get(), RTC_SCENE_FLAG_ROBUST);
  for (const Mesh& mesh : scene.meshes) {
    const Material& material = scene.materials[static_cast<std::size_t>(mesh.material)];
    sieves_.push_back({&mesh, &material, !material.double_sided && !scene.shadows.both_sides, alpha_of(material)});
  }
  for (Sieve& sieve : sieves_) add(*sieve.mesh, sieve);
  rtcCommitScene(rays_.get());
  if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE) throw_out_of_memory(scene);
}

void Occluders::add(const Mesh& mesh, Sieve& sieve) {
  RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  if (scale_ == 1.0F) {
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh.vertices.data(),
                               offsetof(Vertex, position), sizeof(Vertex), mesh.vertices.size());
  } else {
    for (const Vertex& vertex : mesh.vertices) sieve.scaled.push_back(scale_ * vertex.position);
    sieve.scaled.emplace_back(0.0F);  // Embree reads four floats of the last one
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sieve.scaled.data(), 0,
                               sizeof(glm::vec3), mesh.vertices.size());
  }
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.indices.data(), 0,
                             3 * sizeof(std::uint32_t), mesh.indices.size() / 3);
  if (sieve.material->alpha_cutoff || sieve.open_from_behind) {
    rtcSetGeometryUserData(geometry, &sieve);
    rtcSetGeometryOccludedFilterFunction(geometry, towards_light);
    rtcSetGeometryIntersectFilterFunction(geometry, away_from_light);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(rays_.get(), geometry);
  rtcReleaseGeometry(geometry);
}

// `towards_front` is the sign of a ray's direction along the outward normal of a triangle whose front it concerns.
void Occluders::drop_hits(const RTCFilterFunctionNArguments* hits, float towards_front) {
  const auto& [mesh, material, open, alpha, scaled] = *static_cast<const Sieve*>(hits->geometryUserPtr);
  const unsigned n = hits->N;
  for (unsigned i = 0; i < n; ++i) {
    if (hits->valid[i] == 0) continue;
    const glm::vec3 normal(RTCHitN_Ng_x(hits->hit, n, i), RTCHitN_Ng_y(hits->hit, n, i), RTCHitN_Ng_z(hits->hit, n, i));
    const glm::vec3 along(RTCRayN_dir_x(hits->ray, n, i), RTCRayN_dir_y(hits->ray, n, i),
                          RTCRayN_dir_z(hits->ray, n, i));
    const bool from_behind = open && towards_front * glm::dot(normal, along) < 0.0F;
    const SurfacePoint point{0, RTCHitN_primID(hits->hit, n, i), RTCHitN_u(hits->hit, n, i),
                             RTCHitN_v(hits->hit, n, i)};
    if (from_behind || !is_there(*mesh, *material, alpha, point)) hits->valid[i] = 0;
  }
}

void Occluders::towards_light(const RTCFilterFunctionNArguments* hits) { drop_hits(hits, 1.0F); }

void Occluders::away_from_light(const RTCFilterFunctionNArguments* hits) { drop_hits(hits, -1.0F); }

bool Occluders::open_from_behind(std::size_t mesh) const { return sieves_[mesh].open_from_behind; }

bool Occluders::blocked(const glm::vec3& origin, const glm::vec3& direction, float distance) const {
  RTCRay ray = embree_ray(scale_ * origin, direction, 0.0F, scale_ * distance);
  query_occlusion(rays_.get(), ray);
  return is_occluded(ray);
}

std::vector<bool> Occluders::blocked(const glm::vec3& origin, std::span<const glm::vec3> directions) const {
  std::vector<RTCRay> rays;
  rays.reserve(directions.size());
  for (const glm::vec3& direction : directions) rays.push_back(embree_ray(scale_ * origin, direction));
  query_occlusion(rays_.get(), rays);
  std::vector<bool> out;
  out.reserve(rays.size());
  for (const RTCRay& ray : rays) out.push_back(is_occluded(ray));
  return out;
}

std::optional<SurfacePoint> Occluders::nearest(const glm::vec3& origin, const glm::vec3& direction, float least) const {
  RTCRayHit found{.ray = embree_ray(scale_ * origin, direction, scale_ * least), .hit = {}};
  found.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query_nearest(rays_.get(), found);
  if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  return SurfacePoint{found.hit.geomID, found.hit.primID, found.hit.u, found.hit.v};
}

bool Occluders::present(const SurfacePoint& point) const {
  const Sieve& sieve = sieves_[point.mesh];
  return is_there(*sieve.mesh, *sieve.material, sieve.alpha, point);
}

std::array<const Vertex*, 3> Occluders::corners(std::size_t mesh, std::size_t triangle) const {
  return corners_of(scene_->meshes[mesh], triangle);
}

glm::vec3 Occluders::position(const SurfacePoint& point) const {
  return interpolated(corners(point.mesh, point.triangle), point, [](const Vertex& vertex) { return vertex.position; });
}

glm::vec3 Occluders::normal(std::size_t mesh, std::size_t triangle) const {
  const auto [a, b, c] = corners(mesh, triangle);
  const glm::dvec3 outwards =
      glm::cross(glm::dvec3(b->position) - glm::dvec3(a->position), glm::dvec3(c->position) - glm::dvec3(a->position));
  const double length = glm::length(outwards);
  return length > 0.0 ? glm::vec3(outwards / length) : glm::vec3(0.0F);
}

}  // namespace footprint
