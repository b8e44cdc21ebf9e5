// Base lobes, isotropic and anisotropic: the normal distributions of a single facet, von Mises-Fisher formulas, and
// tables for fast evaluation.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace footprint {

enum class NormalDistribution { blinn_phong, beckmann, ggx, vmf };

/// The distribution of normals within one facet (docs/explanation/base-brdf.md).
struct Lobe {
  NormalDistribution distribution = NormalDistribution::blinn_phong;
  double parameter = 64.0;  ///< exponent (blinn_phong), alpha (beckmann, ggx), kappa (vmf)

  friend bool operator==(const Lobe&, const Lobe&) = default;
};

/// The smallest alpha of a base lobe and of all methods: a mirror whose peak is finite in 32 bits.
inline constexpr double smallest_alpha = 1e-3;

/// The lobe of a width alpha (at least `smallest_alpha`) or of a slope variance per axis, and the slope variance of a
/// lobe. They match common_lobes.glsl, in 32 bits.
[[nodiscard]] Lobe lobe_from_alpha(NormalDistribution distribution, float alpha);
[[nodiscard]] Lobe lobe_from_variance(NormalDistribution distribution, float variance);
[[nodiscard]] float lobe_variance(const Lobe& lobe);

/// The perceptual roughness r of a lobe, for which lobe_from_alpha(r^2) returns the lobe. Relative error 1e-6 for alpha
/// from 1e-3 and for exponents and kappa up to 1e6; absolute for Blinn-Phong exponents below 1. Above 1 for kappa below
/// 2.
[[nodiscard]] float lobe_roughness(const Lobe& lobe);

/// Reads `blinn_phong:64`, `beckmann:0.2`, `ggx:0.2` or `vmf:64`. Exponent and kappa range from 0.001 to 1e6, alpha
/// from `smallest_alpha` to 1.
/// Throws Error (usage) that names `option`: unknown distribution (with the nearest name), missing parameter, or
/// parameter out of range.
[[nodiscard]] Lobe parse_lobe(std::string_view option, const std::string& text);

/// The text form of a lobe, which parse_lobe reads.
[[nodiscard]] std::string lobe_text(const Lobe& lobe);

/// The density at the facet's own normal, 1/sr.
[[nodiscard]] double lobe_peak(const Lobe& lobe);

/// The density relative to `lobe_peak` at u = 1 - n.h, in [0, 2]. Stable for narrow lobes if u is computed as |h - n|^2
/// / 2.
[[nodiscard]] double lobe_shape(const Lobe& lobe, double u);

/// The density at u, 1/sr.
[[nodiscard]] inline double lobe_density(const Lobe& lobe, double u) { return lobe_peak(lobe) * lobe_shape(lobe, u); }

/// The u beyond which `lobe_shape` is below `lobe_cutoff`; at most 2.
inline constexpr double lobe_cutoff = 1e-12;
[[nodiscard]] double lobe_support(const Lobe& lobe);

/// The standard deviation per axis of the lobe's core, in radians.
[[nodiscard]] double lobe_width(const Lobe& lobe);

/// The lobe's integral over the directions above the surface, for a facet normal with cosine `n_z` to the surface
/// normal. Sums rings about the facet normal, each weighted by its share above the horizon. Error below 1e-3.
[[nodiscard]] double lobe_energy(const Lobe& lobe, double n_z);

/// The integral of e^{kappa (cos - 1)} over the sphere, 2 pi (1 - e^{-2 kappa}) / kappa (Iwasaki 2012, equation 9);
/// 4 pi for kappa = 0.
[[nodiscard]] double vmf_integral(double kappa);

/// The density at the axis, 1/sr.
[[nodiscard]] double vmf_peak(double kappa);

/// 2 pi times the density at the axis, kappa / (1 - e^{-2 kappa}): 1/2 for kappa = 0.
[[nodiscard]] double vmf_amplitude(double kappa);

