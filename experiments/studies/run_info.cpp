// Facts of a context and of a scene for the head of a report.
#include "experiments/studies/run_info.hpp"

#include <fmt/format.h>

namespace footprint {
namespace {

constexpr double converged_standard_error = 0.5;  // of the mean radiance; above it a warning goes with the results

}  // namespace

BackendInfo backend_info(const gl::ContextInfo& context) {
  return {.name = std::string(gl::backend_name(context.backend)),
          .renderer = context.renderer,
          .version = context.version,
          .cpu = {}};
}

SceneInfo scene_info(const Scene& scene, const Exposure& exposure, const ReferenceInfo& reference) {
  SceneInfo info{.name = scene.name,
                 .source = scene.source,
                 .triangles = 0,
                 .materials = scene.materials.size(),
                 .lights = scene.lights.size(),
                 .exposure = exposure.factor,
                 .exposure_source = std::string(word_for(exposure_sources, exposure.source)),
                 .defaults = scene.defaults,
                 .warnings = scene.warnings};
  for (const Mesh& mesh : scene.meshes) info.triangles += mesh.indices.size() / 3;
  if (const auto noise = reference.standard_error; noise && *noise > converged_standard_error) {
    info.warnings.push_back(fmt::format(
        "the reference has not converged: its standard error is {:.2g} of the mean radiance, as happens where lights "
        "make highlights too sharp for {} samples; raise --spp before small differences are trusted",
        *noise, reference.spp));
  }
  return info;
}

}  // namespace footprint
