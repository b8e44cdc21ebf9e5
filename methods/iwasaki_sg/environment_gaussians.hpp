// An environment as a few spherical Gaussians, for the diffuse term (Iwasaki et al. 2012, after equation 16).
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "methods/iwasaki_sg/spherical_gaussian.hpp"
#include "renderer/bake/prefiltered.hpp"
#include "renderer/scene/environment.hpp"

namespace footprint::iwasaki_sg {

/// The number of Gaussians that the paper takes.
inline constexpr int environment_gaussians = 9;

/// A Gaussian of the light, in world space.
struct LightGaussian {
  SphericalGaussian lobe;
  glm::dvec3 light{0.0};  ///< its integral over all directions, per channel
};

/// At most nine Gaussians fitted to an environment without its small suns, which are lights of their own. Each
/// direction belongs to the Gaussians by their shares of its luminance, so the light of all directions is preserved.
/// Empty: black.
[[nodiscard]] std::vector<LightGaussian> light_gaussians(const Environment& environment);

/// `iwasaki_environment`: a texel per Gaussian with axis and sharpness, and below it one with its light.
[[nodiscard]] PrefilteredTexture environment_texture(const Environment& environment);

}  // namespace footprint::iwasaki_sg
