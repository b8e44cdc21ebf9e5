// The lobes of a facet that reflects with several: how their axes turn, and how the material's uniform block holds
// them.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene/material.hpp"

namespace footprint {

/// The shortest rotation that takes z to the unit vector `normal`, of `axis`; normal = -z turns about y. The twin of
/// turnedWithNormal in facet_frame.glsl.
[[nodiscard]] glm::dvec3 turned_with_normal(const glm::dvec3& axis, const glm::dvec3& normal);

/// Slope variance per axis of a material's lobes about their own axes, by weight; of the one lobe about the normal
/// where it has no others.
[[nodiscard]] double mean_lobe_variance(const Material& material);

/// The std140 members of surface_material.glsl that the effect `multi_lobe` adds: the number of lobes, then all
/// most_facet_lobes, those that a material lacks as zeros. Errors (usage): more lobes than that, or one that is no lobe
/// (docs/scenes.md has the ranges).
[[nodiscard]] std::vector<glm::vec4> facet_lobe_block(const Material& material);

}  // namespace footprint
