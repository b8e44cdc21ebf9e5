// A hash of everything that the figures of a run depend on.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "experiments/settings/run_settings.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint {

/// A hash of the content of a scene, as it was loaded.
[[nodiscard]] std::string scene_content(const Scene& scene);

/// 16 hexadecimal digits: equal fingerprints mean equal figures at equal distances, except for times.
/// maker: program and renderer (maker_of_work).
/// content: scene_content of `scene`.
/// more: everything else that the figures depend on.
[[nodiscard]] std::string run_fingerprint(std::string_view maker, const RunSettings& settings, const Scene& scene,
                                          const std::string& content, const std::vector<std::string>& more = {});

}  // namespace footprint
