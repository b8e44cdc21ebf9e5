// Probes of each filter, and their tents over the boxes of two mip levels.
#include "renderer/ndf/filter_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace footprint {
namespace {

using Kind = FootprintFilterKind;

double longer_edge(const TexelFootprint& f) { return std::max(glm::length(f.dx), glm::length(f.dy)); }

// The principal axes of the ellipse that the edges map the unit circle to.
struct Ellipse {
  double major = 1.0, minor = 1.0;  // radii, texels
  glm::dvec2 along{1.0, 0.0};       // unit
};

Ellipse ellipse_of(const TexelFootprint& f) {
  const double a = f.dx.x * f.dx.x + f.dy.x * f.dy.x;
  const double b = f.dx.x * f.dx.y + f.dy.x * f.dy.y;
  const double c = f.dx.y * f.dx.y + f.dy.y * f.dy.y;
  const double root = std::hypot(a - c, 2.0 * b);
  Ellipse out;
  out.major = std::sqrt(std::max(0.5 * (a + c + root), 1e-24));
  out.minor = std::abs(f.dx.x * f.dy.y - f.dx.y * f.dy.x) / out.major;  // the difference of the roots would cancel
  const double angle = 0.5 * std::atan2(2.0 * b, a - c);
  out.along = {std::cos(angle), std::sin(angle)};
  return out;
}

ProbeSet tiling(const TexelFootprint& f, int parts) {
  ProbeSet out{std::log2(longer_edge(f) / parts), {}};
  for (int i = 0; i < parts * parts; ++i) {
    const glm::dvec2 at = (glm::dvec2(i % parts, i / parts) + 0.5) / static_cast<double>(parts) - 0.5;
    out.probes.push_back({f.centre + f.dx * at.x + f.dy * at.y, 1.0 / (parts * parts)});
  }
  return out;
}

ProbeSet along_the_longer_edge(const TexelFootprint& f, int most) {
  const double x = glm::length(f.dx), y = glm::length(f.dy);
  const double major = std::max(x, y);
  const double ratio = 0.999 * major / std::max(std::min(x, y), 1e-12);  // what rounding makes uneven is even
  const int count = static_cast<int>(std::ceil(std::min(ratio, static_cast<double>(most))));
  ProbeSet out{std::log2(major / count), {}};
  for (int i = 0; i < count; ++i) {
    out.probes.push_back({f.centre + (x > y ? f.dx : f.dy) * ((i + 1.0) / (count + 1.0) - 0.5), 1.0 / count});
  }
  return out;
}

ProbeSet along_the_ellipse(const TexelFootprint& f, int most) {
  const Ellipse ellipse = ellipse_of(f);
  double width = std::max(ellipse.minor, 1.0);
  const int count = std::clamp(static_cast<int>(std::ceil(2.0 * ellipse.major / width - 1.0)), 1, most);
  width = std::max(width, 2.0 * ellipse.major / (count + 1));
  const double reach = std::max(ellipse.major - width, 0.0);
  // The Gaussian's variance along the ellipse without that of a probe, major^2 / 4 - width^2 / 4.
  const double variance = 0.25 * (ellipse.major + width) * reach;
  ProbeSet out{std::log2(width), {}};
  double sum = 0.0;
  for (int i = 0; i < count; ++i) {
    const double x = count > 1 ? reach * (2.0 * i / (count - 1) - 1.0) : 0.0;
    const double weight = x == 0.0 ? 1.0 : std::exp(-0.5 * x * x / variance);
    out.probes.push_back({f.centre + ellipse.along * x, weight});
    sum += weight;
  }
  for (Probe& probe : out.probes) probe.weight /= sum;
  return out;
}

int wrapped(double texel, int size) {
  const auto whole = static_cast<int>(texel);
  return ((whole % size) + size) % size;
}

// Adds one texel of a level: 2^level x 2^level of the finest, each with an equal share.
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

ProbeSet probes_of(const FootprintFilter& filter, const TexelFootprint& footprint) {
  switch (filter.kind) {
    case Kind::trilinear:
      return tiling(footprint, 1);
    case Kind::box:
    case Kind::shaded:
      return tiling(footprint, filter.count);
    case Kind::anisotropic:
    case Kind::hardware:
      return along_the_longer_edge(footprint, filter.count);
    case Kind::ewa:
      return along_the_ellipse(footprint, filter.count);
  }
  throw std::logic_error("not a footprint filter");
}

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
  const glm::dvec2 along = ellipse_of(footprint).along;
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

}  // namespace footprint
