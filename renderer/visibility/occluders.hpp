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

/// A scene's triangles, ready for rays (Embree). A triangle stands in the way from both sides, whether or not it is
/// drawn from both; what an alpha mask cuts out does not, by the texel nearest to the point. Refers to the scene, which
/// must outlive it and keep its meshes and materials as they are. Questions may be asked by many threads at once.
class Occluders {
 public:
  static constexpr float unlimited = std::numeric_limits<float>::infinity();

  /// Errors (machine): memory is out.
  explicit Occluders(const Scene& scene);

  /// Whether anything lies on the ray, from `origin` along the unit vector `direction`, nearer than `distance`.
  [[nodiscard]] bool blocked(const glm::vec3& origin, const glm::vec3& direction, float distance = unlimited) const;

  /// The same for many rays without an end from one point; a value a direction.
  [[nodiscard]] std::vector<bool> blocked(const glm::vec3& origin, std::span<const glm::vec3> directions) const;

  /// The first point on the ray at `least` or further, if there is one.
  [[nodiscard]] std::optional<SurfacePoint> nearest(const glm::vec3& origin, const glm::vec3& direction,
                                                    float least = 0.0F) const;

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
  // What the filter of a cut-out mesh needs to know of it.
  struct CutOut {
    const Mesh* mesh;
    const Material* material;
  };

  static void let_holes_through(const RTCFilterFunctionNArguments* hit);
  void add(const Mesh& mesh, CutOut& cut_out);

  const Scene* scene_;
  float offset_;
  std::vector<CutOut> cut_outs_;
  std::unique_ptr<RTCDeviceTy, Release> device_;
  std::unique_ptr<RTCSceneTy, Release> rays_;
};

}  // namespace footprint
