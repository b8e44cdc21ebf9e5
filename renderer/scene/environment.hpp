// Light from all directions: an equirectangular map (a file, a constant or an analytic sky), and the suns in it.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "renderer/image/image.hpp"

namespace footprint {

/// Radiance from every direction, constant over each texel of an equirectangular map. Row 0 is around +y, the last row
/// around -y. Without rotation the map's centre is at -z, a glTF camera's viewing direction, with +x to the right.
struct Environment {
  std::string name;                       ///< "constant", "sky", or the file's name
  std::shared_ptr<const Image> radiance;  ///< RGB, finite, not negative
  float rotation = 0.0F;                  ///< radians about +y, counter-clockwise seen from above
};

/// The unit direction of a point of the map; u and v from 0 to 1, v = 0 is +y.
[[nodiscard]] glm::dvec3 environment_direction(const Environment& environment, double u, double v);

/// The map's point in a direction: u in [0, 1), v in [0, 1].
[[nodiscard]] glm::dvec2 environment_uv(const Environment& environment, const glm::dvec3& direction);

/// The radiance of the texel in a direction.
[[nodiscard]] glm::vec3 environment_radiance(const Environment& environment, const glm::dvec3& direction);

/// The solid angle of a texel in each row of a map of width x height; all texels sum to 4 pi.
[[nodiscard]] std::vector<double> row_solid_angles(int width, int height);

/// The map in another size: each texel is the mean over its solid angle, which preserves the light of every part of the
/// sphere. Whole multiples of the size repeat texels.
[[nodiscard]] Image resampled_environment(const Image& radiance, int width, int height);

/// The mean over all directions.
[[nodiscard]] glm::dvec3 mean_radiance(const Image& radiance);

/// An environment with the same radiance from everywhere.
[[nodiscard]] Environment constant_environment(const glm::vec3& radiance);

/// The settings of `sky_environment`.
struct SkySettings {
  glm::dvec3 sun_direction{0.4, 0.6, 0.7};  ///< towards the sun; any length but 0, not below the horizon (y >= 0)
};

/// A clear sky above a grey ground, +y up, with radiance about 1 where it is blue (docs/reference/scenes.md): the
/// gradients of CIE standard general sky 12, and a soft sun. 1024 x 512 texels.
[[nodiscard]] Environment sky_environment(const SkySettings& settings);

/// Wider maps are averaged down to this width, the largest of the sampling tables.
inline constexpr int largest_environment_width = 2048;

/// Loads an equirectangular map (EXR or Radiance HDR; integer formats as displayed colours) of 1, 3 or 4 channels, of
/// which the fourth is ignored. Adds to `warnings`: negative values, which become 0; another shape than 2:1; the same
/// radiance everywhere; what is left out of the file. Throws Error (usage): as read_image;
/// two channels; a value that is not finite, with file and texel.
[[nodiscard]] Environment load_environment(const std::filesystem::path& file, std::vector<std::string>& warnings);

/// A small sun as a directional light.
struct SmallSun {
  glm::dvec3 direction{0.0};   ///< towards it: unit, world, rotation applied
  glm::dvec3 irradiance{0.0};  ///< on a surface that faces it
  double share = 0.0;          ///< of the environment's light, over all directions and channels
};

/// An environment without its small suns, and the suns.
struct SunsApart {
  std::vector<SmallSun> suns;  ///< brightest first, at most most_small_suns
  Environment rest;            ///< suns are replaced by the radiance around them
};

/// The largest number of suns; each is one more light for methods.
inline constexpr std::size_t most_small_suns = 4;

/// Separates small suns, starting at the brightest texel. A sun is the surroundings of that texel, half a degree or a
/// texel and a half, if their radiance above the ring around them has 1/100 of all light, and the texel is ten times as
/// bright as that ring. There are none in a black environment, in a sky with a soft sun, or if texels are larger than
/// 1.3 degrees.
[[nodiscard]] SunsApart suns_apart(const Environment& environment);

}  // namespace footprint
