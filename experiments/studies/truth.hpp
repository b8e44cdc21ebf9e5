// What a comparison knows of one distance besides its methods: the reference and how far it can be trusted, which
// pixels count for what, the bound, and what plain supersampling reaches.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/studies/bound.hpp"
#include "experiments/studies/error_causes.hpp"
#include "experiments/studies/material_pixels.hpp"
#include "experiments/studies/stage.hpp"

namespace footprint {

/// Another reference, of another count of samples.
struct OtherTruth {
  int spp = 1;
  Image mean;
  std::optional<double> noise_floor;
};

/// The pixels that are lit by all of an environment, to tell what the lookup by lobes costs.
struct LightPart {
  std::vector<Tile> tiles;
  Image pixels;  ///< a mask of the interior ones there
};

/// Paths from the output folder, as in RecordImages.
struct TruthFiles {
  std::string reference, standard_error, interior;
};

/// The samples a pixel of methods' finest levels: few suffice, since the reference is drawn with the same ones and what
/// they have in common drops out (docs/metrics.md); all that were asked for, where they were.
[[nodiscard]] int finest_samples(const ReferenceSettings& settings);

/// The mean over `finest_samples`: of the reference, or of a method's finest level, by the same samples.
[[nodiscard]] Image finest_mean(const Supersampler& sampler, const View& view, const ReferenceSettings& settings,
                                const Progress& progress);

/// What is known of one distance.
struct Truth {
  std::size_t frame = 0;
  double distance = 1;
  View view;
  Supersampled reference;  ///< its unresolved pixels uncovered
  Image whole;             ///< its mean with them
  Image first;             ///< its mean over the samples that finest levels are drawn with, without them; or empty
  Image unresolved;        ///< a mask of them
  double samples = 0;      ///< a pixel, mean over the picture
  double seconds = 0;      ///< that the reference took
  std::optional<double> noise_floor, shading_floor;
  PixelParts parts;
  std::vector<Image> materials;  ///< masks of the interior pixels of each material; empty where they are not told apart
  std::optional<BoundPicture> bound;
  LightPart light;  ///< empty without an environment
  TruthFiles files;
  std::vector<SupersamplingPoint> curve;
  std::vector<OtherTruth> others;
  std::vector<std::string> warnings;
};

/// What several comparisons of one scene have in common, distance by distance: the reference, as far as the methods of
/// the first comparison asked for. Its noise is a part of every error that is measured against it, so that errors of
/// different comparisons can be ranked only against the very same one.
struct SharedTruth {
  struct AtDistance {
    double distance = 1;
    Supersampled reference;
    Image begun;         ///< its mean over the samples that it begins with, by which the exposure is chosen
    Image first;         ///< and over those of finest levels
    double samples = 0;  ///< a pixel, mean over the picture; 0: it has those that it begins with, and may need more
    double seconds = 0;  ///< that all of it took
    std::optional<Interior> interior;
  };
  std::vector<AtDistance> distances;

  /// Null where it has none.
  [[nodiscard]] AtDistance* at(double distance);
};

/// Finds it distance by distance. Keeps the addresses of what it is given.
class TruthFinder {
 public:
  /// `exposure` is asked for the factor once the first reference is there, unless it is known. Pictures go to
  /// FOLDER/images. What `shared` has is taken from there, and what it lacks is added: for comparisons of the same
  /// scene, view and reference.
  TruthFinder(const RunSettings& settings, const Stage& stage, std::filesystem::path folder,
              std::function<float(const Image& first_reference)> exposure, ProgressParts& progress,
              SharedTruth* shared = nullptr);

  /// What it weighs in progress, a distance.
  [[nodiscard]] static double weight(const RunSettings& settings);

  /// The exposure is chosen by the first reference, which is that of frame 0, unless it is known before.
  [[nodiscard]] Truth find(std::size_t frame, double distance);

  /// The exposure as it was chosen in another run.
  void set_exposure(float exposure);

  /// Chooses it by the reference's first samples at `first_distance`, where no truth of that one is to be found.
  void choose_exposure(double first_distance);

  /// Why there is no bound, where there is none.
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  void render_reference(Truth& truth, const std::string& prefix);
  [[nodiscard]] SharedTruth::AtDistance& begun_reference(SharedTruth& shared, const Truth& truth,
                                                         const std::string& prefix);
  [[nodiscard]] Image samples_of_finest_levels(const Truth& truth, const Image& whole, const Progress& progress);
  void refine_reference(SharedTruth::AtDistance& begun, const View& view, const Progress& progress);
  [[nodiscard]] double noise_that_tells_apart(const Supersampled& reference, const View& view) const;
  void write_reference(Truth& truth) const;
  void leave_out_unresolved(Truth& truth) const;
  void find_parts(Truth& truth, const std::string& prefix);
  [[nodiscard]] Interior interior_of(const Truth& truth, const Progress& progress) const;
  [[nodiscard]] OtherTruth other_truth(const Truth& truth, int spp, const std::string& prefix);

  const RunSettings& settings_;
  const Stage& stage_;
  std::filesystem::path folder_;
  std::function<float(const Image&)> choose_exposure_;
  ProgressParts& progress_;
  std::optional<float> known_exposure_;
  float exposure_ = 1.0F;
  InteriorFinder interior_finder_;
  std::optional<MaterialFinder> material_finder_;  // where materials are told apart
  std::vector<std::string> warnings_;
  std::optional<StagedMethod> bound_;
  SharedTruth* shared_;
};

}  // namespace footprint
