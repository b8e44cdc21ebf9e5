// Edits of the base BRDF of a scene's materials: what `--set brdf.PARAMETER=FROM:TO` changes from frame to frame.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "renderer/core/options.hpp"
#include "renderer/microgeometry/tabulated_brdf.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint {

/// The kind of a sweep over the base BRDF.
inline constexpr const char* brdf_kind = "brdf";

/// The parameter whose values are MERL files; between them it is the share of the second, 0 to 1.
inline constexpr const char* measured_parameter = "measured";

/// roughness, exponent, alpha, kappa, specular, metallic, and the share of the second measured table.
[[nodiscard]] const std::vector<OptionSpec>& brdf_parameters();

/// The two tables between which an edit goes.
struct MeasuredPair {
  TabulatedBrdf from, to;
};

/// Sets parameters of the base BRDF of all materials.
/// values: by name, as brdf_parameters() takes them.
/// tables: needed for `measured` alone; else null.
/// Errors (usage): a parameter that a material does not have: another distribution, a value from a map, lobes of its
/// own, or `measured` without small-scale geometry.
void set_brdf(const std::map<std::string, std::string>& values, const MeasuredPair* tables, Scene& scene);

}  // namespace footprint
