// See radiance_stack.hpp.
#include "renderer/environment/radiance_stack.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/Core>
#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "renderer/environment/octahedral.hpp"

namespace footprint {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int largest_map = 512, smallest_finest_map = 64, coarsest_map = 8;
constexpr int irradiance_map = 34;
constexpr int irradiance_source_width = 128;
constexpr double texels_a_deviation = 2.0;
constexpr double reach = 12.0;  // a lobe is cut off where it has fallen to e^-12

// The environment's light in rows of columns: what the sums over lobes run over.
struct Source {
  int width, height;
  Eigen::ArrayXf column_x, column_z;         // of unit vectors in the horizontal plane
  std::vector<double> row_sine, row_cosine;  // of the polar angle
  std::vector<double> row_solid_angle;
  std::array<Eigen::ArrayXXf, 3> radiance;  // one column of the array a row of the map
};

Source source_of(const Environment& environment, int width) {
  const Image map = resampled_environment(*environment.radiance, width, width / 2);
  Source s{width, width / 2, Eigen::ArrayXf(width), Eigen::ArrayXf(width), {}, {}, row_solid_angles(width, width / 2),
           {}};
  for (int x = 0; x < width; ++x) {
    const glm::dvec3 d = environment_direction(environment, (x + 0.5) / width, 0.5);
    s.column_x[x] = static_cast<float>(d.x);
    s.column_z[x] = static_cast<float>(d.z);
  }
  for (int y = 0; y < s.height; ++y) {
    s.row_sine.push_back(std::sin(pi * (y + 0.5) / s.height));
    s.row_cosine.push_back(std::cos(pi * (y + 0.5) / s.height));
  }
  for (std::size_t c = 0; c < 3; ++c) {
    s.radiance.at(c).resize(width, s.height);
    for (int y = 0; y < s.height; ++y) {
      for (int x = 0; x < width; ++x) s.radiance.at(c)(x, y) = map.at(x, y)[c];
    }
  }
  return s;
}

// Sums of weights, and of radiance times weight.
struct Sums {
  double weight = 0;
  glm::dvec3 radiance{0.0};
};

// Adds columns [first, first + count) of a row, `count` at most the width; columns wrap around.
template <typename Weight>  // weight(first, count): array of the columns' weights
void add_columns(const Source& s, int row, int first, int count, const Weight& weight, Sums& sums) {
  first = (first % s.width + s.width) % s.width;
  while (count > 0) {
    const int run = std::min(count, s.width - first);
    const Eigen::ArrayXf w = weight(first, run);
    const double solid_angle = s.row_solid_angle[static_cast<std::size_t>(row)];
    sums.weight += solid_angle * w.sum();
    for (int c = 0; c < 3; ++c) {
      sums.radiance[c] +=
          solid_angle * (w * s.radiance.at(static_cast<std::size_t>(c)).col(row).segment(first, run)).sum();
    }
    count -= run;
    first = 0;
  }
}

// The columns of a row within an angle of a direction, given the angle's cosine: how many, around the direction's own.
int columns_within(const Source& s, int row, const glm::dvec3& d, double cosine) {
  const auto r = static_cast<std::size_t>(row);
  const double horizontal = std::hypot(d.x, d.z) * s.row_sine[r];
  const double rest = cosine - d.y * s.row_cosine[r];
  if (rest <= -horizontal) return s.width;
  if (rest >= horizontal) return 0;
  return std::min(2 * (static_cast<int>(std::acos(rest / horizontal) / (2.0 * pi) * s.width) + 1), s.width);
}

// The mean over a vMF lobe. Rows and columns that it does not reach are left out; the weights' sum is divided by, so
// that a constant environment keeps its radiance to rounding.
glm::dvec3 lobe_mean(const Environment& environment, const Source& s, const glm::dvec3& d, double sharpness) {
  const double cosine = std::max(1.0 - reach / sharpness, -1.0);
  const double angle = std::acos(cosine);
  const double polar = std::acos(std::clamp(d.y, -1.0, 1.0));
  const int from = std::max(static_cast<int>((polar - angle) / pi * s.height) - 1, 0);
  const int to = std::min(static_cast<int>((polar + angle) / pi * s.height) + 1, s.height - 1);
  const int middle = static_cast<int>(environment_place(environment, d).x * s.width);
  Sums sums;
  for (int row = from; row <= to; ++row) {
    const auto r = static_cast<std::size_t>(row);
    const auto along = static_cast<float>(sharpness * (d.y * s.row_cosine[r] - 1.0));
    const auto x = static_cast<float>(sharpness * d.x * s.row_sine[r]);
    const auto z = static_cast<float>(sharpness * d.z * s.row_sine[r]);
    const int count = columns_within(s, row, d, cosine);
    add_columns(
        s, row, middle - count / 2, count,
        [&](int first, int run) -> Eigen::ArrayXf {
          return (along + x * s.column_x.segment(first, run) + z * s.column_z.segment(first, run)).exp();
        },
        sums);
  }
  return sums.weight > 0.0 ? sums.radiance / sums.weight : glm::dvec3(environment_radiance(environment, d));
}

// The mean over Lambert's lobe: irradiance over pi.
glm::dvec3 cosine_mean(const Source& s, const glm::dvec3& n) {
  Sums sums;
  for (int row = 0; row < s.height; ++row) {
    const auto r = static_cast<std::size_t>(row);
    const auto along = static_cast<float>(n.y * s.row_cosine[r]);
    const auto x = static_cast<float>(n.x * s.row_sine[r]);
    const auto z = static_cast<float>(n.z * s.row_sine[r]);
    add_columns(
        s, row, 0, s.width,
        [&](int first, int run) -> Eigen::ArrayXf {
          return (along + x * s.column_x.segment(first, run) + z * s.column_z.segment(first, run)).max(0.0F);
        },
        sums);
  }
  return sums.radiance / sums.weight;
}

template <typename Mean>  // mean(direction)
Image octahedral_map(int size, const Mean& mean) {
  Image map(size, size, 4, 1.0F);
  tbb::parallel_for(0, size, [&](int y) {
    for (int x = 0; x < size; ++x) {
      const glm::dvec3 value = mean(bordered_texel_direction(size, x, y));
      for (int c = 0; c < 3; ++c) map.at(x, y)[static_cast<std::size_t>(c)] = static_cast<float>(value[c]);
    }
  });
  return map;
}

// The sharpness to filter a texel with, so that it has `sharpness` after the linear interpolation between texels, which
// adds a sixth of their squared distance to the variance.
double narrowed(double sharpness, int size, const glm::dvec3& d) {
  const double texel = octahedral_stretch(d) / ((size - 2.0) * (size - 2.0));  // solid angle
  return 1.0 / (1.0 / sharpness - texel / 6.0);
}

// Octahedral maps have one texel for each of the 4 pi / (size - 2)^2 on average.
double finest_sharpness(int size) {
  const double texel = 4.0 * pi / ((size - 2.0) * (size - 2.0));
  return 1.0 / (texels_a_deviation * texels_a_deviation * texel);
}

}  // namespace

