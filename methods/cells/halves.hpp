// Parts of normals and of roughness: texels of smooth facets and of rough ones have parts of their own.
#pragma once

#include <span>
#include <vector>

#include "methods/cells/partition.hpp"
#include "renderer/scene/material.hpp"

namespace footprint::cells {

/// The slope variance of the base lobe of each texel of a normal map of width x height texels, row by row, where
/// roughness_lies_on_normals(material).
[[nodiscard]] std::vector<double> texel_variances(const Material& material, int width, int height);

/// Whether each value belongs to the upper of two groups, by 2-means that starts from the extremes (Lloyd 1982).
/// Equal values are all in the lower group. Values are finite.
[[nodiscard]] std::vector<bool> upper_group(std::span<const double> values);

/// As partition(), with half of the parts, rounded up, for the texels of the narrower lobes and the rest for the
/// others: one lobe cannot stand for a sharp and a blunt one. The groups are those of the logarithms of the variances.
/// variances: the slope variance of each texel's lobe, above 0. Where all are in one group, or settings.parts is 1, the
/// result is that of partition(). settings.variance is that of each group's mean. Errors: those of partition().
[[nodiscard]] std::vector<float> partition_with_roughness(std::span<const PlanePoint> points,
                                                          std::span<const double> variances, int width, int height,
                                                          const PartitionSettings& settings, const Progress& progress);

}  // namespace footprint::cells
