// The methods of a run in one view, compared with its reference and with each other. Images and records are plain
// values.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/settings/run_settings.hpp"
#include "experiments/studies/frame_times.hpp"
#include "experiments/studies/gpu_cost.hpp"
#include "experiments/studies/reference.hpp"
#include "experiments/studies/stage.hpp"
#include "renderer/core/progress.hpp"
#include "renderer/image/image.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// What draws a run's methods, and draws them otherwise to find causes: the same for all views of the run.
struct MethodTools {
  MethodFrames frames;
  std::map<const StagedMethod*, FrameRenderer> dense = {};     ///< of a scene with an environment
  std::map<const StagedMethod*, FrameRenderer> counting = {};  ///< of texture lookups and lobes
  std::optional<GpuCosts> gpu_costs = {};                      ///< none: they are not estimated
};

/// What is wanted of the methods in a view.
struct MethodsWanted {
  ReferenceSettings reference;  ///< the samples of finest levels, and whether errors are separated by cause
  float exposure = 1;
};

/// The methods in one view.
struct MeasuredView {
  std::vector<Image> images;    ///< of each method; empty: it failed
  std::vector<Record> records;  ///< without times and without names of files
  double largest_error = 0;     ///< 99th percentile of the error over pixels, the largest of all methods
};

/// Renders the requested methods in the view that the stage is at, and compares them. A method that fails leaves a
/// record with its reason, except in an animation, which has no frame without all of its methods.
/// Errors (usage) name a pixel whose value is not finite; an interrupt through `progress`.
[[nodiscard]] MeasuredView measure_view(const Stage& stage, MethodTools& tools, const Reference& reference,
                                        const MethodsWanted& wanted, const Progress& progress);

/// The images alone, as measure_view has them.
[[nodiscard]] std::vector<Image> render_methods(const Stage& stage, MethodTools& tools, const Reference& reference);

/// The share of progress that a view's methods take, in samples per pixel.
[[nodiscard]] double methods_weight(std::size_t methods, const ReferenceSettings& settings);

/// Records with nothing but the errors that the reference's noise alone causes.
/// methods: as written.
[[nodiscard]] std::vector<Record> noise_records(std::span<const std::string> methods, const Reference& reference);

/// Sees which of two methods is closer to the reference, pixel by pixel (closer_beyond_noise), and returns the name of
/// the file that shows it.
using VerdictWatch = std::function<std::string(std::size_t first, std::size_t second, const Image& verdicts)>;

/// One entry for every two methods; empty if the reference's noise is unknown, no pixel is interior, or there are more
/// than 24 methods.
[[nodiscard]] std::vector<MethodPair> compare_pairs(const MeasuredView& measured, const Reference& reference,
                                                    float exposure, const VerdictWatch& watch);

}  // namespace footprint
