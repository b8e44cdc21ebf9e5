// Image files, constants and an analytic sky as equirectangular maps; halving and solid angles of their texels.
#include "renderer/scene/environment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <memory>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>

#include "renderer/core/error.hpp"
#include "renderer/image/image_io.hpp"

namespace footprint {
namespace {

using std::numbers::pi;

// The overlaps of two divisions of an axis: target i gets `share` of source j.
struct Overlap {
  int target, source;
  double share;
};

// Edges are positions along the axis, increasing; shares are of the target's length.
std::vector<Overlap> overlaps(const std::vector<double>& source, const std::vector<double>& target) {
  std::vector<Overlap> out;
  std::size_t j = 0;
  for (std::size_t i = 0; i + 1 < target.size(); ++i) {
    while (j + 2 < source.size() && source[j + 1] <= target[i]) ++j;
    for (std::size_t k = j; k + 1 < source.size() && source[k] < target[i + 1]; ++k) {
      const double length = std::min(source[k + 1], target[i + 1]) - std::max(source[k], target[i]);
      if (length > 0.0) out.push_back({static_cast<int>(i), static_cast<int>(k), length / (target[i + 1] - target[i])});
    }
  }
  return out;
}

// The edges of `count` parts of an axis, edge i at `place` (i).
template <class Place>
std::vector<double> edges(int count, const Place& place) {
  std::vector<double> out;
  for (int i = 0; i <= count; ++i) out.push_back(place(i));
  return out;
}

std::vector<double> column_edges(int width) {
  return edges(width, [=](int i) { return static_cast<double>(i) / width; });
}

// In -cos theta, in which equal lengths are equal solid angles.
std::vector<double> row_edges(int height) {
  return edges(height, [=](int i) { return -std::cos(pi * i / height); });
}

void require_finite(const Image& image, const std::string& name) {
  const auto bad = std::ranges::find_if_not(image.texels, [](float value) { return std::isfinite(value); });
  if (bad == image.texels.end()) return;
  const auto texel = static_cast<std::size_t>(bad - image.texels.begin()) / static_cast<std::size_t>(image.channels);
  const auto width = static_cast<std::size_t>(image.width);
  throw Error(ErrorKind::usage, name,
              fmt::format("the texel in column {}, row {} is {}", texel % width, texel / width, *bad),
              "radiance must be finite: fix the image");
}

// Three channels of an image that has one or four; of four in place, as the largest take gigabytes.
Image with_three_channels(Image image) {
  if (image.channels == 1)
    return mapped(image, 3, [](const auto& in, const auto& out) { std::ranges::fill(out, in[0]); });
  for (std::size_t i = 0; i < image.texel_count(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) image.texels[3 * i + c] = image.texels[4 * i + c];
  }
  image.channels = 3;
  image.texels.resize(3 * image.texel_count());
  return image;
}

// Other layouts than latitude and longitude, by their shapes.
std::string_view probable_layout(int width, int height) {
  if (width == height) return ", and a square may be a mirror ball or an angular map";
  if (4 * height == 3 * width || 4 * width == 3 * height) return ", and 4:3 may be a cube map as a cross";
  if (width == 6 * height || height == 6 * width) return ", and 6:1 may be a cube map as a strip";
  return "";
}

// A latitude-longitude picture has twice as many columns as rows, and a sky more than one colour.
void add_shape_warnings(const Image& image, const std::string& name, std::vector<std::string>& warnings) {
  if (image.texel_count() == 1) return;
  if (std::abs(image.width - 2 * image.height) > 1) {
    warnings.push_back(
        fmt::format("{}: a latitude-longitude picture is 2:1, but this one is {} x {}{}: it is stretched "
                    "over the sphere; convert it if it has another layout",
                    name, image.width, image.height, probable_layout(image.width, image.height)));
  }
  const auto first = image.at(0, 0);
  for (std::size_t i = 0; i < image.texels.size(); ++i) {
    if (image.texels[i] != first[i % 3]) return;
  }
  warnings.push_back(fmt::format("{}: every texel has the same radiance", name));
}

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

// A von Mises-Fisher lobe instead of the disc, as wide as a third of a degree. A facing surface gets `sun_share` times
// the irradiance of the sky's mean radiance from a hemisphere.
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

// Adds the sun, and the ground that both light, to a map of the sky.
void add_sun_and_ground(Environment& sky, Image& map, const glm::dvec3& sun) {
  const glm::dvec3 mean = 2.0 * mean_radiance(map);  // over the upper half: the lower one is still black
  const glm::dvec3 irradiance = sun_share * pi * mean;
  const glm::dvec3 ground = ground_albedo * ground_color * (mean + irradiance * sun.y / pi);
  for_each_texel(map, [&](int x, int y) {
    const glm::dvec3 direction = environment_direction(sky, (x + 0.5) / map.width, (y + 0.5) / map.height);
    glm::dvec3 added = ground;
    if (direction.y >= 0.0) {
      const glm::dvec3 offset = direction - sun;
      added = irradiance * sun_color * sun_sharpness / (2.0 * pi) *
              std::exp(-0.5 * sun_sharpness * glm::dot(offset, offset));
    }
    for (int c = 0; c < 3; ++c) map.at(x, y)[static_cast<std::size_t>(c)] += static_cast<float>(added[c]);
  });
}

constexpr double least_share = 0.01;
constexpr double least_contrast = 10.0;
constexpr double largest_texel = 5e-4;  // steradians: 1.3 degrees per side
constexpr double smallest_disc = 0.5 * pi / 180.0;
constexpr double texels_in_disc = 1.5;

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
    std::vector<double> radiance;
    for (std::size_t i = 0; i < map_->texel_count(); ++i)
      radiance.push_back(static_cast<double>(map_->texels[3 * i]) + map_->texels[3 * i + 1] + map_->texels[3 * i + 2]);
    const auto texel = static_cast<int>(std::ranges::max_element(radiance) - radiance.begin());
    return {texel % map_->width, texel / map_->width};
  }