RadianceStack prefilter_environment(const Environment& environment, const Progress& progress) {
  const int wanted = static_cast<int>(std::bit_ceil(static_cast<unsigned>(environment.radiance->width)));
  const int finest = std::clamp(wanted, smallest_finest_map, largest_map);
  RadianceStack stack;
  stack.layers.resize(2);
  stack.finest_sharpness = static_cast<float>(finest_sharpness(finest));
  stack.mean = glm::vec3(mean_radiance(*environment.radiance));
  double sharpness = stack.finest_sharpness;
  for (int size = finest; size >= coarsest_map; size /= 2) {
    // Four columns of the source to a texel of the map at the equator, and twice its own size for the finest.
    const Source source = source_of(environment, size == finest ? 2 * size : 4 * size);
    for (std::vector<Image>& layer : stack.layers) {
      progress("prefiltering the environment", 1.0 - static_cast<double>(size) / finest);
      layer.push_back(octahedral_map(
          size, [&](const glm::dvec3& d) { return lobe_mean(environment, source, d, narrowed(sharpness, size, d)); }));
      sharpness /= 2.0;
    }
  }
  const Source source = source_of(environment, irradiance_source_width);
  stack.irradiance = octahedral_map(irradiance_map, [&](const glm::dvec3& n) { return cosine_mean(source, n); });
  return stack;
}

}  // namespace footprint
