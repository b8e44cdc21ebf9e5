// One method in one view of a run, compared with the reference there, with its frame before and with every other
// method.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/studies/reference_view.hpp"
#include "renderer/pipeline/frame.hpp"

namespace footprint {

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
[[nodiscard]] std::vector<MethodPair> compare_pairs(const std::filesystem::path& folder,
                                                    std::span<const Record> records, std::span<const Image> images,
                                                    std::span<const std::string> names, const ReferenceView& target,
                                                    float exposure);

}  // namespace footprint
