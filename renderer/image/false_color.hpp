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

/// The font that captions are set in: DejaVu Sans, Debian package fonts-dejavu-core.
inline constexpr const char* caption_font = "DejaVuSans";

/// Width in pixels of one line of `text` at a nominal height of `size` pixels.
/// Throws Error (machine): the font is not installed.
[[nodiscard]] int text_width(const std::string& text, int size, const std::string& font = caption_font);

/// Draws white `text`, centred on column `x` and row `y`, into a 3-channel image of display values, clipped to the
/// image. Throws Error (machine): the font is not installed.
void draw_text(Image& picture, int x, int y, const std::string& text, int size, const std::string& font = caption_font);

}  // namespace footprint
