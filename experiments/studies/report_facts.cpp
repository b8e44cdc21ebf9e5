// Facts as they are stored in results.
#include "experiments/studies/report_facts.hpp"

#include <string>

#include "experiments/settings/setting.hpp"

namespace footprint {

BackendInfo backend_info(const gl::ContextInfo& context) {
  return {
      .name = std::string(gl::backend_name(context.backend)), .renderer = context.renderer, .version = context.version};
}

SceneInfo scene_info(const Scene& scene, const Exposure& exposure) {
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
  return info;
}

}  // namespace footprint
