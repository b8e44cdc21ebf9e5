// Edits of a scene's small-scale geometry: parameters change every frame, and each stage up to the picture is timed.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "experiments/settings/run_settings.hpp"
#include "renderer/core/progress.hpp"
#include "renderer/core/run_folder.hpp"
#include "renderer/microgeometry/microgeometry.hpp"
#include "renderer/microgeometry/patch.hpp"
#include "renderer/scene/scene.hpp"
#include "results/report/command_reports.hpp"

namespace footprint {

/// A parameter that changes from frame to frame, as `--set KIND.PARAMETER=FROM:TO` writes it: from `from` in the first
/// frame to `to` in the last; words are the same in both. Kind `brdf` is the base BRDF, others are small-scale
/// geometry.
struct ParameterSweep {
  std::string kind, parameter;
  std::string from, to;
};

/// Reads `weave.warp_width=0.1:0.5`, or `weave.warp_width=0.3` for one value in all frames. Errors (usage): not that
/// form, an unknown kind or parameter with the nearest right one, a value that the parameter does not take.
[[nodiscard]] ParameterSweep parse_sweep(const std::string& text);

/// Errors (usage): a sweep of another kind than `brdf` and `kind`, a parameter set twice.
/// kind: of the scene's small-scale geometry; null: it has none.
void check_sweeps(std::span<const ParameterSweep> sweeps, const PatchKind* kind);

/// The values of the parameters of one kind in frame `frame` of `frames` >= 1, at equal steps; whole numbers are
/// rounded.
[[nodiscard]] std::map<std::string, std::string> values_at(std::span<const ParameterSweep> sweeps,
                                                           const std::string& kind, int frame, int frames);

/// The settings of `footprint edit`.
struct EditSettings {
  RunSettings run;                          ///< with one method; ignores reference, timing and cache
  std::vector<ParameterSweep> sweeps = {};  ///< one or more
  int frames = 10;                          ///< 1 or more
};

/// Renders frame by frame and writes FOLDER/images/METHOD_NNNN, .exr and .png. Nothing is taken from a cache: a frame's
/// times are those of its own work; the first frame is drawn once before it is timed, as programs are compiled when
/// they are first used. The result lacks tool and backend.cpu, which the program knows. Errors: of scene, sweeps,
/// method and settings (usage; also a sweep over small-scale geometry that the scene does not generate), of the
/// machine, an interrupt through `progress`.
[[nodiscard]] EditRun run_edit(const EditSettings& settings, const RunFolder& folder, const Progress& progress);

/// The two tables between which an edit goes.
struct MeasuredPair {
  TabulatedBrdf from, to;
};

/// Sets parameters of the base BRDF of all materials.
/// values: by name: roughness, exponent, alpha, kappa, specular, metallic, and the share of the second measured table.
/// tables: needed for `measured` alone; else null.
/// Errors (usage): a parameter that a material does not have: another distribution, a value from a map, lobes of its
/// own, or `measured` without small-scale geometry.
void set_brdf(const std::map<std::string, std::string>& values, const MeasuredPair* tables, Scene& scene);

}  // namespace footprint
