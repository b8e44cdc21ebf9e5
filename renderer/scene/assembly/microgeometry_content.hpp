// The small-scale geometry of a scene.toml, and MERL files.
#pragma once

#include <filesystem>
#include <memory>

#include "renderer/microgeometry/microgeometry.hpp"
#include "renderer/scene/material.hpp"
#include "renderer/scene/settings/part.hpp"

namespace footprint {

/// Reads a MERL file: three 32-bit sizes (90, 90, 180) and as many little-endian doubles for red, green and blue, in
/// the database's units (1/1500, 1.15/1500 and 1.66/1500 sr^-1). Cells without a measurement (below 0) are 0.
/// Throws Error (usage) that names the file: missing, other sizes, too short or too long, or a value that is not
/// finite.
[[nodiscard]] TabulatedBrdf read_merl(const std::filesystem::path& file);

/// A patch and the normal map of its view from above.
struct MicrogeometryContent {
  std::shared_ptr<const Microgeometry> microgeometry;
  std::shared_ptr<const Image> normals;
};

/// Builds or loads a patch. Throws Error (usage): parameters, files, or as check_patch.
[[nodiscard]] MicrogeometryContent load_microgeometry(const MicrogeometrySettings& settings);

/// Adds the patch to a material: its normal map becomes the view from above, and its base colour is multiplied by the
/// patch's mean.
void apply(const MicrogeometryContent& content, Material& material);

}  // namespace footprint
