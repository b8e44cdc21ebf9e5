// Facts of a run: its exposure, its machine and scene for the head of a report, and a hash of everything that its
// figures depend on.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/settings/run_settings.hpp"
#include "renderer/gl/context.hpp"
#include "renderer/image/image.hpp"
#include "renderer/scene/scene.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// The factor that takes the 95th percentile of the luminance of a picture's object pixels to 0.8: bright parts keep
/// their drawing, the sharpest highlights clip. 1 where the picture is black or has no object pixel. RGBA with
/// coverage.
[[nodiscard]] float automatic_exposure(const Image& reference);

/// The given exposure, else the scene's own, else the automatic one of its first reference.
[[nodiscard]] Exposure choose_exposure(const std::optional<Exposure>& given, const Scene& scene,
                                       const Image& first_reference);

/// The backend; the processor is left to the program, which knows it.
[[nodiscard]] BackendInfo backend_info(const gl::ContextInfo& context);

/// The scene with its exposure.
[[nodiscard]] SceneInfo scene_info(const Scene& scene, const Exposure& exposure);

/// A hash of the content of a scene, as it was loaded.
[[nodiscard]] std::string scene_content(const Scene& scene);

/// 16 hexadecimal digits: equal fingerprints mean equal figures at equal distances, except for times.
/// maker: program and renderer (maker_of_work).
/// content: scene_content of `scene`.
/// more: everything else that the figures depend on.
[[nodiscard]] std::string run_fingerprint(std::string_view maker, const RunSettings& settings, const Scene& scene,
                                          const std::string& content, const std::vector<std::string>& more = {});

}  // namespace footprint
