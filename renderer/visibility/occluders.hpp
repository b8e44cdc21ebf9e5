// What stands in the way of light: the triangles of a scene, asked by rays.
#pragma once

#include <embree3/rtcore.h>

#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "renderer/scene/scene.hpp"

namespace footprint {

/// A point on a triangle of a scene, at (1 - u - v) a + u b + v c of its corners in their order.
struct SurfacePoint {
  std::size_t mesh = 0;
  std::size_t triangle = 0;
  float u = 0, v = 0;
};

/// A scene's triangles, ready for rays (Embree). A one-sided triangle stands in the way of light that comes to its
/// front, from behind only where ShadowSettings::both_sides says so; what an alpha mask cuts out does not, by the texel
/// nearest to the point. Refers to the scene, which
/// must outlive it and keep its meshes and materials as they are. Questions may be asked by many threads at once.
class Occluders {
 public:
  static constexpr float unlimited = std::numeric_limits<float>::infinity();

  /// Throws Error (machine): memory is out.
  explicit Occluders(const Scene& scene);

  /// Whether anything keeps light from `origin` that comes against the unit vector `direction`, from nearer than
  /// `distance`.
  [[nodiscard]] bool blocked(const glm::vec3& origin, const glm::vec3& direction, float distance = unlimited) const;

  /// The same for many rays without an end from one point; a value per direction.
  [[nodiscard]] std::vector<bool> blocked(const glm::vec3& origin, std::span<const glm::vec3> directions) const;

  /// The first point that keeps light which goes along the ray from going on, at `least` or further.
  [[nodiscard]] std::optional<SurfacePoint> nearest(const glm::vec3& origin, const glm::vec3& direction,
                                                    float least = 0.0F) const;

  /// Whether light that comes to a mesh's triangle from behind passes.
  [[nodiscard]] bool open_from_behind(std::size_t mesh) const;

  /// Whether a point is there: no alpha mask cuts it out.
  [[nodiscard]] bool present(const SurfacePoint& point) const;

  /// Corners of a triangle, in order.
  [[nodiscard]] std::array<const Vertex*, 3> corners(std::size_t mesh, std::size_t triangle) const;

  /// Its position in world space, and the triangle's normal, outwards as it is wound; zero where it has no area.
  [[nodiscard]] glm::vec3 position(const SurfacePoint& point) const;
  [[nodiscard]] glm::vec3 normal(std::size_t mesh, std::size_t triangle) const;

  /// How far from a surface a ray starts so that it does not meet it again by rounding: metres, relative to the
  /// bounds.
  [[nodiscard]] float offset() const { return offset_; }

 private:
  struct Release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene rays) const { rtcReleaseScene(rays); }
  };
  // What the filter of a mesh with holes, or of one that lets light from behind through, needs to know of it.
  struct Sieve {
    const Mesh* mesh;
    const Material* material;
    bool open_from_behind;
    Image alpha;  // of the base-colour map, its one channel, where an alpha mask looks at it
  };

  // Drops the hits of rays towards a light, and of rays that light takes.
  static void towards_light(const RTCFilterFunctionNArguments* hits);
  static void away_from_light(const RTCFilterFunctionNArguments* hits);
  static void drop_hits(const RTCFilterFunctionNArguments* hits, float towards_front);
  void add(const Mesh& mesh, Sieve& sieve);

  const Scene* scene_;
  float offset_;
  std::vector<Sieve> sieves_;
  std::unique_ptr<RTCDeviceTy, Release> device_;
  std::unique_ptr<RTCSceneTy, Release> rays_;
};

}  // namespace footprint
