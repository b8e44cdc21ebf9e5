// What a method rebuilds on the GPU each frame, before shading.
#pragma once

#include <optional>

namespace footprint {

struct FrameBuildJob;  // renderer/pipeline/frame_build_job.hpp: it names GL objects

/// What of a frame goes into what is built.
struct BuildInputs {
  bool camera = false, geometry = false, materials = false, lights = false;
};

/// The passes of a method's frame build, compiled for one scene. They fill the textures that the precompute declared
/// with make_built_texture, by drawing into them or by compute. A pass may bind what it likes (program, framebuffer,
/// vertex array, texture and image units, uniform blocks), and change the viewport, the depth test, culling and
/// blending: GpuMethod puts back what a draw does not set for itself. Of the rest of the GL's state nothing may change.
class FrameBuild {
 public:
  FrameBuild() = default;
  FrameBuild(const FrameBuild&) = delete;
  FrameBuild& operator=(const FrameBuild&) = delete;
  virtual ~FrameBuild() = default;

  /// Issues the passes for one material. Whoever calls it puts memory barriers before and behind it.
  virtual void run(const FrameBuildJob& job) const = 0;

  /// Whether what is built differs from one view to another, so that it is no map of the material.
  [[nodiscard]] virtual bool looks_from_view() const { return true; }

  /// What a build may be kept for: as long as none of these changes, what was built serves the next frame too. None: it
  /// is built for every frame, whatever moved.
  [[nodiscard]] virtual std::optional<BuildInputs> kept_until_change_of() const { return {}; }
};

}  // namespace footprint
