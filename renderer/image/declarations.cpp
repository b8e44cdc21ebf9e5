// Matrices between colour spaces, and copies of pixels to their places.
#include "renderer/image/declarations.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

constexpr Chromaticities rec709{0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3127, 0.329};

// XYZ of luminance 1.
glm::dvec3 xyz_of(double x, double y) { return {x / y, 1.0, (1.0 - x - y) / y}; }

glm::dvec3 white_of(const Chromaticities& c) { return xyz_of(c[6], c[7]); }

// RGB to XYZ: the columns are the primaries, scaled so that their sum is the white.
glm::dmat3 to_xyz(const Chromaticities& c) {
  const auto column = [&](std::size_t i) { return glm::dvec3(c.at(i), c.at(i + 1), 1.0 - c.at(i) - c.at(i + 1)); };
  glm::dmat3 primaries{column(0), column(2), column(4)};
  const glm::dvec3 scale = glm::inverse(primaries) * white_of(c);
  for (int i = 0; i < 3; ++i) primaries[i] *= scale[i];
  return primaries;
}

// Bradford's cone responses, as ICC profiles adapt whites (ICC.1:2022, annex E); glm's columns are rows of the matrix.
glm::dmat3 adaptation(const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dmat3 cones =
      glm::transpose(glm::dmat3{{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}});
  const glm::dvec3 ratio = (cones * to) / (cones * from);
  return glm::inverse(cones) * glm::dmat3{{ratio.x, 0, 0}, {0, ratio.y, 0}, {0, 0, ratio.z}} * cones;
}

bool is_finite(const glm::dmat3& matrix) {
  for (int i = 0; i < 9; ++i) {
    if (!std::isfinite(matrix[i / 3][i % 3])) return false;
  }
  return true;
}

// Little-endian or big-endian numbers of a TIFF; 0 beyond its end.
class TiffNumbers {
 public:
  explicit TiffNumbers(std::string_view bytes) : bytes_(bytes), little_(bytes.starts_with("II")) {}

  [[nodiscard]] std::uint32_t at(std::size_t place, std::size_t size) const {
    if (place > bytes_.size() || bytes_.size() - place < size) return 0;
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t byte = little_ ? size - 1 - i : i;
      value = value << 8U | static_cast<std::uint8_t>(bytes_[place + byte]);
    }
    return value;
  }

 private:
  std::string_view bytes_;
  bool little_;
};

}  // namespace

std::optional<glm::dmat3> rec709_from(const Declarations& declared, const std::string& place) {
  constexpr double tolerance = 2e-3;
  if (!declared.unknown_colors.empty())
    throw Error(ErrorKind::usage, place, declared.unknown_colors, "save it in sRGB, or as an EXR of linear Rec. 709");
  if (declared.xyz) return glm::inverse(to_xyz(rec709));
  const Chromaticities own = declared.chromaticities.value_or(rec709);
  if (std::ranges::equal(own, rec709, [](double a, double b) { return std::abs(a - b) < tolerance; }))
    return std::nullopt;
  const glm::dmat3 adapted = adaptation(white_of(own), white_of(rec709)) * to_xyz(own);
  const glm::dmat3 matrix = glm::inverse(to_xyz(rec709)) * adapted;
  if (is_finite(matrix)) return matrix;
  throw Error(ErrorKind::usage, place, "declares chromaticities that span no colour space",
              "remove them, or save the image in linear Rec. 709");
}

Image oriented(Image stored, int orientation) {
  if (orientation <= 1 || orientation > 8) return stored;
  const bool rows_across = orientation >= 5;  // the first row is the picture's left or right side
  const bool last_first = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
  const bool backwards = orientation == 2 || orientation == 3 || orientation >= 7;
  Image out(rows_across ? stored.height : stored.width, rows_across ? stored.width : stored.height, stored.channels);
  for_each_texel(stored, [&](int x, int y) {
    const int row = last_first ? stored.height - 1 - y : y, column = backwards ? stored.width - 1 - x : x;
    std::ranges::copy(stored.at(x, y), (rows_across ? out.at(row, column) : out.at(column, row)).begin());
  });
  return out;
}

Image placed(const Image& image, const PixelWindow& stored, const PixelWindow& shown) {
  Image out(shown.width, shown.height, image.channels);
  const int left = std::max(stored.x, shown.x), right = std::min(stored.x + stored.width, shown.x + shown.width);
  const int top = std::max(stored.y, shown.y), bottom = std::min(stored.y + stored.height, shown.y + shown.height);
  if (left >= right) return out;
  const auto length = static_cast<std::size_t>(right - left) * static_cast<std::size_t>(image.channels);
  for (int y = top; y < bottom; ++y)
    std::copy_n(image.at(left - stored.x, y - stored.y).data(), length, out.at(left - shown.x, y - shown.y).data());
  return out;
}

int exif_orientation(std::string_view exif) {
  constexpr std::string_view prefix("Exif\0\0", 6);
  constexpr std::size_t entry_size = 12, tag = 0x0112;
  if (exif.starts_with(prefix)) exif.remove_prefix(prefix.size());
  if (!exif.starts_with("II") && !exif.starts_with("MM")) return 1;
  const TiffNumbers numbers(exif);
  const std::size_t directory = numbers.at(4, 4), count = numbers.at(directory, 2);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t entry = directory + 2 + i * entry_size;
    if (numbers.at(entry, 2) != tag) continue;
    const auto orientation = static_cast<int>(numbers.at(entry + 8, 2));
    return orientation >= 1 && orientation <= 8 ? orientation : 1;
  }
  return 1;
}

}  // namespace footprint
