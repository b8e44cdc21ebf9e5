// The causes of flicker (docs/metrics.md): the same parts of the picture and the same bound as of errors, over two
// frames.
#pragma once

#include "experiments/studies/reference_view.hpp"

namespace footprint {

/// The causes for a method that rendered `before` and then `picture`.
[[nodiscard]] FlickerCauses flicker_causes(const Image& before, const Image& picture,
                                           const ReferenceView& target_before, const ReferenceView& target,
                                           float exposure);

}  // namespace footprint
