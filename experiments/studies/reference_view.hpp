// One view of a run. The part besides its methods: the reference and its noise, which pixels count for what, the bound
// (the image of `exact`, which no method can beat under the same footprint filter), and what plain supersampling
// reaches (docs/reference/metrics.md). And one method in it, compared with the reference, with its frame before and
// with every other method (method_record.cpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "experiments/studies/stage.hpp"
#include "experiments/studies/view_path.hpp"
#include "renderer/core/run_folder.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/image/image.hpp"
#include "renderer/pipeline/interior.hpp"
#include "renderer/pipeline/supersample.hpp"
#include "renderer/pipeline/view.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// The object pixels of a reference by where errors come from. Masks have one channel, 1 or 0.
struct PixelParts {
  Image interior;  ///< one smooth piece of surface: what methods are ranked over
  Image edges;     ///< all others
  PixelCounts counts = {};
};

/// `reference` is the mean of the samples that `interior` was found with.
[[nodiscard]] PixelParts pixel_parts(const Image& reference, const Interior& interior);

/// The image of `exact`, and where it was rendered.
struct BoundPicture {
  Image picture;  ///< RGBA
  Image pixels;   ///< a mask of the interior pixels in which it was drawn, and is finite
};

/// E of a method's picture over the parts, `causes.light` aside. Filter and method are over the pixels of the bound;
/// null: it was not drawn.
[[nodiscard]] ErrorCauses error_causes(const Image& picture, const Image& reference, const BoundPicture* bound,
                                       const PixelParts& parts, float exposure);

/// The standard error that the reference's noise gives E(picture, reference) over `mask`, from the reference's two
/// halves: half of the difference of a pixel's errors against them has the deviation of its error against the whole.
/// Errors of two methods that differ by several of it differ by more than noise. None where no pixel counts.
[[nodiscard]] std::optional<double> error_noise(const Image& picture, const std::pair<Image, Image>& halves,
                                                float exposure, const Image& mask);

/// `picture` with the coverage of the reference, to take its place: the reference decides which pixels count.
[[nodiscard]] Image as_reference(Image picture, const Image& reference);

/// E between two pictures of methods over a mask, `other` in place of the reference.
[[nodiscard]] std::optional<double> error_between(const Image& picture, const Image& other, const Image& reference,
                                                  float exposure, const Image& mask);

/// The edge of the squares in which the bound is drawn where it is not drawn whole, and of those that are lit by all of
/// an environment, pixels.
inline constexpr int bound_tile = 32, light_tile = 8;

/// The lights of a scene; facets are shaded for each.
struct BoundLights {
  std::size_t lights = 0;
  bool environment = false;
};

/// The cost of `exact` for a pixel whose footprint's longer edge spans `texels`, in facets shaded for one light: those
/// under the four texels of each of two levels, as a trilinear filter blends them, up to 128 x 128 per level. Of facets
/// that an environment lights there are less (methods/exact), and each costs what 50 do.
[[nodiscard]] double estimated_exact_cost(double texels, const BoundLights& lights);

/// The cost of a pixel; column, row.
using PixelCost = std::function<double(int, int)>;

/// The total cost of the object pixels of a part of the image.
[[nodiscard]] double cost_of(const Tile& tile, const PixelParts& parts, const PixelCost& cost);

/// Squares of the picture, `edge` pixels per side, whose object pixels cost at most `most`, in a fixed order that
/// spreads them over the image. `parts`: for the object pixels.
[[nodiscard]] std::vector<Tile> cheap_parts(const PixelParts& parts, int edge, const PixelCost& cost, double most);

/// Takes out of a mask the pixels at which a value of the image is not finite.
void leave_out_infinite(const Image& picture, Image& mask);

/// The mask's pixels in the tiles.
[[nodiscard]] Image within(const Image& mask, std::span<const Tile> tiles);

/// The normalised colour error that the reference's noise alone causes; none with fewer than two passes, or where the
/// object covers no whole pixel.
/// mask: as normalized_color takes it.
[[nodiscard]] std::optional<double> noise_floor(const Supersampled& reference, float exposure, const Image& mask = {});

/// A picture that was drawn with few samples, as it would be with as many as `converged` has: what it differs by from
/// `same`, which the reference drew with the picture's own samples, is added to `converged` (a control variate: the
/// noise that both have drops out). RGBA of one size; covered as `converged` is; no channel below 0.
[[nodiscard]] Image as_converged(const Image& picture, const Image& same, const Image& converged);

/// The flicker from the frame `before` to `picture`, with that which the references' noise alone causes. None where no
/// pixel is covered wholly in both.
[[nodiscard]] std::optional<Flicker> flicker_between(const Image& before, const Image& picture,
                                                     const Supersampled& reference_before,
                                                     const Supersampled& reference, float exposure);

/// When a reference is good enough.
struct Convergence {
  double noise = 0;  ///< of each tile: normalised colour error, as `noise_floor`
  float exposure = 1;
  int spp_max = 4096;
  double max_extra_work = 3;  ///< most further samples, over those that the image has already; above 0
};

/// Tiles of 128 x 128 pixels whose noise floor, unresolved pixels left out, is above `noise` are rendered again with
/// four times the samples, repeatedly, the noisiest first. Each tile equals that part of an image of as many samples.
/// The choice of tiles depends on the first image only, not on time. Returns the mean samples per pixel in the end.
double converge(const Supersampler& sampler, Supersampled& picture, const View& view, std::uint64_t seed,
                const Convergence& wanted, const Progress& progress);

/// Another reference, of another count of samples.
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

/// The samples per pixel of methods' finest levels. Few suffice, because the reference uses the same ones and their
/// common noise cancels (docs/reference/metrics.md); a fixed number is used as it is.
[[nodiscard]] int finest_samples(const ReferenceSettings& settings);

