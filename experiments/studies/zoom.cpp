// Equal ratios of distance, and what counts where an end of a zoom is left open.
#include "experiments/studies/zoom.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

constexpr double default_zoom = 8.0;

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

std::vector<double> given_distances(const ViewSettings& view) {
  const ZoomSettings& zoom = view.zoom;
  if (zoom.frames == 0) return view.distances;
  if (!zoom.from || !zoom.to) return {};
  return zoom_distances(*zoom.from, *zoom.to, zoom.frames);
}

std::vector<double> run_distances(const ViewSettings& view, const Scene& scene) {
  const ZoomSettings& zoom = view.zoom;
  if (zoom.frames == 0) return view.distances.empty() ? scene.distances : view.distances;
  const double from = zoom.from.value_or(scene.distances.front());
  const double last = scene.distances.size() > 1 ? scene.distances.back() : default_zoom * from;
  const double to = zoom.to.value_or(last);
  if (from == to) {
    throw Error(ErrorKind::usage, "--to", fmt::format("the zoom ends at {:g}, where it starts", to),
                "let --from and --to differ");
  }
  return zoom_distances(from, to, zoom.frames);
}

}  // namespace footprint
