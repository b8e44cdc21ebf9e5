// False colour on one scale that a reader can compare across images, and captions.
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

/// Images of one height side by side, each with a caption below; RGB display values. Accepts 1, 3 or 4 channels.
[[nodiscard]] Image labelled_strip(const std::vector<Image>& pictures, const std::vector<std::string>& captions);

/// Finds the font that captions are set in, DejaVu Sans: the file FOOTPRINT_FONT if that is set, else DejaVuSans.ttf in
/// a folder of OPENIMAGEIO_FONTS or where distributions install it (Debian's package fonts-dejavu-core). Empty: there
/// is none, and pictures have no captions.
[[nodiscard]] std::string find_caption_font();

/// Width in pixels of one line of `text` at a nominal height of `size` pixels; 0 without a font.
[[nodiscard]] int text_width(const std::string& text, int size);

/// Draws white `text`, centred on column `x` and row `y`, into a 3-channel image of display values, clipped to the
/// image. Draws nothing without a font.
void draw_text(Image& picture, int x, int y, const std::string& text, int size);

}  // namespace footprint
