// A clear sky that needs no file: see sky_environment in environment.hpp.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/scene/environment.hpp"

namespace footprint {
namespace {

constexpr int sky_width = 1024;
using std::numbers::pi;

// CIE S 011 / ISO 15469, standard general sky 12: "CIE standard clear sky, low illuminance turbidity".
constexpr double gradation_a = -1.0, gradation_b = -0.32;
constexpr double indicatrix_c = 10.0, indicatrix_d = -3.0, indicatrix_e = 0.45;

// Colours of unit luminance (Rec. 709), chosen by eye: zenith, horizon, and the light around the sun.
const glm::dvec3 zenith_color{0.45, 1.0, 2.6};
const glm::dvec3 horizon_color{0.85, 1.0, 1.45};
const glm::dvec3 sun_color{1.15, 1.0, 0.55};
const glm::dvec3 ground_color{1.0, 1.0, 1.0};

// A von Mises-Fisher lobe in place of the disc: what texels of a third of a degree resolve. It gives a surface that
// faces it `sun_share` times what the mean radiance of the sky would from a whole hemisphere.
constexpr double sun_sharpness = 3000.0;
constexpr double sun_share = 3.0;
constexpr double ground_albedo = 0.2;

double gradation(double cosine) { return 1.0 + gradation_a * std::exp(gradation_b / std::max(cosine, 0.01)); }

double indicatrix(double angle) {
  const double cosine = std::cos(angle);
  return 1.0 + indicatrix_c * (std::exp(indicatrix_d * angle) - std::exp(indicatrix_d * pi / 2.0)) +
         indicatrix_e * cosine * cosine;
}

glm::dvec3 sky_radiance(const glm::dvec3& direction, const glm::dvec3& sun) {
  const double angle = std::acos(std::clamp(glm::dot(direction, sun), -1.0, 1.0));
  const double zenith = gradation(1.0) * indicatrix(std::acos(std::clamp(sun.y, -1.0, 1.0)));
  const double luminance = gradation(direction.y) * indicatrix(angle) / zenith;
  const double low = std::pow(1.0 - direction.y, 4.0);
  const double near = std::exp(-4.0 * angle);
  return luminance * glm::mix(glm::mix(zenith_color, horizon_color, low), sun_color, near);
}

// Adds the sun and the ground that both light, to a map that holds the sky alone.
void add_sun_and_ground(Environment& sky, Image& map, const glm::dvec3& sun) {
  const glm::dvec3 mean = 2.0 * mean_radiance(map);  // over the upper half: the lower one is still black
  const glm::dvec3 irradiance = sun_share * pi * mean;
  const glm::dvec3 ground = ground_albedo * ground_color * (mean + irradiance * sun.y / pi);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const glm::dvec3 direction = environment_direction(sky, (x + 0.5) / map.width, (y + 0.5) / map.height);
      glm::dvec3 added = ground;
      if (direction.y >= 0.0) {
        const glm::dvec3 offset = direction - sun;
        added = irradiance * sun_color * sun_sharpness / (2.0 * pi) *
                std::exp(-0.5 * sun_sharpness * glm::dot(offset, offset));
      }
      for (int c = 0; c < 3; ++c) map.at(x, y)[static_cast<std::size_t>(c)] += static_cast<float>(added[c]);
    }
  }
}

}  // namespace

Environment sky_environment(const SkySettings& settings) {
  const glm::dvec3 sun = glm::normalize(settings.sun_direction);
  Environment sky{.name = "sky", .radiance = nullptr};
  Image map(sky_width, sky_width / 2, 3);
  for (int y = 0; y < map.height / 2; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const glm::dvec3 radiance =
          sky_radiance(environment_direction(sky, (x + 0.5) / map.width, (y + 0.5) / map.height), sun);
      for (int c = 0; c < 3; ++c) map.at(x, y)[static_cast<std::size_t>(c)] = static_cast<float>(radiance[c]);
    }
  }
  add_sun_and_ground(sky, map, sun);
  sky.radiance = std::make_shared<const Image>(std::move(map));
  return sky;
}

}  // namespace footprint
