// What an image file declares about its texels, in the same form for every format, and what that does to them.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/image/image.hpp"

namespace footprint {

/// A rectangle of pixels. Rows run down.
struct PixelWindow {
  int x = 0, y = 0;  ///< its top left pixel
  int width = 0, height = 0;

  friend bool operator==(const PixelWindow&, const PixelWindow&) = default;
};

/// CIE 1931 chromaticities of a colour space: x and y of red, green, blue and white.
using Chromaticities = std::array<double, 8>;

/// The declarations of a file. The defaults are those of a picture that declares nothing.
struct Declarations {
  PixelWindow stored, shown;    ///< the pixels in the file, and the picture (EXR's data and display windows)
  int orientation = 1;          ///< EXIF's, 1 to 8: which sides of the picture the first row and column are
  bool floats = false;          ///< stores linear floats of any size, not integers that mean 0 to 1
  bool associated = false;      ///< colours are already multiplied by alpha
  std::optional<double> gamma;  ///< integers are light to this power; none: sRGB's curve
  std::optional<Chromaticities> chromaticities;  ///< none: Rec. 709's
  bool xyz = false;                              ///< colours are CIE XYZ
  glm::dvec3 factors{1.0};            ///< stored values over radiance, per channel (Radiance's EXPOSURE, COLORCORR)
  std::string profile;                ///< the name of an ICC profile; empty: none
  std::string unknown_colors;         ///< why colours cannot be converted, such as "declares ..."; empty: they can
  std::vector<std::string> left_out;  ///< what is not read, one line each, without the file's name
};

/// The declared colours, once linear, to Rec. 709; none if they are Rec. 709 (chromaticities to 0.002). Another white
/// becomes Rec. 709's by Bradford's adaptation, except that of XYZ, which stays. Throws Error (usage) at `place`: the
/// chromaticities span no colour space, or colours cannot be converted.
[[nodiscard]] std::optional<glm::dmat3> rec709_from(const Declarations& declared, const std::string& place);

/// The picture of a stored image whose first row and column are at the sides that EXIF's `orientation` names.
[[nodiscard]] Image oriented(Image stored, int orientation);

/// The picture `shown` of an image that stores the pixels `stored`. Pixels that it does not store are 0.
[[nodiscard]] Image placed(const Image& image, const PixelWindow& stored, const PixelWindow& shown);

/// The orientation in EXIF data, which begins with a TIFF header, or with "Exif" before it; 1 if there is none.
[[nodiscard]] int exif_orientation(std::string_view exif);

}  // namespace footprint
