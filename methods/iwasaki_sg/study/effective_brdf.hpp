// The effective BRDF that a material's table stands for, in double precision: twin of the specular term in
// iwasaki_sg.glsl.
#pragma once

#include <glm/glm.hpp>
#include <variant>
#include <vector>

#include "methods/iwasaki_sg/brdf_lobes.hpp"
#include "methods/iwasaki_sg/material_table.hpp"
#include "renderer/core/options.hpp"
#include "renderer/lobes/lobe.hpp"
#include "renderer/scene/material.hpp"

namespace footprint::iwasaki_sg {

/// What facets reflect with: the base lobe, that lobe as spherical Gaussians of unit energy, or those of a tabulated
/// BRDF with its diffuse term.
using FacetReflection = std::variant<Lobe, std::vector<BrdfLobe>, TabulatedLobes>;

/// That of a material by the option `lobe`; a tabulated BRDF where the facets have one.
[[nodiscard]] FacetReflection facet_reflection(const Material& material, const Options& options);

/// f cos of the effective BRDF but for the Fresnel and geometry terms (all of it, where the BRDF is tabulated): Eq. 15,
/// with amplitudes interpolated between the table's directions.
class EffectiveBrdf {
 public:
  /// `approximate`: Eq. 14 in place of Eq. 11 for a base lobe in spherical Gaussians. Refers to the table.
  EffectiveBrdf(const MaterialTable& table, const TableSettings& settings, FacetReflection reflection,
                bool approximate);

  /// Of unit vectors above the horizon, in each channel; a table of one channel has it in all.
  [[nodiscard]] glm::dvec3 operator()(const glm::dvec3& wi, const glm::dvec3& wo) const;

 private:
  [[nodiscard]] glm::dvec3 convolved(const SphericalGaussian& lobe, const glm::dvec3& h, const glm::dvec3& wi) const;
  [[nodiscard]] std::vector<glm::dvec3> masses(const glm::dvec3& wi, const glm::dvec3& wo) const;

  const MaterialTable& table_;
  int side_;
  std::vector<glm::dvec3> directions_;
  bool with_cosine_;  // whether masses have the facets' cosine to the light
  FacetReflection reflection_;
  bool approximate_;
};

}  // namespace footprint::iwasaki_sg
