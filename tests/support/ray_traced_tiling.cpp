// A scene of as many copies of the patch as a ray may cross.
#include "tests/support/ray_traced_tiling.hpp"

#include <embree3/rtcore.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace footprint::testing {
namespace {

struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};

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
  std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice> device;
  std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene> scene;
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
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray{};
  ray.org_x = position.x;
  ray.org_y = position.y;
  ray.org_z = position.z;
  ray.dir_x = static_cast<float>(direction.x);
  ray.dir_y = static_cast<float>(direction.y);
  ray.dir_z = static_cast<float>(direction.z);
  ray.tnear = 2e-5F;  // over the facet's own rounding
  ray.tfar = std::numeric_limits<float>::infinity();
  ray.mask = ~0U;
  rtcOccluded1(handles_->scene.get(), &context, &ray);
  return ray.tfar > 0.0F;
}

}  // namespace footprint::testing
