// The brightest texel, then sums over a disc about it and over the ring around that.
#include "renderer/scene/small_sun.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace footprint {
namespace {

using std::numbers::pi;
constexpr double least_share = 0.01;
constexpr double least_contrast = 10.0;
constexpr double largest_texel = 5e-4;  // steradians: 1.3 degrees a side
constexpr double smallest_disc = 0.5 * pi / 180.0;
constexpr double texels_in_disc = 1.5;

glm::dvec3 radiance_at(const Image& map, int x, int y) {
  const auto texel = map.at(x, y);
  return {texel[0], texel[1], texel[2]};
}

double all_channels(const glm::dvec3& color) { return color.r + color.g + color.b; }

// An environment's texels with their solid angles and directions.
class Sky {
 public:
  explicit Sky(const Environment& environment)
      : environment_(&environment),
        map_(environment.radiance.get()),
        solid_angles_(row_solid_angles(map_->width, map_->height)),
        disc_(std::max(smallest_disc, texels_in_disc * 2.0 * pi / map_->width)) {}

  [[nodiscard]] bool has_small_texels() const {
    return solid_angles_[static_cast<std::size_t>(map_->height / 2)] <= largest_texel;
  }

  [[nodiscard]] glm::ivec2 brightest() const {
    glm::ivec2 at(0);
    double most = 0.0;
    for (int y = 0; y < map_->height; ++y) {
      for (int x = 0; x < map_->width; ++x) {
        const double radiance = all_channels(radiance_at(*map_, x, y));
        if (radiance > most) at = {x, y};
        most = std::max(most, radiance);
      }
    }
    return at;
  }

  [[nodiscard]] glm::dvec3 direction(int x, int y) const {
    return environment_direction(*environment_, (x + 0.5) / map_->width, (y + 0.5) / map_->height);
  }

  /// look(texel, radiance, solid angle) at the texels whose middle is from `least` to `most` discs' radii from
  /// `centre`.
  template <class Look>
  void look_around(const glm::dvec3& centre, double least, double most, const Look& look) const {
    const double polar = std::acos(std::clamp(centre.y, -1.0, 1.0));
    const auto row = [&](double angle) { return static_cast<int>(std::floor(angle / pi * map_->height)); };
    const int last = std::min(row(polar + most * disc_), map_->height - 1);
    for (int y = std::max(row(polar - most * disc_), 0); y <= last; ++y) {
      for (int x = 0; x < map_->width; ++x) {
        const double angle = std::acos(std::clamp(glm::dot(direction(x, y), centre), -1.0, 1.0)) / disc_;
        if (angle >= least && angle < most)
          look(glm::ivec2(x, y), radiance_at(*map_, x, y), solid_angles_[static_cast<std::size_t>(y)]);
      }
    }
  }

  /// The mean radiance of the ring around the disc about `centre`.
  [[nodiscard]] glm::dvec3 around(const glm::dvec3& centre) const {
    glm::dvec3 sum(0.0);
    double all = 0.0;
    look_around(centre, 1.0, 2.0, [&](const glm::ivec2&, const glm::dvec3& radiance, double solid_angle) {
      sum += radiance * solid_angle;
      all += solid_angle;
    });
    return sum / all;
  }

  /// What of the disc about `centre` is brighter than `level`: its light, and where that comes from.
  [[nodiscard]] SmallSun above(const glm::dvec3& level, const glm::dvec3& centre) const {
    SmallSun sun;
    look_around(centre, 0.0, 1.0, [&](const glm::ivec2& texel, const glm::dvec3& radiance, double solid_angle) {
      const glm::dvec3 light = glm::max(radiance - level, glm::dvec3(0.0)) * solid_angle;
      sun.irradiance += light;
      sun.direction += all_channels(light) * direction(texel.x, texel.y);
    });
    const double length = glm::length(sun.direction);
    sun.direction = length > 0.0 ? sun.direction / length : centre;
    sun.share = all_channels(sun.irradiance) / all_channels(4.0 * pi * mean_radiance(*map_));
    return sun;
  }

 private:
  const Environment* environment_;
  const Image* map_;
  std::vector<double> solid_angles_;
  double disc_;  // its radius, radians
};

}  // namespace

std::optional<SunApart> sun_apart(const Environment& environment) {
  const Sky sky(environment);
  if (!sky.has_small_texels()) return {};
  const Image& map = *environment.radiance;
  const glm::ivec2 brightest = sky.brightest();
  const double most = all_channels(radiance_at(map, brightest.x, brightest.y));
  if (!(most > 0.0)) return {};
  // A sun's middle may lie between texels: about the middle of what the brightest texel's disc has, once more.
  const glm::dvec3 first = sky.direction(brightest.x, brightest.y);
  const glm::dvec3 centre = sky.above(sky.around(first), first).direction;
  const glm::dvec3 level = sky.around(centre);
  const SmallSun sun = sky.above(level, centre);
  if (sun.share < least_share || most < least_contrast * all_channels(level)) return {};
  Image rest = map;
  sky.look_around(centre, 0.0, 1.0, [&](const glm::ivec2& texel, const glm::dvec3& radiance, double) {
    for (int c = 0; c < 3; ++c)
      rest.at(texel.x, texel.y)[static_cast<std::size_t>(c)] = static_cast<float>(std::min(radiance[c], level[c]));
  });
  return SunApart{sun, {environment.name, std::make_shared<const Image>(std::move(rest)), environment.rotation}};
}

}  // namespace footprint
