// A small renderer that knows of a bake what its files say, and of a scene its triangles, camera and one point light:
// what another engine would be. It shares no shader with the pipeline but the module in the files.
#pragma once

#include <filesystem>

#include "renderer/image/image.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint::testing {

/// In which files it looks for the maps.
enum class MapFiles { exr, ktx2 };

/// A scene for it, with bumps and a roughness that varies, seen obliquely: several levels and several probes are read.
/// texels: of a side of the normal map.
[[nodiscard]] Scene rough_square(int texels = 32);

/// Draws the first mesh of a scene, lit by its first light, with the files of a bake in `folder`; linear radiance and
/// coverage, as the pipeline's pictures are.
/// shader: a translation of the module into GLSL or ESSL, drawn in the module's place; empty: none.
[[nodiscard]] Image render_from_files(const std::filesystem::path& folder, const Scene& scene, const glm::ivec2& size,
                                      MapFiles maps, const std::string& shader = {});

}  // namespace footprint::testing
