// One method in one view of a run, compared with what is known there.
#pragma once

#include <map>
#include <optional>

#include "experiments/studies/reference_view.hpp"
#include "renderer/pipeline/frame.hpp"

namespace footprint {

/// The images of a method that are measured.
struct MethodPictures {
  Image frame;  ///< one frame
  /// The method's finest level, supersampled, as converged as the reference; none: the errors that need it are
  /// left out, and so is that of the environment's lookup.
  std::optional<Image> finest;
};

/// Fills records. Stores what a method needs to be drawn otherwise for all views.
class MethodMeasurer {
 public:
  /// Stores the stage's address.
  explicit MethodMeasurer(const Stage& stage) : stage_(stage) {}

  /// The row of a method that has no figures, for the reason given.
  [[nodiscard]] Record failed(const StagedMethod& method, const ReferenceView& target, const Error& why) const;

  /// Measures the method before it is timed or compared with other frames. Errors (usage) name a pixel whose value is
  /// not finite.
  [[nodiscard]] Record measure(const StagedMethod& method, const MethodPictures& pictures, const ReferenceView& target,
                               float exposure);

  /// Counts the texture lookups and lobes per pixel, except of methods whose frames take seconds: counting takes as
  /// long.
  void count_work(Record& record, const StagedMethod& method, const View& view);

 private:
  [[nodiscard]] Record described(const StagedMethod& method, const ReferenceView& target) const;
  void set_light_error(Record& record, const ReferenceView& target, const Image& picture, const StagedMethod& method,
                       float exposure);

  void set_material_errors(Record& record, const ReferenceView& target, const Image& picture,
                           const StagedMethod& method, float exposure) const;

  const Stage& stage_;
  std::map<const StagedMethod*, FrameRenderer> dense_frames_;  // of a scene with an environment
  std::map<const StagedMethod*, FrameRenderer> counting_;
};

}  // namespace footprint
