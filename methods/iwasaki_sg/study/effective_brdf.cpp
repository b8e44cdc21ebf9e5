// Evaluates Eq. 15 in double precision with the shader's own interpolation between directions.
#include "methods/iwasaki_sg/study/effective_brdf.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "methods/iwasaki_sg/ndf_fit.hpp"
#include "methods/iwasaki_sg/settings.hpp"
#include "methods/iwasaki_sg/spherical_gaussian.hpp"
#include "renderer/lobes/lobe.hpp"
#include "renderer/microgeometry/direction_grid.hpp"
#include "renderer/microgeometry/microgeometry.hpp"

namespace footprint::iwasaki_sg {
namespace {

// The base lobe as wide as it and the normals' lobe are together: slope variances add.
double widened(const Lobe& base, const SphericalGaussian& lobe, const glm::dvec3& h) {
  const float variance = lobe_variance(base) + static_cast<float>(1.0 / lobe.sharpness);
  return lobe_density(lobe_from_variance(base.distribution, variance), one_minus_dot(lobe.axis, h));
}

}  // namespace

FacetReflection facet_reflection(const Material& material, const Options& options) {
  if (is_tabulated(material)) return lobes_of(*material.microgeometry->brdf);
  const Lobe lobe = lobe_of(material);
  if (options.word("lobe") == "sg") return lobes_of(lobe);
  return lobe;
}

EffectiveBrdf::EffectiveBrdf(const MaterialTable& table, const TableSettings& settings, FacetReflection reflection,
                             bool approximate)
    : table_(table),
      side_(settings.side),
      directions_(direction_grid(settings.side)),
      with_cosine_(settings.cosines == Cosines::published),
      reflection_(std::move(reflection)),
      approximate_(approximate) {}

glm::dvec3 EffectiveBrdf::operator()(const glm::dvec3& wi, const glm::dvec3& wo) const {
  const glm::dvec3 sum_of_directions = wi + wo;
  const double length = glm::length(sum_of_directions);
  if (length < 1e-4) return glm::dvec3(0.0);
  const glm::dvec3 h = sum_of_directions / length;
  const std::vector<glm::dvec3> amounts = masses(wi, wo);
  glm::dvec3 sum(0.0);
  for (std::size_t j = 0; j < amounts.size(); ++j) sum += amounts[j] * convolved(table_.amplitudes.lobes[j], h, wi);
  return with_cosine_ ? sum * wi.z : sum;
}

glm::dvec3 EffectiveBrdf::convolved(const SphericalGaussian& fitted, const glm::dvec3& h, const glm::dvec3& wi) const {
  const SphericalGaussian lobe{fitted.axis, own_sharpness(fitted.sharpness)};
  if (const auto* const base = std::get_if<Lobe>(&reflection_)) return glm::dvec3(widened(*base, lobe, h));
  if (const auto* const table = std::get_if<TabulatedLobes>(&reflection_)) {
    glm::dvec3 sum(0.0);
    for (const ColorLobe& own : table->lobes) {
      sum += glm::dvec3(own.amplitude) * convolution(lobe, SphericalGaussian{h, own.sharpness});
    }
    const double theta_d = std::acos(std::clamp(glm::dot(wi, h), 0.0, 1.0));
    return glm::dvec3(table->diffuse) + sum * rise_at(*table, theta_d) / vmf_integral(lobe.sharpness);
  }
  double sum = 0.0;
  for (const BrdfLobe& own : std::get<std::vector<BrdfLobe>>(reflection_)) {
    const SphericalGaussian about_h{h, own.sharpness};
    sum += own.amplitude * (approximate_ ? approximate_convolution(lobe, about_h) : convolution(lobe, about_h));
  }
  return glm::dvec3(sum / vmf_integral(lobe.sharpness));
}

// Interpolated as the shader does it: with the cosine to the light over that of the surface.
std::vector<glm::dvec3> EffectiveBrdf::masses(const glm::dvec3& wi, const glm::dvec3& wo) const {
  const Amplitudes& table = table_.amplitudes;
  const GridCells in = cells_around(wi, side_), out = cells_around(wo, side_);
  const std::size_t pairs = table.directions * table.directions;
  std::vector<glm::dvec3> sums(table.lobes.size(), glm::dvec3(0.0));
  for (std::size_t i = 0; i < 4; ++i) {
    const double scale = with_cosine_ ? 1.0 / directions_[in.cells.at(i)].z : 1.0;
    for (std::size_t o = 0; o < 4; ++o) {
      const double weight = in.weights.at(i) * out.weights.at(o) * scale;
      const std::size_t pair = in.cells.at(i) * table.directions + out.cells.at(o);
      for (std::size_t j = 0; j < sums.size(); ++j) {
        for (int c = 0; c < 3; ++c) {
          const std::size_t channel = table.channels == 1 ? 0 : static_cast<std::size_t>(c);
          sums[j][c] += weight * table.masses[(j * table.channels + channel) * pairs + pair];
        }
      }
    }
  }
  return sums;
}

}  // namespace footprint::iwasaki_sg
