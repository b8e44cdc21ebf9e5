// Adds each probe's bilinear weights at two mip levels, in texels of the finest.
#include "tests/support/filter_kernel.hpp"

#include <algorithm>
#include <cmath>

namespace footprint::testing {
namespace {

int wrapped(double texel, int size) {
  const auto whole = static_cast<int>(texel);
  return ((whole % size) + size) % size;
}

// Adds one texel of a level as 2^level x 2^level texels of the finest, each with an equal share.
void add_texel(Image& kernel, int level, const glm::dvec2& texel, double weight) {
  const int edge = 1 << level;
  const int columns = std::max(kernel.width >> level, 1);
  const int x0 = wrapped(texel.x, columns) * edge, y0 = wrapped(texel.y, columns) * edge;
  const auto share = static_cast<float>(weight / (static_cast<double>(edge) * edge));
  for (int y = y0; y < y0 + edge; ++y) {
    for (int x = x0; x < x0 + edge; ++x)
      kernel
          .texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(kernel.width) + static_cast<std::size_t>(x)] +=
          share;
  }
}

void add_bilinear(Image& kernel, int level, const glm::dvec2& centre, double weight) {
  const glm::dvec2 in_texels = centre / static_cast<double>(1 << level) - 0.5;
  const glm::dvec2 corner = glm::floor(in_texels);
  const glm::dvec2 part = in_texels - corner;
  for (int i = 0; i < 4; ++i) {
    const glm::dvec2 side(i & 1, i >> 1);
    const glm::dvec2 share = glm::mix(1.0 - part, part, side);
    add_texel(kernel, level, corner + side, weight * share.x * share.y);
  }
}

}  // namespace

Image filter_kernel(const FootprintFilter& filter, const TexelFootprint& footprint, int size) {
  const ProbeSet set = probes_of(filter, footprint);
  const double coarsest = std::floor(std::log2(size));
  const double level = std::clamp(set.level, 0.0, coarsest);
  const int lower = static_cast<int>(level);
  const double part = level - lower;
  Image kernel(size, size, 1);
  for (const Probe& probe : set.probes) {
    add_bilinear(kernel, lower, probe.centre, probe.weight * (1.0 - part));
    if (part > 0.0) add_bilinear(kernel, lower + 1, probe.centre, probe.weight * part);
  }
  return kernel;
}

Image box_kernel(const TexelFootprint& footprint, int size) {
  constexpr int points = 16;
  Image kernel(size, size, 1);
  const glm::dmat2 inverse = glm::inverse(glm::dmat2(footprint.dx, footprint.dy));
  double sum = 0.0;
  for (int y = 0; y < size * points; ++y) {
    for (int x = 0; x < size * points; ++x) {
      const glm::dvec2 at = (glm::dvec2(x, y) + 0.5) / static_cast<double>(points);
      const glm::dvec2 inside = glm::abs(inverse * (at - footprint.centre));
      if (inside.x >= 0.5 || inside.y >= 0.5) continue;
      kernel.texels[static_cast<std::size_t>(y / points) * static_cast<std::size_t>(size) +
                    static_cast<std::size_t>(x / points)] += 1.0F;
      sum += 1.0;
    }
  }
  for (float& weight : kernel.texels) weight = static_cast<float>(weight / sum);
  return kernel;
}

KernelMoments kernel_moments(const Image& kernel, const TexelFootprint& footprint) {
  // The longer axis of the ellipse that the edges map the unit circle to.
  const glm::dmat2 edges(footprint.dx, footprint.dy);
  const glm::dmat2 square = edges * glm::transpose(edges);
  const double angle = 0.5 * std::atan2(2.0 * square[0][1], square[0][0] - square[1][1]);
  const glm::dvec2 along(std::cos(angle), std::sin(angle));
  const glm::dvec2 across(-along.y, along.x);
  KernelMoments out;
  double whole = 0.0, along2 = 0.0, across2 = 0.0;
  for (std::size_t i = 0; i < kernel.texel_count(); ++i) {
    const auto width = static_cast<std::size_t>(kernel.width);
    const glm::dvec2 at = glm::dvec2(i % width, i / width) + 0.5;
    const double weight = kernel.texels[i];
    const glm::dvec2 from_centre = at - footprint.centre;
    whole += weight;
    out.mean += weight * at;
    along2 += weight * std::pow(glm::dot(from_centre, along), 2);
    across2 += weight * std::pow(glm::dot(from_centre, across), 2);
  }
  out.mean /= whole;
  const glm::dvec2 shift = out.mean - footprint.centre;
  out.along = std::sqrt(std::max(along2 / whole - std::pow(glm::dot(shift, along), 2), 0.0));
  out.across = std::sqrt(std::max(across2 / whole - std::pow(glm::dot(shift, across), 2), 0.0));
  return out;
}

}  // namespace footprint::testing
