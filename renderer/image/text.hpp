// Captions in pictures. ASCII: OpenImageIO 2.4 draws other characters of UTF-8 wrong.
#pragma once

#include <string>

#include "renderer/image/image.hpp"

namespace footprint {

/// The font that captions are set in: DejaVu Sans, Debian package fonts-dejavu-core.
inline constexpr const char* caption_font = "DejaVuSans";

/// Width in pixels of one line of `text` at a nominal height of `size` pixels.
/// Errors (machine): the font is not installed.
[[nodiscard]] int text_width(const std::string& text, int size, const std::string& font = caption_font);

/// Draws white `text`, centred on column `x` and row `y`, over a 3-channel picture of display values; what falls
/// outside the picture is left out. Errors (machine): the font is not installed.
void draw_text(Image& picture, int x, int y, const std::string& text, int size, const std::string& font = caption_font);

}  // namespace footprint
