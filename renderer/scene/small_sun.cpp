// The brightest texel, then sums over a disc about it and over the ring around that; and once more, without them.
#include "renderer/scene/small_sun.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

namespace footprint {
namespace {

using std::numbers::pi;
constexpr double least_share = 0.01;
constexpr double least_contrast = 10.0;
constexpr double largest_texel = 5e-4;  // steradians: 1.3 degrees per side
constexpr double smallest_disc = 0.5 * pi / 180.0;
constexpr double texels_in_disc = 1.5;

glm::dvec3 radiance_at(const Image& map, int x, int y) {
  const auto texel = map.at(x, y);
  return {texel[0], texel[1], texel[2]};
}

double all_channels(const glm::dvec3& color) { return color.r + color.g + color.b; }

// An environment's texels, as they are in `map`, with their solid angles and directions.
class Sky {
 public:
  Sky(const Environment& environment, const Image& map)
      : environment_(&environment),
        map_(&map),
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

  [[nodiscard]] glm::dvec3 radiance(const glm::ivec2& texel) const { return radiance_at(*map_, texel.x, texel.y); }

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

  /// The light of the disc about `centre` above `level`, its share of `all`, and its mean direction.
  [[nodiscard]] SmallSun above(const glm::dvec3& level, const glm::dvec3& centre, double all) const {
    SmallSun sun;
    look_around(centre, 0.0, 1.0, [&](const glm::ivec2& texel, const glm::dvec3& radiance, double solid_angle) {
      const glm::dvec3 light = glm::max(radiance - level, glm::dvec3(0.0)) * solid_angle;
      sun.irradiance += light;
      sun.direction += all_channels(light) * direction(texel.x, texel.y);
    });
    const double length = glm::length(sun.direction);
    sun.direction = length > 0.0 ? sun.direction / length : centre;
    sun.share = all_channels(sun.irradiance) / all;
    return sun;
  }

 private:
  const Environment* environment_;
  const Image* map_;
  std::vector<double> solid_angles_;
  double disc_;  // its radius, radians
};

// A sun, and its texels without it.
struct Found {
  SmallSun sun;
  std::vector<std::pair<glm::ivec2, glm::vec3>> dimmed;
};

// Of a sky in which there is light at all: `all` of it, as it was at first.
std::optional<Found> brightest_sun(const Sky& sky, double all) {
  const glm::ivec2 brightest = sky.brightest();
  // A sun's middle may be between texels, so the disc is centred again on the mean of the first one.
  const glm::dvec3 first = sky.direction(brightest.x, brightest.y);
  const glm::dvec3 centre = sky.above(sky.around(first), first, all).direction;
  const glm::dvec3 level = sky.around(centre);
  Found found{.sun = sky.above(level, centre, all), .dimmed = {}};
  const double contrast = all_channels(sky.radiance(brightest)) / all_channels(level);  // infinite in a black sky
  if (found.sun.share < least_share || contrast < least_contrast) return {};
  sky.look_around(centre, 0.0, 1.0, [&](const glm::ivec2& texel, const glm::dvec3& radiance, double) {
    found.dimmed.emplace_back(texel, glm::min(radiance, level));
  });
  return found;
}

}  // namespace

SunsApart suns_apart(const Environment& environment) {
  SunsApart apart{.suns = {}, .rest = environment};
  const double all = all_channels(4.0 * pi * mean_radiance(*environment.radiance));
  if (!(all > 0.0) || !Sky(environment, *environment.radiance).has_small_texels()) return apart;
  std::shared_ptr<Image> rest;
  while (apart.suns.size() < most_small_suns) {
    const std::optional<Found> found = brightest_sun(Sky(environment, *apart.rest.radiance), all);
    if (!found) break;
    if (!rest) apart.rest.radiance = rest = std::make_shared<Image>(*environment.radiance);
    for (const auto& [texel, radiance] : found->dimmed) {
      for (int c = 0; c < 3; ++c) rest->at(texel.x, texel.y)[static_cast<std::size_t>(c)] = radiance[c];
    }
    apart.suns.push_back(found->sun);
  }
  return apart;
}

}  // namespace footprint
