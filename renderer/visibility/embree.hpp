// Embree 3 and 4 behind one set of handles and ray queries: the only file that knows which of them is installed.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <vector>

namespace footprint {

struct ReleaseEmbree {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene rays) const { rtcReleaseScene(rays); }
};
using EmbreeDevice = std::unique_ptr<RTCDeviceTy, ReleaseEmbree>;
using EmbreeScene = std::unique_ptr<RTCSceneTy, ReleaseEmbree>;

/// A ray from `origin` along the unit vector `direction`, between the distances `least` and `most`.
inline RTCRay embree_ray(const glm::vec3& origin, const glm::vec3& direction, float least = 0.0F,
                         float most = std::numeric_limits<float>::infinity()) {
  RTCRay ray{};
  ray.org_x = origin.x;
  ray.org_y = origin.y;
  ray.org_z = origin.z;
  ray.dir_x = direction.x;
  ray.dir_y = direction.y;
  ray.dir_z = direction.z;
  ray.tnear = least;
  ray.tfar = most;
  ray.mask = ~0U;
  return ray;
}

/// Whether an occlusion query hit something: Embree then sets the far distance to minus infinity.
inline bool is_occluded(const RTCRay& ray) { return ray.tfar < 0.0F; }

#if RTC_VERSION_MAJOR >= 4

/// Asks whether a ray hits anything (is_occluded).
inline void query_occlusion(RTCScene rays, RTCRay& ray) { rtcOccluded1(rays, &ray, nullptr); }

/// Asks the same of rays from one point.
inline void query_occlusion(RTCScene rays, std::vector<RTCRay>& coherent) {
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  for (RTCRay& ray : coherent) rtcOccluded1(rays, &ray, &arguments);
}

/// Finds the nearest hit of a ray.
inline void query_nearest(RTCScene rays, RTCRayHit& hit) { rtcIntersect1(rays, &hit, nullptr); }

#else

/// Asks whether a ray hits anything (is_occluded).
inline void query_occlusion(RTCScene rays, RTCRay& ray) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(rays, &context, &ray);
}

/// Asks the same of rays from one point.
inline void query_occlusion(RTCScene rays, std::vector<RTCRay>& coherent) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcOccluded1M(rays, &context, coherent.data(), static_cast<unsigned>(coherent.size()), sizeof(RTCRay));
}

/// Finds the nearest hit of a ray.
inline void query_nearest(RTCScene rays, RTCRayHit& hit) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(rays, &context, &hit);
}

#endif

}  // namespace footprint