/// The mean over `finest_samples`: of the reference, or of a method's finest level, by the same samples.
[[nodiscard]] Image finest_mean(const Supersampler& sampler, const View& view, const ReferenceSettings& settings,
                                const Progress& progress);

/// A reference as it is rendered.
struct RenderedReference {
  Supersampled reference;
  Image first;         ///< its mean over the samples that finest levels are drawn with; or empty
  double samples = 0;  ///< per pixel, mean over the image; 0: it has its first samples, and may need more
  double seconds = 0;  ///< that all of it took
};

/// The reference of one view, its unresolved pixels uncovered, with its masks, bound and curve.
struct ReferenceView : RenderedReference {
  std::size_t index = 0;  ///< of the view in the run
  RunView at;
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
  RecordImages files;                      ///< reference, standard_error and interior
  std::vector<SupersamplingPoint> curve;
  std::vector<OtherReferenceImage> others;
  std::vector<std::string> warnings;
};

/// The references that several comparisons of one scene and reference share, view by view. A reference's
/// noise is a part of every error that is measured against it, so errors of different comparisons can be ranked only
/// against the very same reference.
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

/// Renders the references of a run, and moves the stage to their views. Keeps the addresses of its arguments.
class ReferenceRenderer {
 public:
  /// folder: images go to its images/.
  /// shared: references are taken from here and added here; null: every reference is rendered.
  ReferenceRenderer(const RunSettings& settings, Stage& stage, RunFolder folder, ProgressParts& progress,
                    SharedReferences* shared = nullptr);

  /// The share of progress that a view takes.
  [[nodiscard]] static double weight(const RunSettings& settings);

  /// The first samples of the reference in the run's first view, from which an exposure is chosen.
  [[nodiscard]] const Image& first_samples(const RunView& first);

  /// Everything about one view; writes its images.
  [[nodiscard]] ReferenceView find(std::size_t index, const RunView& at, float exposure);

  /// As much of it as flicker is measured against; writes nothing.
  [[nodiscard]] ReferenceView render(std::size_t index, const RunView& at, float exposure);

  /// Why there is no bound, if there is none.
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  [[nodiscard]] std::string prefix_of(std::size_t index, const RunView& at) const;
  [[nodiscard]] SharedReferences::OfView& begun_reference(const RunView& at, const View& view,
                                                          const std::string& prefix);
  [[nodiscard]] Image samples_of_finest_levels(const View& view, const Image& whole, const Progress& progress);
  void refine_reference(SharedReferences::OfView& begun, const View& view, const Progress& progress);
  [[nodiscard]] double noise_wanted(const SharedReferences::OfView& begun, const View& view);
  [[nodiscard]] double noise_that_separates(const Supersampled& reference, const View& view) const;
  void write_files(ReferenceView& target) const;
  void leave_out_unresolved(ReferenceView& target) const;
  void find_parts(ReferenceView& target);
  [[nodiscard]] Interior interior_of(const ReferenceView& target, const Progress& progress) const;
  [[nodiscard]] OtherReferenceImage other_reference(const ReferenceView& target, int spp, const std::string& prefix);

  const RunSettings& settings_;
  Stage& stage_;
  RunFolder folder_;
  ProgressParts& progress_;
  float exposure_ = 1.0F;  // of the view that is rendered
  InteriorFinder interior_finder_;
  std::vector<std::string> warnings_;
  std::optional<StagedMethod> bound_;
  SharedReferences own_;  // of the view that is rendered, if nothing is shared
  SharedReferences* shared_;
};

/// Fills records. Stores what a method needs to be drawn otherwise for all views.
class MethodMeasurer {
 public:
  /// Stores the stage's address.
  explicit MethodMeasurer(const Stage& stage) : stage_(stage) {}

  /// The row of a method that has no figures, for the reason given.
  [[nodiscard]] Record failed(const StagedMethod& method, const ReferenceView& target, const Error& why) const;

  /// Measures the method before it is timed or compared with other frames.
  /// frame: an image of the method.
  /// finest: its finest level, supersampled, as converged as the reference; none: the errors that need it are left out,
  /// and so is that of the environment's lookup.
  /// Errors (usage) name a pixel whose value is not finite.
  [[nodiscard]] Record measure(const StagedMethod& method, const Image& frame, const std::optional<Image>& finest,
                               const ReferenceView& target, float exposure);

  /// Counts the texture lookups and lobes per pixel, except of methods whose frames take seconds: counting takes as
  /// long.
  void count_work(Record& record, const StagedMethod& method, const View& view);

 private:
  void set_light_error(Record& record, const ReferenceView& target, const Image& picture, const StagedMethod& method,
                       float exposure);

  const Stage& stage_;
  std::map<const StagedMethod*, FrameRenderer> dense_frames_;  // of a scene with an environment
  std::map<const StagedMethod*, FrameRenderer> counting_;
};

/// The causes for a method that rendered `before` and then `picture`.
[[nodiscard]] FlickerCauses flicker_causes(const Image& before, const Image& picture,
                                           const ReferenceView& target_before, const ReferenceView& target,
                                           float exposure);

/// One entry for every two methods of one distance, with its image in FOLDER/images; empty if the reference's noise is
/// unknown, no pixel is interior, or there are more than 24 methods.
/// records, images, names: of each method; a failed method has no image. `names` are parts of file names.
[[nodiscard]] std::vector<MethodPair> compare_pairs(const RunFolder& folder, std::span<const Record> records,
                                                    std::span<const Image> images, std::span<const std::string> names,
                                                    const ReferenceView& target, float exposure);

}  // namespace footprint
