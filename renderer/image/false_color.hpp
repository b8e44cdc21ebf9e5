// False colour: a scalar picture on one scale that a reader can compare across pictures.
#pragma once

#include <string>
#include <vector>

#include "renderer/image/image.hpp"

namespace footprint {

/// Maps one channel from [0, maximum] to the "inferno"-like perceptually ordered scale (dark to light); RGB, display
/// values.
[[nodiscard]] Image false_color(const Image& scalar, float maximum);

/// A horizontal legend of the scale, `width` x `height`, labelled 0 and `maximum`.
[[nodiscard]] Image false_color_legend(int width, int height, float maximum);

/// Pictures of one height side by side with a caption under each; RGB display values, 1, 3 or 4 channels taken.
[[nodiscard]] Image labelled_strip(const std::vector<Image>& pictures, const std::vector<std::string>& captions);

}  // namespace footprint