  [[nodiscard]] glm::dvec3 radiance(const glm::ivec2& texel) const {
    return glm::make_vec3(map_->at(texel.x, texel.y).data());
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
          look(glm::ivec2(x, y), radiance({x, y}), solid_angles_[static_cast<std::size_t>(y)]);
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

// The brightest sun of a sky; none if its light or its contrast is too little. all: the light of the whole sky before
// any sun was taken from it, above 0.
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

glm::dvec3 environment_direction(const Environment& environment, double u, double v) {
  const double azimuth = 2.0 * pi * (u - 0.5) - environment.rotation;
  const double polar = pi * v;
  return {std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth)};
}

glm::dvec2 environment_uv(const Environment& environment, const glm::dvec3& direction) {
  const double u = 0.5 + (std::atan2(direction.x, -direction.z) + environment.rotation) / (2.0 * pi);
  return {u - std::floor(u), std::acos(std::clamp(direction.y / glm::length(direction), -1.0, 1.0)) / pi};
}

glm::vec3 environment_radiance(const Environment& environment, const glm::dvec3& direction) {
  const Image& map = *environment.radiance;
  const glm::dvec2 uv = environment_uv(environment, direction);
  return glm::make_vec3(map.at(std::min(static_cast<int>(uv.x * map.width), map.width - 1),
                               std::min(static_cast<int>(uv.y * map.height), map.height - 1))
                            .data());
}

std::vector<double> row_solid_angles(int width, int height) {
  std::vector<double> out;
  out.reserve(static_cast<std::size_t>(height));
  // cos a - cos b as a product: near the poles the difference would cancel.
  for (int row = 0; row < height; ++row)
    out.push_back(2.0 * pi / width * 2.0 * std::sin(pi * (row + 0.5) / height) * std::sin(0.5 * pi / height));
  return out;
}

Image resampled_environment(const Image& radiance, int width, int height) {
  if (radiance.width == width && radiance.height == height) return radiance;
  std::vector<double> rows(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3, 0.0);
  const std::vector<Overlap> across = overlaps(column_edges(radiance.width), column_edges(width));
  for (const Overlap& down : overlaps(row_edges(radiance.height), row_edges(height))) {
    double* const target = &rows[static_cast<std::size_t>(down.target) * static_cast<std::size_t>(width) * 3];
    for (const Overlap& o : across) {
      const auto texel = radiance.at(o.source, down.source);
      for (std::size_t c = 0; c < 3; ++c)
        target[static_cast<std::size_t>(o.target) * 3 + c] += down.share * o.share * texel[c];
    }
  }
  Image out(width, height, 3);
  std::ranges::transform(rows, out.texels.begin(), [](double value) { return static_cast<float>(value); });
  return out;
}

glm::dvec3 mean_radiance(const Image& radiance) {
  const std::vector<double> solid_angles = row_solid_angles(radiance.width, radiance.height);
  glm::dvec3 sum(0.0);
  for (int y = 0; y < radiance.height; ++y) {
    glm::dvec3 row(0.0);
    for (int x = 0; x < radiance.width; ++x) row += glm::dvec3(glm::make_vec3(radiance.at(x, y).data()));
    sum += solid_angles[static_cast<std::size_t>(y)] * row;
  }
  return sum / (4.0 * pi);
}

Environment constant_environment(const glm::vec3& radiance) {
  Image map(1, 1, 3);
  map.texels = {radiance.r, radiance.g, radiance.b};
  return {.name = "constant", .radiance = std::make_shared<const Image>(std::move(map))};
}

Environment load_environment(const std::filesystem::path& file, std::vector<std::string>& warnings) {
  FileImage read = read_file_image(file, Transfer::declared);
  Image image = std::move(read.image);
  const std::string name = file.filename().string();
  for (const std::string& note : read.notes) warnings.push_back(fmt::format("{}: {}", name, note));
  if (image.channels == 2) {
    throw Error(ErrorKind::usage, file.string(), "has 2 channels", "give an environment with 1, 3 or 4 channels");
  }
  if (image.channels != 3) image = with_three_channels(std::move(image));
  require_finite(image, file.string());
  const auto is_negative = [](float value) { return value < 0.0F; };
  if (const auto count = std::ranges::count_if(image.texels, is_negative); count > 0)
    warnings.push_back(fmt::format("{}: {} negative values of radiance are taken as 0", name, count));
  std::ranges::replace_if(image.texels, is_negative, 0.0F);
  add_shape_warnings(image, name, warnings);
  if (image.width > largest_environment_width || image.height > largest_environment_width / 2) {
    warnings.push_back(fmt::format("{}: {} x {} texels are averaged down to {} x {}", name, image.width, image.height,
                                   largest_environment_width, largest_environment_width / 2));
    image = resampled_environment(image, largest_environment_width, largest_environment_width / 2);
  }
  return {.name = name, .radiance = std::make_shared<const Image>(std::move(image))};
}

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

SunsApart suns_apart(const Environment& environment) {
  SunsApart apart{.suns = {}, .rest = environment};
  const double all = all_channels(4.0 * pi * mean_radiance(*environment.radiance));
  if (!(all > 0.0) || !Sky(environment).has_small_texels()) return apart;
  std::shared_ptr<Image> rest;
  while (apart.suns.size() < most_small_suns) {
    const std::optional<Found> found = brightest_sun(Sky(apart.rest), all);
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
