// Ray queries against the triangles of a scene: occlusion and nearest points.
#pragma once

#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "renderer/scene/scene.hpp"
#include "renderer/visibility/embree.hpp"

namespace footprint {

/// A point on a triangle of a scene, at (1 - u - v) a + u b + v c of its corners in their order.
struct SurfacePoint {
  std::size_t mesh = 0;
  std::size_t triangle = 0;
  float u = 0, v = 0;
};

/// A scene's triangles for ray tracing (Embree). A one-sided triangle blocks light on its front, and from behind only
/// with ShadowSettings::both_sides. Alpha masks are evaluated at the nearest texel. The scene must outlive this, with
/// unchanged meshes and materials. Thread-safe.
class Occluders {
 public:
  static constexpr float unlimited = std::numeric_limits<float>::infinity();

  /// Throws Error (machine): out of memory.
  explicit Occluders(const Scene& scene);

  /// Whether anything within `distance` blocks light that arrives at `origin` against the unit vector `direction`.
  [[nodiscard]] bool blocked(const glm::vec3& origin, const glm::vec3& direction, float distance = unlimited) const;

  /// Whether each of many unlimited rays from one point is blocked; a value per direction.
  [[nodiscard]] std::vector<bool> blocked(const glm::vec3& origin, std::span<const glm::vec3> directions) const;

  /// The first point at `least` or further that blocks light along the ray.
  [[nodiscard]] std::optional<SurfacePoint> nearest(const glm::vec3& origin, const glm::vec3& direction,
                                                    float least = 0.0F) const;

  /// Whether light from behind passes a mesh's triangles.
  [[nodiscard]] bool open_from_behind(std::size_t mesh) const;

  /// Whether no alpha mask cuts a point out.
  [[nodiscard]] bool present(const SurfacePoint& point) const;

  /// Corners of a triangle, in order.
  [[nodiscard]] std::array<const Vertex*, 3> corners(std::size_t mesh, std::size_t triangle) const;

  /// A point in world space, and a triangle's outward normal; zero without an area.
  [[nodiscard]] glm::vec3 position(const SurfacePoint& point) const;
  [[nodiscard]] glm::vec3 normal(std::size_t mesh, std::size_t triangle) const;

  /// The distance from the surface at which rays start to avoid intersecting it, metres, relative to the bounds.
  [[nodiscard]] float offset() const { return offset_; }

 private:
  // The data of the hit filter, for meshes with an alpha mask or open from behind.
  struct Sieve {
    const Mesh* mesh;
    const Material* material;
    bool open_from_behind;
    Image alpha;                      // one channel, of the base-colour map; only for alpha masks
    std::vector<glm::vec3> scaled{};  // positions times scale_, unless that is 1
  };

  // Discard hits of rays towards a light, or of rays in the direction of light.
  static void towards_light(const RTCFilterFunctionNArguments* hits);
  static void away_from_light(const RTCFilterFunctionNArguments* hits);
  static void drop_hits(const RTCFilterFunctionNArguments* hits, float towards_front);
  void add(const Mesh& mesh, Sieve& sieve);

  const Scene* scene_;
  float offset_;
  float scale_;  // from metres to the lengths of device_
  std::vector<Sieve> sieves_;
  EmbreeDevice device_;
  EmbreeScene rays_;
};

}  // namespace footprint
