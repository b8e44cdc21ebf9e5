// The header of a Radiance HDR file: orders of pixels, exposure and colours.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "renderer/image/declarations.hpp"

namespace footprint {

/// The header of a Radiance HDR file.
struct RadianceHeader {
  int width = 0, height = 0;  ///< pixels per scanline, scanlines; of the picture if `declared.orientation` is 1 to 4
  std::size_t size = 0;       ///< bytes of the header
  Declarations declared;
};

/// The largest header that is read, in bytes.
inline constexpr std::size_t largest_radiance_header = 65536;

/// Reads the header at the beginning of `bytes`. Several EXPOSURE or COLORCORR multiply. Throws Error (usage): no end
/// of the header, no valid line of its size, another format than RGBE and XYZE, a factor that is not above 0.
[[nodiscard]] RadianceHeader read_radiance_header(std::string_view bytes, const std::string& name);

/// The header of an RGBE file of that size in the usual order, which declares nothing else.
[[nodiscard]] std::string plain_radiance_header(const RadianceHeader& header);

}  // namespace footprint
