// A scene of as many copies of the patch as a ray may cross.
#include "tests/support/ray_traced_tiling.hpp"

#include <cstddef>
#include <cstdint>

#include "renderer/visibility/embree.hpp"

namespace footprint::testing {
namespace {

// Vertices and indices of the copies.
void fill(const Patch& patch, int copies, float* vertices, std::uint32_t* indices) {
  std::uint32_t base = 0;
  for (int y = -copies; y <= copies; ++y) {
    for (int x = -copies; x <= copies; ++x) {
      for (const glm::vec3& v : patch.vertices) {
        *vertices++ = v.x + static_cast<float>(x) * patch.period.x;
        *vertices++ = v.y + static_cast<float>(y) * patch.period.y;
        *vertices++ = v.z;
      }
      for (const glm::uvec3& t : patch.triangles) {
        for (int i = 0; i < 3; ++i) *indices++ = base + t[i];
      }
      base += static_cast<std::uint32_t>(patch.vertices.size());
    }
  }
}

}  // namespace

struct RayTracedTiling::Handles {
  EmbreeDevice device;
  EmbreeScene scene;
};

RayTracedTiling::RayTracedTiling(const Patch& patch, int copies) : handles_(std::make_unique<Handles>()) {
  handles_->device.reset(rtcNewDevice(nullptr));
  handles_->scene.reset(rtcNewScene(handles_->device.get()));
  RTCScene scene = handles_->scene.get();
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  const auto tiles = static_cast<std::size_t>((2 * copies + 1) * (2 * copies + 1));
  RTCGeometry geometry = rtcNewGeometry(handles_->device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               12, patch.vertices.size() * tiles));
  auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, patch.triangles.size() * tiles));
  fill(patch, copies, vertices, indices);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
}

RayTracedTiling::~RayTracedTiling() = default;

bool RayTracedTiling::sees(const glm::vec3& position, const glm::dvec3& direction) const {
  constexpr float least = 2e-5F;  // over the facet's own rounding
  RTCRay ray = embree_ray(position, glm::vec3(direction), least);
  query_occlusion(handles_->scene.get(), ray);
  return !is_occluded(ray);
}

}  // namespace footprint::testing
