// The reference of a view: its image and noise, which pixels count for what, the bound, and what plain supersampling
// reaches (docs/reference/metrics.md).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/settings/run_settings.hpp"
#include "experiments/studies/pixel_parts.hpp"
#include "experiments/studies/stage.hpp"
#include "experiments/studies/view_path.hpp"
#include "renderer/core/progress.hpp"
#include "renderer/image/image.hpp"
#include "renderer/pipeline/interior.hpp"
#include "renderer/pipeline/supersample.hpp"
#include "renderer/pipeline/view.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// A picture that was drawn with few samples, as it would be with as many as `converged` has: what it differs by from
/// `same`, which the reference drew with the picture's own samples, is added to `converged` (a control variate: the
/// noise that both have drops out). RGBA of one size; covered as `converged` is; no channel below 0.
[[nodiscard]] Image as_converged(const Image& picture, const Image& same, const Image& converged);

/// The samples per pixel of methods' finest levels. Few suffice, because the reference uses the same ones and their
/// common noise cancels (docs/reference/metrics.md); a fixed number is used as it is.
[[nodiscard]] int finest_samples(const ReferenceSettings& settings);

/// The mean over `finest_samples`: of the reference, or of a method's finest level, by the same samples.
[[nodiscard]] Image finest_mean(const Supersampler& sampler, const View& view, const ReferenceSettings& settings,
                                const Progress& progress);

/// A reference of another count of samples.
struct OtherReferenceImage {
  int spp = 1;
  Image mean;
  std::optional<double> noise_floor;
};

/// The pixels that are lit by all of an environment, for the error of the lookup by lobes.
struct LightPart {
  std::vector<Tile> tiles;
  Image pixels;  ///< a mask of the interior ones there
};

/// A reference as it is rendered.
struct RenderedReference {
  Supersampled reference;
  Image first;         ///< its mean over the samples that finest levels are drawn with; or empty
  double samples = 0;  ///< per pixel, mean over the image; 0: it has its first samples, and may need more
  double seconds = 0;  ///< that all of it took
};

/// The reference of one view, its unresolved pixels uncovered, and what is found on it.
struct Reference : RenderedReference {
  PlannedView place;
  View view;
  Image whole;                         ///< the mean with unresolved pixels
  Image unresolved;                    ///< a mask of them
  std::optional<double> wanted_noise;  ///< noise floor that it was refined to; none: it was not refined
  std::optional<double> noise_floor, shading_floor;
  PixelParts parts;
  std::vector<Image> materials;  ///< masks of the interior pixels of each material; empty if they are not separated
  std::optional<BoundPicture> bound;
  LightPart light;                         ///< empty without an environment
  std::optional<double> highlight_energy;  ///< of the reference
  std::vector<SupersamplingPoint> curve;   ///< of plain supersampling
  std::vector<OtherReferenceImage> others;
  std::vector<std::string> warnings;
};

/// The references that comparisons of one scene and reference share, view by view. A reference's noise is a part of
/// every error that is measured against it, so errors of different comparisons can be ranked only against the very same
/// reference.
struct SharedReferences {
  struct OfView : RenderedReference {
    RunView at;
    Image begun;  ///< its mean over its first samples, by which the exposure is chosen
    std::optional<Interior> interior;
  };
  std::vector<OfView> views;
  std::map<RunView, double> wanted_noise;  ///< the noise floor that the first comparison needs

  /// Null if there is none.
  [[nodiscard]] OfView* of(const RunView& at);
};

/// What finds the parts of references, ready to draw: the same for all views of a run.
struct ReferenceTools {
  InteriorFinder interior;
  std::optional<StagedMethod> bound;  ///< none: no bound is drawn
  std::vector<std::string> warnings;  ///< why
};

[[nodiscard]] ReferenceTools reference_tools(const Stage& stage, BoundUse bound);

/// What is wanted of a reference.
struct ReferenceWanted {
  ReferenceSettings settings;
  bool by_material = false;  ///< separate the materials' pixels
  float exposure = 1;

  /// A copy without what only the records of its own view need: supersampling's curve, and other references.
  [[nodiscard]] ReferenceWanted for_flicker() const;
};

/// Renders the first samples of a view's reference, which depend neither on methods nor on the exposure, unless
/// `shared` has them.
SharedReferences::OfView& begin_reference(Stage& stage, const PlannedView& place, const ReferenceSettings& settings,
                                          SharedReferences& shared, const Progress& progress);

/// Moves the stage to a view and renders its reference, or takes it from `shared`, where it stays.
/// Errors: as Stage::move_to; machine; an interrupt through `progress`.
[[nodiscard]] Reference render_reference(Stage& stage, const ReferenceTools& tools, const PlannedView& place,
                                         const ReferenceWanted& wanted, SharedReferences& shared,
                                         const Progress& progress);

/// The share of progress that a reference takes, in samples per pixel.
[[nodiscard]] double reference_weight(const ReferenceSettings& settings);

}  // namespace footprint
