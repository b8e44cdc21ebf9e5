// A small renderer that knows of a bake what its files say, and of a scene its triangles, camera and one point light:
// what another engine would be. It shares no shader with the pipeline but the module in the files.
#pragma once

#include <filesystem>

#include "renderer/image/image.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint::testing {

/// In which files it looks for the maps.
enum class MapFiles { exr, ktx2 };

/// Draws the first mesh of a scene, lit by its first light, with the files of a bake in `folder`; linear radiance and
/// coverage, as the pipeline's pictures are.
[[nodiscard]] Image render_from_files(const std::filesystem::path& folder, const Scene& scene, const glm::ivec2& size,
                                      MapFiles maps);

}  // namespace footprint::testing
