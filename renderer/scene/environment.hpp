// Light from all directions: an equirectangular map, from a file, a constant or an analytic sky.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "renderer/image/image.hpp"

namespace footprint {

/// Radiance that arrives from every direction, constant over each texel of a latitude-longitude map. Row 0 is around
/// +y, the last one around -y. Without rotation the map's centre is seen along -z, as a glTF camera looks, and +x to
/// the right of it.
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

/// The solid angle of a texel in each row of a map of width x height; all texels together have 4 pi.
[[nodiscard]] std::vector<double> row_solid_angles(int width, int height);

/// The map with other sizes: each texel the mean over the solid angle that it covers, so that the light of every part
/// of the sphere is kept. Larger sizes that are whole multiples repeat texels.
[[nodiscard]] Image resampled_environment(const Image& radiance, int width, int height);

/// The mean over all directions.
[[nodiscard]] glm::dvec3 mean_radiance(const Image& radiance);

/// The same radiance from everywhere.
[[nodiscard]] Environment constant_environment(const glm::vec3& radiance);

/// Where the sun stands, and the light of `sky_environment`.
struct SkySettings {
  glm::dvec3 sun_direction{0.4, 0.6, 0.7};  ///< towards the sun; any length but 0, not below the horizon (y >= 0)
};

/// A clear sky above a grey ground, +y up, of radiance about 1 where it is blue (docs/scenes.md has the model): CIE
/// standard general sky 12 for the gradients, a soft sun, no measured colours. 1024 x 512.
[[nodiscard]] Environment sky_environment(const SkySettings& settings);

/// Maps wider than this are averaged down to it: 2048 x 1024 texels hold what the sampling tables hold.
inline constexpr int largest_environment_width = 2048;

/// A latitude-longitude image (EXR, Radiance HDR; integer formats are taken as sRGB) of 1 or 3 channels, or 4 whose
/// last is left out. Negative values become 0 and add a line to `warnings`. Throws Error (usage): as read_image; two
/// channels; a value that is not finite, with the file and the texel.
[[nodiscard]] Environment load_environment(const std::filesystem::path& file, std::vector<std::string>& warnings);

}  // namespace footprint
