// footprint_em_library_ratio: the CPU time of Tan's mixtures over a map against that of Armadillo's EM for Gaussian
// mixtures, run texel by texel on the same normals. Built where Armadillo's headers are; no part of the checks.
#define ARMA_DONT_USE_WRAPPER  // headers alone: a diagonal mixture needs no LAPACK
#define ARMA_DONT_USE_HDF5
#include <armadillo>
#include <cstdio>
#include <ctime>
#include <exception>
#include <string>

#include "methods/tan_gmm/mixture_chain.hpp"
#include "scenes/surfaces/registry.hpp"

namespace footprint::bench {
namespace {

constexpr int resolution = 512;
constexpr int fewest_samples = 16;  // a texel; with four Gaussians the library has little to fit below

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

// Ours, aligned: seconds of the levels whose texels cover enough normals, and of all.
struct Ours {
  double same_levels = 0, all_levels = 0;
};

Ours time_ours(const tan_gmm::NormalField& normals) {
  Ours ours;
  const double start = cpu_seconds();
  const std::string first_left_out = std::to_string(resolution / 2) + " x";
  (void)tan_gmm::mixture_chain(normals, {}, tan_gmm::Moment::corrected, [&](std::string_view what, double) {
    if (what.find(first_left_out) == std::string_view::npos || ours.same_levels > 0) return;
    ours.same_levels = cpu_seconds() - start;
  });
  ours.all_levels = cpu_seconds() - start;
  return ours;
}

// Starts and steps as ours at most takes: clusters by 4 steps, 40 steps of EM, the floor of the variance. The library
// ends early only where nothing changes.
double time_library(const tan_gmm::NormalField& normals) {
  double seconds = 0;
  for (int size = 1; resolution * resolution / (size * size) >= fewest_samples; size *= 2) {
    for (int texel = 0; texel < size * size; ++texel) {
      tan_gmm::Samples samples;
      normals.gather(size, size, texel % size, texel / size, samples);
      const double start = cpu_seconds();
      arma::mat points(2, samples.size());
      for (std::size_t i = 0; i < samples.size(); ++i) {
        points(0, i) = static_cast<double>(samples.x[i]);
        points(1, i) = static_cast<double>(samples.y[i]);
      }
      arma::gmm_diag model;
      (void)model.learn(points, 4, arma::eucl_dist, arma::static_spread, 4, 40, tan_gmm::variance_floor, false);
      seconds += cpu_seconds() - start;
    }
  }
  return seconds;
}

void print_ratios() {
  (void)std::printf("%-12s %16s %16s %16s %8s\n", "surface", "library, s", "ours, same, s", "ours, all, s", "ratio");
  for (const Surface& surface : all_surfaces()) {
    SurfaceSettings map = surface_settings(surface, {});
    map.resolution = resolution;
    const tan_gmm::NormalField normals(surface_normals(surface, map));
    const Ours ours = time_ours(normals);
    const double library = time_library(normals);
    (void)std::printf("%-12s %16.2f %16.3f %16.3f %8.1f\n", surface.name.c_str(), library, ours.same_levels,
                      ours.all_levels, library / ours.same_levels);
    (void)std::fflush(stdout);
  }
}

}  // namespace
}  // namespace footprint::bench

int main() {
  try {
    footprint::bench::print_ratios();
    return 0;
  } catch (const std::exception& error) {
    (void)std::fprintf(stderr, "footprint_em_library_ratio: %s\n", error.what());
    return 3;
  }
}
