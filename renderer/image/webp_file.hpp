// WebP images by libwebp, because OpenImageIO multiplies their colours by alpha.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "renderer/image/declarations.hpp"

namespace footprint {

/// The header of a WebP.
struct WebpHeader {
  int width = 0, height = 0, channels = 0;  ///< 3, or 4 with alpha
  Declarations declared;
};

/// Reads the header of the encoded bytes. Throws Error (usage): damaged, or an animation.
[[nodiscard]] WebpHeader read_webp_header(std::span<const std::uint8_t> bytes, const std::string& name);

/// The texels, 0 to 1, with colours as stored under any alpha. Throws Error (usage): truncated or damaged.
[[nodiscard]] Image decode_webp(std::span<const std::uint8_t> bytes, const WebpHeader& header, const std::string& name);

}  // namespace footprint
