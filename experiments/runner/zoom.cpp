// See zoom.hpp.
#include "experiments/runner/zoom.hpp"

#include <cmath>

namespace footprint {

std::vector<double> zoom_distances(double from, double to, int frames) {
  std::vector<double> distances;
  for (int i = 0; i < frames; ++i) {
    distances.push_back(from * std::pow(to / from, static_cast<double>(i) / (frames - 1)));
  }
  distances.back() = to;  // to the last digit
  return distances;
}

}  // namespace footprint
