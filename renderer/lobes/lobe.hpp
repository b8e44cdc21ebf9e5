// A lobe of normals as a value: a distribution with its parameter, its density, width and energy, and conversions
// between what it is told by.
#pragma once

#include <string>
#include <string_view>

namespace footprint {

enum class NormalDistribution { blinn_phong, beckmann, ggx, vmf };

/// One facet's density of normals (docs/base-brdf.md).
struct Lobe {
  NormalDistribution distribution = NormalDistribution::blinn_phong;
  double parameter = 64.0;  ///< exponent (blinn_phong), alpha (beckmann, ggx), kappa (vmf)

  friend bool operator==(const Lobe&, const Lobe&) = default;
};

/// The narrowest lobe there is, for the base BRDF and every method alike: a mirror whose peak stays finite in 32 bits.
inline constexpr double smallest_alpha = 1e-3;

/// The lobe of a width alpha (at least `smallest_alpha`) or of a slope variance per axis, and the slope variance of a
/// lobe: the functions of common_lobes.glsl in C++, in 32 bits too.
[[nodiscard]] Lobe lobe_from_alpha(NormalDistribution distribution, float alpha);
[[nodiscard]] Lobe lobe_from_variance(NormalDistribution distribution, float variance);
[[nodiscard]] float lobe_variance(const Lobe& lobe);

/// The perceptual roughness r of a lobe, so that lobe_from_alpha(r^2) is the lobe again, to 1e-6 of it (Blinn-Phong
/// exponents below 1: to 1e-6) for alpha from 1e-3 and exponents and kappa to 1e6. Above 1 for kappa below 2.
[[nodiscard]] float lobe_roughness(const Lobe& lobe);

/// Reads `blinn_phong:64`, `beckmann:0.2`, `ggx:0.2` or `vmf:64`. Errors (usage), which name `option`: no such
/// distribution (with the nearest right name), no parameter, one out of range (exponent and kappa 0.001 to 1e6, alpha
/// `smallest_alpha` to 1).
[[nodiscard]] Lobe parse_lobe(std::string_view option, const std::string& text);

/// As parse_lobe reads it.
[[nodiscard]] std::string lobe_text(const Lobe& lobe);

/// Density per solid angle at the facet's own normal.
[[nodiscard]] double lobe_peak(const Lobe& lobe);

/// The density over `lobe_peak` at u = 1 - n.h in [0, 2]. Stable for narrow lobes where u is taken as |h - n|^2 / 2.
[[nodiscard]] double lobe_shape(const Lobe& lobe, double u);

/// Density per solid angle at u.
[[nodiscard]] inline double lobe_density(const Lobe& lobe, double u) { return lobe_peak(lobe) * lobe_shape(lobe, u); }

/// The u beyond which `lobe_shape` stays below `lobe_cutoff`; at most 2.
inline constexpr double lobe_cutoff = 1e-12;
[[nodiscard]] double lobe_support(const Lobe& lobe);

/// Standard deviation per axis of the lobe's core, radians.
[[nodiscard]] double lobe_width(const Lobe& lobe);

/// The lobe's integral over the directions above the surface, about a normal with cosine `n_z` to the surface's own:
/// rings about the normal, each counted by the share of it that lies above the horizon. To 1e-3.
[[nodiscard]] double lobe_energy(const Lobe& lobe, double n_z);

}  // namespace footprint
