// Computes the bin of a direction from its point of the square, and rounds that point within the bin.
#include "methods/atanasov_bins/bins.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/microgeometry/direction_grid.hpp"

namespace footprint::atanasov_bins {
namespace {

constexpr std::uint32_t places = 65536;  // along an axis

// x = 1, or more by rounding, is in the last bin.
std::uint32_t index_along(double x, int m) {
  return static_cast<std::uint32_t>(std::clamp(static_cast<int>(std::floor(x * m)), 0, m - 1));
}

// Places [first, last] are the p with floor(p m / places) equal to the bin.
std::uint32_t place_along(double x, int m) {
  const std::uint32_t bin = index_along(x, m);
  const auto count = static_cast<std::uint32_t>(m);
  const std::uint32_t first = (bin * places + count - 1) / count;
  const std::uint32_t last = ((bin + 1) * places + count - 1) / count - 1;
  const auto place = static_cast<std::uint32_t>(std::clamp(std::floor(x * places), 0.0, places - 1.0));
  return std::clamp(place, first, std::min(last, places - 2));  // places - 1 is reserved for no_normal
}

}  // namespace

std::uint32_t bin_of(const glm::dvec3& direction, int m) {
  const glm::dvec2 point = hemisphere_to_square(direction);
  return index_along(point.y, m) * static_cast<std::uint32_t>(m) + index_along(point.x, m);
}

double bin_solid_angle(int m) { return 2.0 * std::numbers::pi / (static_cast<double>(m) * m); }

std::uint32_t packed_normal(const glm::dvec3& normal, int m) {
  const glm::dvec2 point = hemisphere_to_square(normal);
  return place_along(point.y, m) << 16U | place_along(point.x, m);
}

std::uint32_t bin_of_packed(std::uint32_t packed, int m) {
  const auto count = static_cast<std::uint32_t>(m);
  return ((packed >> 16U) * count >> 16U) * count + ((packed & 0xFFFFU) * count >> 16U);
}

glm::dvec2 place_in_square(std::uint32_t packed) {
  return (glm::dvec2(packed & 0xFFFFU, packed >> 16U) + 0.5) / double{places};
}

glm::dvec3 unpacked_normal(std::uint32_t packed) { return square_to_hemisphere(place_in_square(packed)); }

int bins_across_for(double variance, double share, int most) {
  const double width = share * std::sqrt(std::max(variance, 1e-12));
  const double across = std::sqrt(2.0 * std::numbers::pi) / width;
  const int odd = across >= most ? most : 2 * static_cast<int>(std::ceil(0.5 * (across - 1.0))) + 1;
  return std::clamp(odd, std::min(5, most), most);
}

}  // namespace footprint::atanasov_bins
