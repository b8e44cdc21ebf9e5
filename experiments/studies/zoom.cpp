// See zoom.hpp.
#include "experiments/studies/zoom.hpp"

#include <cmath>
#include <cstddef>

namespace footprint {

namespace {

// Nine digits: 4, where the powers give 3.9999999999999996.
double rounded(double value) {
  const double scale = std::pow(10.0, 8.0 - std::floor(std::log10(value)));
  return std::round(value * scale) / scale;
}

}  // namespace

std::vector<double> zoom_distances(double from, double to, int frames) {
  std::vector<double> distances;
  distances.reserve(static_cast<std::size_t>(frames));
  for (int i = 0; i < frames; ++i) {
    distances.push_back(rounded(from * std::pow(to / from, static_cast<double>(i) / (frames - 1))));
  }
  distances.front() = from;
  distances.back() = to;
  return distances;
}

}  // namespace footprint
