// Small scenes made in memory: a square with a normal map, seen from straight above.
#pragma once

#include <cstdint>

#include "renderer/scene/scene.hpp"

namespace footprint::testing {

/// A map of random unit normals that lean up to `most_tilt` (sine of the angle): 4 channels, weight 1.
[[nodiscard]] Image random_normals(int width, int height, float most_tilt, std::uint32_t seed);

/// A map of one normal.
[[nodiscard]] Image constant_normals(int width, int height, const glm::vec3& normal);

/// The four normals of the golden `four_texel_vector`, 2 x 2.
[[nodiscard]] Image four_texel_normals();

/// Normals of correlated Gaussian slopes: mean (-0.1, 0.15), deviation `spread` along x and 0.54 `spread` along y.
[[nodiscard]] Image gaussian_slope_normals(int size, float spread);

/// The base BRDF and colours of the square.
struct SquareMaterial {
  BaseBrdf brdf;
  float roughness = 0.5F;
  glm::vec3 base_color{0.5F, 0.4F, 0.3F};
  glm::vec3 specular{0.04F};
  float metallic = 0.0F;
};

/// A square of side 2 in the plane z = 0 with one material, a camera at (0, 0, 3) that sees it whole with a margin of
/// none (the square fills the frame), and one point light at (0.4, 0.3, 1.5) of 4 candela. No normal map where
/// `normals` is empty. Exposure 1.
[[nodiscard]] Scene square_scene(const Image& normals, const SquareMaterial& settings);

/// The material of that square where all comes from the normal map and one lobe: no Fresnel term, a diffuse one.
[[nodiscard]] Material lobe_material(const Image& normals, NormalDistribution distribution, float lobe,
                                     GeometryTerm geometry = GeometryTerm::none);

/// The unit normal that a texel of a normal map stores.
[[nodiscard]] glm::dvec3 normal_at(const Image& normals, int x, int y);

/// That square with random grooves along y, 64 across, seen obliquely along them: pixels are long where nothing
/// changes.
[[nodiscard]] Scene receding_grooves();

}  // namespace footprint::testing
