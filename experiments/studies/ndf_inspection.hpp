// The NDF inspector: the effective NDF of one footprint by several methods beside the exact one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/settings/run_settings.hpp"
#include "renderer/core/progress.hpp"
#include "renderer/core/run_folder.hpp"
#include "renderer/ndf/footprint_texels.hpp"
#include "renderer/scene/material.hpp"
#include "renderer/scene/settings/part.hpp"
#include "renderer/scene/surface.hpp"
#include "results/report/command_reports.hpp"

namespace footprint {

/// A material to look into, and what a reader should know of it.
struct NdfSource {
  std::string path;  ///< as given
  bool is_map = false;
  Material material;
  std::vector<std::string> notes;  ///< warnings of the loader, one line each
};

/// Reads SCENE|MAP: an image file as read_normals does under the lobe blinn_phong:64, anything else as a scene, of
/// which `material` (a name or a number from 0; empty: the only one) is taken. Errors (usage): what the loaders refuse;
/// no such material, or several and none named; heights of a scene.
[[nodiscard]] NdfSource load_ndf_source(const NormalFile& source, const std::string& material,
                                        const SceneLibrary& library);

/// The material with `lobe` in place of its own distribution and roughness.
[[nodiscard]] Material with_lobe(Material material, const Lobe& lobe);

/// The settings of `footprint ndf`.
struct NdfSettings {
  RunSettings run;  ///< no methods: every method of the registry that takes the material; a tile is one of directions
  FootprintRect footprint = {};
  int resolution = 0;  ///< rings of directions; 0: from the narrowest lobe
  int picture = 256;   ///< side of the pictures, pixels
};

/// Takes the figures, and writes ndf.png and images/ below `folder`. Errors (usage): an empty footprint, no normal
/// under it, a named method that refuses the material; (machine): no GL, memory; (interrupted) by `progress`.
[[nodiscard]] NdfResults inspect_ndf(const NdfSource& source, const NdfSettings& settings, const RunFolder& folder,
                                     const Progress& progress);

}  // namespace footprint