/// The length A = coth kappa - 1 / kappa of the lobe's mean vector, divided by kappa, and the derivative of that
/// quotient with respect to kappa. 1/3 and -2/45 for kappa = 0.
struct VmfMean {
  double by_kappa, slope_by_kappa;
};
[[nodiscard]] VmfMean vmf_mean(double kappa);

/// Estimates kappa = (3 r - r^3) / (1 - r^2) from the length r of the mean vector (Banerjee et al. 2005, p = 3). The
/// argument is q = 1 - r, in (0, 1], which stays precise for r near 1.
[[nodiscard]] double vmf_kappa_of_shortfall(double q);

/// The inverse of vmf_kappa_of_shortfall for kappa >= 0: the root in (0, 1] of q^3 + (kappa - 3) q^2 - 2 kappa q + 2 =
/// 0, by Newton iteration.
[[nodiscard]] double vmf_shortfall(double kappa);

/// Evaluates `lobe_shape` of one lobe with an error below 2e-9. Uses Hermite cubics between even nodes in u up to the
/// support of the lobe. Evaluates the lobe directly if a table is not faster (GGX needs no exponential) or not accurate
/// (lobes so wide that the horizon cuts them).
class LobeProfile {
 public:
  explicit LobeProfile(const Lobe& lobe);

  [[nodiscard]] double operator()(double u) const {
    if (cubics_.empty()) return lobe_shape(lobe_, u);
    const double position = u * scale_;
    const auto i = static_cast<std::size_t>(position);
    if (i >= cubics_.size()) return 0.0;
    const double t = position - static_cast<double>(i);
    const std::array<double, 4>& c = cubics_[i];
    return ((c[3] * t + c[2]) * t + c[1]) * t + c[0];
  }

 private:
  Lobe lobe_;
  double scale_ = 0.0;  // intervals per u
  std::vector<std::array<double, 4>> cubics_;
};

/// How a lobe is stretched (KHR_materials_anisotropy).
struct Anisotropy {
  float strength = 0.0F;  ///< 0..1; 0 is round
  float rotation = 0.0F;  ///< of the direction of stretch, radians from the tangent towards the bitangent

  friend bool operator==(const Anisotropy&, const Anisotropy&) = default;
};

/// The widths of an anisotropic Beckmann or GGX lobe, along and across the direction of stretch.
struct Alphas {
  double along, across;

  friend bool operator==(const Alphas&, const Alphas&) = default;
};

/// alpha across and mix(alpha, 1, strength^2) along, as KHR_materials_anisotropy defines them.
/// strength: 0..1. alpha: that of the roughness, `smallest_alpha` to 1.
[[nodiscard]] Alphas anisotropic_alphas(double strength, double alpha);

/// The round lobe with the mean slope variance of both directions: alpha^2 is the mean of both squares.
[[nodiscard]] double round_alpha(const Alphas& alphas);

/// The stretch of a lobe: r (cos 2 phi, sin 2 phi) with r = (along^2 - across^2) / (along^2 + across^2) and the
/// rotation phi. The lobe's slopes have the covariance round^2 / 2 (1 + x, y; y, 1 - x), so that means of stretches
/// make sense. rotation: as in Anisotropy.
[[nodiscard]] glm::dvec2 stretch_of(const Alphas& alphas, double rotation);

/// The inverse of stretch_of and round_alpha. Matches facetAlphas in anisotropic_facets.glsl.
/// round: alpha of the round lobe. stretch: of length 0 to 1.
[[nodiscard]] Alphas alphas_of_stretch(double round, const glm::dvec2& stretch);

/// The rotation of a stretch, -pi / 2 to pi / 2.
[[nodiscard]] double rotation_of_stretch(const glm::dvec2& stretch);

/// The density of normals of an anisotropic facet, 1/sr (Heitz 2014, section 5). Matches baseDensity in
/// anisotropic_facets.glsl.
/// distribution: beckmann or ggx. rotation: as in Anisotropy.
/// own: unit half vector in the facet's frame, z along its normal (turned_with_normal).
[[nodiscard]] double anisotropic_density(NormalDistribution distribution, const Alphas& alphas, double rotation,
                                         const glm::dvec3& own);

}  // namespace footprint
