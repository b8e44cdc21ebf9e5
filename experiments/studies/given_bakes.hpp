// The maps that a run takes from folders of `footprint bake`, in place of bakes of its own.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "renderer/baked_files/bake_folder.hpp"
#include "renderer/core/options.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint {

/// The one of the folders that has the maps of a method with its options; none.
/// Throws Error (usage): as read_manifest.
[[nodiscard]] std::optional<BakeFolder> given_bake(std::span<const std::filesystem::path> folders,
                                                   const MethodSpec& method);

/// Checks all folders of a run, before anything is drawn.
/// effects: of the run.
/// Throws Error (usage): a folder has the maps of none of the run's methods, two have those of one, or as
/// BakeFolder::require_fit.
void require_given_bakes(std::span<const std::filesystem::path> folders, std::span<const MethodSpec> methods,
                         const Scene& scene, const EffectSet& effects);

/// A hash of all maps that are given; empty without any. Throws Error (usage): as BakeFolder::content.
[[nodiscard]] std::string hash_given_bakes(std::span<const std::filesystem::path> folders);

}  // namespace footprint
