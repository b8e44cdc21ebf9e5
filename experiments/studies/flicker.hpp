// The flicker of a method from one view of a path to the next, and its causes.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "experiments/studies/reference.hpp"
#include "renderer/image/image.hpp"
#include "renderer/pipeline/supersample.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// The flicker from the frame `before` to `picture`, with that which the references' noise alone causes. None where no
/// pixel is covered wholly in both.
[[nodiscard]] std::optional<Flicker> flicker_between(const Image& before, const Image& picture,
                                                     const Supersampled& reference_before,
                                                     const Supersampled& reference, float exposure);

/// The causes for a method that rendered `before` and then `picture`.
[[nodiscard]] FlickerCauses flicker_causes(const Image& before, const Image& picture, const Reference& target_before,
                                           const Reference& target, float exposure);

/// The view before, against which flicker is measured.
struct FrameBefore {
  Reference reference;
  std::vector<Image> images{};  ///< of each method; empty: it failed
};

/// Adds the flicker since `before` to the records of the methods that have an image in both views.
/// images: of each method, in the view of `reference`.
void add_flicker(std::span<Record> records, const FrameBefore& before, std::span<const Image> images,
                 const Reference& reference, float exposure);

}  // namespace footprint
