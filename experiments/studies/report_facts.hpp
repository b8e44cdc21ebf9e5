// What the head of a report says of the backend and of the scene.
#pragma once

#include "experiments/settings/run_settings.hpp"
#include "renderer/gl/context.hpp"
#include "renderer/scene/scene.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// The backend; the processor is left to the program, which knows it.
[[nodiscard]] BackendInfo backend_info(const gl::ContextInfo& context);

/// The scene with its exposure.
[[nodiscard]] SceneInfo scene_info(const Scene& scene, const Exposure& exposure);

}  // namespace footprint
