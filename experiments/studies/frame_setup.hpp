// The frames of a run: their size, footprint filter and program, and whether memory has room for their pictures.
#pragma once

#include <glm/vec2.hpp>
#include <optional>

#include "experiments/settings/run_settings.hpp"
#include "renderer/pipeline/frame.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint {

/// Images of the frame's size in memory at once in most runs: the frame, and two while it is written.
inline constexpr int pictures_of_a_frame = 3;

/// The size of a frame: `wanted`, else scene.toml's, else 512 wide in the aspect of the camera (square without one).
/// Errors (usage): a side below 1.
[[nodiscard]] glm::ivec2 frame_size(const Scene& scene, const std::optional<glm::ivec2>& wanted);

/// The footprint filter: `given`, else the scene's, else default_footprint_filter.
[[nodiscard]] FootprintFilter footprint_filter_of(const std::optional<FootprintFilter>& given, const Scene& scene);

/// The variant of a program that draws frames of a scene (forward_program).
[[nodiscard]] ShaderVariant frame_program(const Scene& scene, const FootprintFilter& filter);

/// Errors (machine): so many images (RGBA, 32-bit floats) of this size exceed memory.
void require_pictures(const glm::ivec2& size, int count);

}  // namespace footprint
