// The base BRDF's normal distributions in double precision: the NDF inspector's truth, apart from the shaders' own.
#pragma once

#include <string>
#include <string_view>

#include "renderer/scene/material.hpp"

namespace footprint {

/// One facet's density of normals (docs/base-brdf.md): exponent (blinn_phong), alpha (beckmann, ggx), kappa (vmf).
struct BaseLobe {
  NormalDistribution distribution = NormalDistribution::blinn_phong;
  double parameter = 64.0;

  friend bool operator==(const BaseLobe&, const BaseLobe&) = default;
};

/// Reads `blinn_phong:64`, `beckmann:0.2`, `ggx:0.2` or `vmf:64`. Errors (usage), which name `option`: no such
/// distribution (with the nearest right name), no parameter, one out of range (exponent and kappa 0.001 to 1e6, alpha
/// 1e-4 to 1).
[[nodiscard]] BaseLobe parse_lobe(std::string_view option, const std::string& text);

/// As parse_lobe reads it.
[[nodiscard]] std::string lobe_text(const BaseLobe& lobe);

/// Density per solid angle at the facet's own normal.
[[nodiscard]] double lobe_peak(const BaseLobe& lobe);

/// The density over `lobe_peak` at u = 1 - n.h in [0, 2]. Stable for narrow lobes where u is taken as |h - n|^2 / 2.
[[nodiscard]] double lobe_shape(const BaseLobe& lobe, double u);

/// The u beyond which `lobe_shape` stays below `lobe_cutoff`; at most 2.
inline constexpr double lobe_cutoff = 1e-12;
[[nodiscard]] double lobe_support(const BaseLobe& lobe);

/// Standard deviation per axis of the lobe's core, radians.
[[nodiscard]] double lobe_width(const BaseLobe& lobe);

/// The lobe's integral over the directions above the surface, about a normal with cosine `n_z` to the surface's own:
/// rings about the normal, each counted by the share of it that lies above the horizon. To 1e-3.
[[nodiscard]] double lobe_energy(const BaseLobe& lobe, double n_z);

}  // namespace footprint
