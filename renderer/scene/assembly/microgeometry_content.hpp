// The small-scale geometry of a scene.toml, and MERL files.
#pragma once

#include <filesystem>
#include <memory>

#include "renderer/microgeometry/microgeometry.hpp"
#include "renderer/microgeometry/tabulated_brdf.hpp"
#include "renderer/scene/material.hpp"
#include "renderer/scene/settings/part.hpp"

namespace footprint {

/// Reads a file of three 32-bit sizes (90, 90, 180) and as many doubles for red, green and blue, little-endian, in the
/// database's units (1/1500, 1.15/1500 and 1.66/1500 sr^-1). Cells without a measurement (below 0) are 0.
/// Throws Error (usage), naming the file: missing, other sizes, too short or too long, a value that is not finite.
[[nodiscard]] TabulatedBrdf read_merl(const std::filesystem::path& file);

/// A patch and how it looks from above.
struct MicrogeometryContent {
  std::shared_ptr<const Microgeometry> microgeometry;
  std::shared_ptr<const Image> normals;
};

/// Builds or loads it. Throws Error (usage): of the parameters, of the file, of check_patch.
[[nodiscard]] MicrogeometryContent load_microgeometry(const MicrogeometrySettings& settings);

/// A material with that small-scale geometry: its normal map is the view from above, its base colour that of the patch
/// times its own.
void apply(const MicrogeometryContent& content, Material& material);

}  // namespace footprint
