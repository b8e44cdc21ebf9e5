// v_grooves: parallel V-shaped grooves of random width and one steepness, so that there are exactly two normals.
#include <algorithm>
#include <cmath>

#include "renderer/core/numbers.hpp"
#include "scenes/surfaces/meshes.hpp"
#include "scenes/surfaces/texel_grid.hpp"

namespace footprint::surfaces::v_grooves {
namespace {

/// The ends of the grooves along x, rising to 1; widths within 1 - `variation` to 1 + `variation` of their mean.
std::vector<double> groove_ends(int count, double variation, std::uint32_t seed) {
  std::mt19937_64 random(seed);
  std::vector<double> ends;
  double end = 0.0;
  for (int i = 0; i < count; ++i) {
    end += 1.0 + variation * (2.0 * uniform(random) - 1.0);
    ends.push_back(end);
  }
  for (double& x : ends) x /= end;
  return ends;
}

Image normals(const SurfaceSettings& settings) {
  const Options& parameters = settings.parameters;
  const std::vector<double> ends =
      groove_ends(static_cast<int>(parameters.number("count")), parameters.number("variation"), settings.seed);
  const double tilt = glm::radians(parameters.number("tilt_degrees"));
  const glm::dvec3 falling{std::sin(tilt), 0.0, std::cos(tilt)}, rising{-falling.x, 0.0, falling.z};
  return fill_normals(settings.resolution, [&](const glm::dvec2& uv) {
    const auto end = std::ranges::upper_bound(ends, uv.x);
    const double start = end == ends.begin() ? 0.0 : *(end - 1);
    return uv.x - start < *end - uv.x ? falling : rising;
  });
}

}  // namespace

Surface surface() {
  return {.name = "v_grooves",
          .summary = "parallel V-shaped grooves of random width: exactly two normals",
          .parameters = {whole_option("count", 16, 1, 4096, "grooves along the map's width"),
                         number_option("tilt_degrees", 30.0, 0, 89, "tilt of both facets, degrees"),
                         number_option("variation", 0.5, 0, 0.9,
                                       "how much the grooves' widths differ from their mean, as a share of it")},
          .normals = normals,
          .mesh = square_mesh};
}

}  // namespace footprint::surfaces::v_grooves
