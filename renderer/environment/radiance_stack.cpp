// Maps are filtered from sharp to wide, each from the one before it. Lobes are integrated over visible normals.
#include "renderer/environment/radiance_stack.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

namespace footprint {
namespace {

using std::numbers::pi;
constexpr int largest_map = 512, smallest_finest_map = 64, coarsest_map = 8;
constexpr int irradiance_map = 34;
constexpr int irradiance_source_width = 128;
constexpr int most_columns = 1024;
constexpr double texels_a_deviation = 2.0;
constexpr double source_texels_a_deviation = 1.6;  // a Gaussian sampled so is summed to rounding
constexpr double reach = 12.0;                     // a lobe is cut off where it has fallen to e^-12

// The light of the environment, over which lobes are summed.
struct Source {
  int width, height;
  Eigen::ArrayXf column_x, column_z;         // of unit vectors in the horizontal plane
  std::vector<double> row_sine, row_cosine;  // of the polar angle
  Eigen::Array4Xf texels;                    // row by row: radiance and 1, times the texel's solid angle
};

Source source_of(const Environment& environment, int width) {
  const Image map = resampled_environment(*environment.radiance, width, width / 2);
  Source s{
      width, width / 2, Eigen::ArrayXf(width), Eigen::ArrayXf(width), {}, {}, Eigen::Array4Xf(4, width * width / 2)};
  for (int x = 0; x < width; ++x) {
    const glm::dvec3 d = environment_direction(environment, (x + 0.5) / width, 0.5);
    s.column_x[x] = static_cast<float>(d.x);
    s.column_z[x] = static_cast<float>(d.z);
  }
  const std::vector<double> solid_angles = row_solid_angles(width, s.height);
  for (int y = 0; y < s.height; ++y) {
    s.row_sine.push_back(std::sin(pi * (y + 0.5) / s.height));
    s.row_cosine.push_back(std::cos(pi * (y + 0.5) / s.height));
    for (int x = 0; x < width; ++x) {
      const auto texel = map.at(x, y);
      s.texels.col(y * width + x) = Eigen::Array4f(texel[0], texel[1], texel[2], 1.0F) *
                                    static_cast<float>(solid_angles[static_cast<std::size_t>(y)]);
    }
  }
  return s;
}

// The product of a direction and the unit vectors of a row's columns is a + x column_x + z column_z.
struct RowProducts {
  float a, x, z;
};

RowProducts row_products(const Source& s, int row, const glm::dvec3& d) {
  const auto r = static_cast<std::size_t>(row);
  return {static_cast<float>(d.y * s.row_cosine[r]), static_cast<float>(d.x * s.row_sine[r]),
          static_cast<float>(d.z * s.row_sine[r])};
}

// Adds columns [first, first + count) of a row, `count` at most the width; columns wrap around. `weight` turns an array
// of products into weights.
template <typename Weight>
void add_columns(const Source& s, int row, int first, int count, const RowProducts& p, const Weight& weight,
                 Eigen::Array4d& sum) {
  using Weights = Eigen::Array<float, Eigen::Dynamic, 1, 0, most_columns, 1>;  // on the stack
  first = (first % s.width + s.width) % s.width;
  while (count > 0) {
    const int run = std::min(count, s.width - first);
    const Weights w = weight(p.a + p.x * s.column_x.segment(first, run) + p.z * s.column_z.segment(first, run));
    Eigen::Array4f of_run = Eigen::Array4f::Zero();
    for (int i = 0; i < run; ++i) of_run += w[i] * s.texels.col(row * s.width + first + i);
    sum += of_run.cast<double>();
    count -= run;
    first = 0;
  }
}

glm::dvec3 mean_of(const Eigen::Array4d& sum) { return glm::dvec3(sum[0], sum[1], sum[2]) / sum[3]; }

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
  const int middle = static_cast<int>(environment_uv(environment, d).x * s.width);
  const auto k = static_cast<float>(sharpness);
  Eigen::Array4d sum = Eigen::Array4d::Zero();
  for (int row = from; row <= to; ++row) {
    const int count = columns_within(s, row, d, cosine);
    const auto weight = [k](const auto& products) { return (k * (products - 1.0F)).exp(); };
    add_columns(s, row, middle - count / 2, count, row_products(s, row, d), weight, sum);
  }
  return sum[3] > 0.0 ? mean_of(sum) : glm::dvec3(environment_radiance(environment, d));
}

// The mean over Lambert's lobe: irradiance over pi.
glm::dvec3 cosine_mean(const Source& s, const glm::dvec3& n) {
  const auto weight = [](const auto& products) { return products.max(0.0F); };
  Eigen::Array4d sum = Eigen::Array4d::Zero();
  for (int row = 0; row < s.height; ++row) add_columns(s, row, 0, s.width, row_products(s, row, n), weight, sum);
  return mean_of(sum);
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

// The sharpness to filter a texel with, so that it has `sharpness` all in all: linear interpolation between texels adds
// a sixth of their squared distance to the variance, and the source's texels a twelfth of theirs.
double narrowed(double sharpness, int size, int source_width, const glm::dvec3& d) {
  const double texel = octahedral_stretch(d) / ((size - 2.0) * (size - 2.0));  // solid angle
  const double source_edge = 2.0 * pi / source_width;
  const double source = source_edge * source_edge * (1.0 - 0.5 * d.y * d.y);  // columns meet at the poles
  return 1.0 / (1.0 / sharpness - texel / 6.0 - source / 12.0);
}

// Even, so that rows are as wide as columns.
int source_width(double sharpness) {
  return 2 * static_cast<int>(std::ceil(pi * source_texels_a_deviation * std::sqrt(sharpness)));
}

// Octahedral maps have one texel for each of the 4 pi / (size - 2)^2 on average.
double finest_sharpness(int size) {
  const double texel = 4.0 * pi / ((size - 2.0) * (size - 2.0));
  return 1.0 / (texels_a_deviation * texels_a_deviation * texel);
}

constexpr int columns = 64, rows = 32;
constexpr int rings = 24, sectors = 24;        // of each part, of one half of the cap: the other is its mirror image
constexpr double narrowest_alpha = 1e-3;       // smallest_alpha of common_lobes.glsl
constexpr double hemisphere_sharpness = 1.83;  // of environment_stack.glsl
constexpr std::size_t geometries = no_geometry + 1;

// The energies of one part of a lobe under one geometry factor.
struct Sum {
  double energy = 0, schlick = 0;
  glm::dvec2 direction{0.0};  // along the view's part across the axis, and along the axis
};

struct View {
  double c, alpha;
  glm::dvec3 wo, stretched;
  View(double cosine, double width)
      : c(cosine),
        alpha(width),
        wo(std::sqrt(1.0 - c * c), 0.0, c),
        stretched(glm::normalize(glm::dvec3(alpha * wo.x, 0.0, c))) {}
};

// Adds the node at `u` of the cap's area and `azimuth` to the sum of each geometry.
void add_node(std::array<Sum, geometries>& sums, const View& view, double u, double azimuth) {
  const glm::dvec3 h = visible_normal(view.stretched, view.alpha, u, azimuth);
  const double oh = glm::dot(h, view.wo);
  const glm::dvec3 wi = 2.0 * oh * h - view.wo;
  if (wi.z <= 0.0) return;
  const double schlick = std::pow(1.0 - std::clamp(oh, 0.0, 1.0), 5.0);
  std::array<double, geometries> factors{};
  for (int step = 0; step <= smith_steps; ++step) {
    const double base = view.alpha * step / smith_steps;
    factors.at(static_cast<std::size_t>(step)) = smith_factor(base * base, wi.z, view.c);
  }
  factors[tan_geometry] = tan_factor(h.z, oh, view.c);
  factors[no_geometry] = 1.0;
  for (std::size_t g = 0; g < factors.size(); ++g) {
    sums[g].energy += factors[g];
    sums[g].schlick += factors[g] * schlick;
    sums[g].direction += factors[g] * glm::dvec2(wi.x, wi.z);
  }
}

// The texel of a sum over nodes, `scale` the energy of one where its factor is 1.
std::array<float, 4> texel_of(const Sum& sum, const View& view, double scale) {
  const double size = glm::length(sum.direction);
  const double mirrored = std::atan2(-view.wo.x, view.c);
  const bool lit = size > 1e-12;
  const double r = lit ? std::min(size / sum.energy, 1.0 - 1e-9) : 0.0;
  const double kappa = std::max(r * (3.0 - r * r) / (1.0 - r * r), hemisphere_sharpness);
  const double turn = lit ? std::atan2(sum.direction.x, sum.direction.y) - mirrored : 0.0;
  return {static_cast<float>(scale * (sum.energy - sum.schlick)), static_cast<float>(scale * sum.schlick),
          static_cast<float>(turn), static_cast<float>(std::log2(kappa * view.alpha * view.alpha))};
}

std::array<Sum, geometries> sums_of(const View& view, int part) {
  std::array<Sum, geometries> sums;
  for (int ring = 0; ring < rings; ++ring) {
    const double u = 0.5 * (part + (ring + 0.5) / rings);
    for (int sector = 0; sector < sectors; ++sector) add_node(sums, view, u, pi * (sector + 0.5) / sectors);
  }
  return sums;
}

double sign_of(double x) { return x >= 0.0 ? 1.0 : -1.0; }

glm::dvec2 folded(const glm::dvec2& p) {
  return {(1.0 - std::abs(p.y)) * sign_of(p.x), (1.0 - std::abs(p.x)) * sign_of(p.y)};
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
    for (std::vector<Image>& layer : stack.layers) {
      progress("prefiltering the environment", 1.0 - static_cast<double>(size) / finest);
      const Source source = source_of(environment, source_width(sharpness));
      layer.push_back(octahedral_map(size, [&](const glm::dvec3& d) {
        return lobe_mean(environment, source, d, narrowed(sharpness, size, source.width, d));
      }));
      sharpness /= 2.0;
    }
  }
  const Source source = source_of(environment, irradiance_source_width);
  stack.irradiance = octahedral_map(irradiance_map, [&](const glm::dvec3& n) { return cosine_mean(source, n); });
  return stack;
}

double lobe_view(int x, int count) {
  const double along = 2.0 * x / (count - 1) - 1.0;
  return along * std::abs(along);
}

double lobe_width(int y, int count) {
  const double narrowest = std::sqrt(narrowest_alpha);
  return std::pow(narrowest + (1.0 - narrowest) * y / (count - 1), 2.0);
}

double smith_factor(double alpha2, double nl, double nv) {
  nv = std::max(nv, 1e-4);
  const double masked =
      nl * std::sqrt(alpha2 + (1.0 - alpha2) * nv * nv) + nv * std::sqrt(alpha2 + (1.0 - alpha2) * nl * nl);
  return 0.5 * nl / std::max(masked, 1e-12);
}

double tan_factor(double nh, double oh, double nv) {
  return std::min(1.0 / std::max(nv, 1e-3), 2.0 * std::max(nh, 0.0) / std::max(oh, 1e-6));
}

double visible_area(double c, double alpha2) {
  const double root = std::sqrt(c * c + alpha2 * (1.0 - c * c));
  return c >= 0.0 ? 0.5 * (root + c) : 0.5 * alpha2 * (1.0 - c * c) / (root - c);
}

glm::dvec3 visible_normal(const glm::dvec3& stretched, double alpha, double u, double azimuth) {
  const double z = 1.0 - u * (1.0 + stretched.z);
  const double sine = std::sqrt(std::max(1.0 - z * z, 0.0));
  const glm::dvec3 cap = glm::dvec3(sine * std::cos(azimuth), sine * std::sin(azimuth), z) + stretched;
  return glm::normalize(glm::dvec3(alpha * cap.x, alpha * cap.y, std::max(cap.z, 1e-9)));
}

std::vector<Image> make_lobe_table() {
  std::vector<Image> layers(2 * geometries, Image(columns, rows, 4));
  tbb::parallel_for(0, rows, [&](int y) {
    for (int x = 0; x < columns; ++x) {
      const View view(lobe_view(x, columns), lobe_width(y, rows));
      const double scale = 4.0 * visible_area(view.c, view.alpha * view.alpha) * 0.5 / (rings * sectors);
      for (int part = 0; part < 2; ++part) {
        const std::array<Sum, geometries> sums = sums_of(view, part);
        for (std::size_t g = 0; g < sums.size(); ++g)
          std::ranges::copy(texel_of(sums[g], view, scale),
                            layers[2 * g + static_cast<std::size_t>(part)].at(x, y).begin());
      }
    }
  });
  return layers;
}

glm::dvec2 octahedral_uv(const glm::dvec3& direction) {
  const glm::dvec3 p = direction / (std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z));
  const glm::dvec2 flat(p.x, p.z);
  return 0.5 + 0.5 * (p.y >= 0.0 ? flat : folded(flat));
}

glm::dvec3 octahedral_direction(const glm::dvec2& uv) {
  glm::dvec2 p = 2.0 * uv - 1.0;
  // Across an edge the square goes on as itself, turned by half a turn about the edge's middle.
  if (std::abs(p.x) > 1.0) p = {2.0 * sign_of(p.x) - p.x, -p.y};
  if (std::abs(p.y) > 1.0) p = {-p.x, 2.0 * sign_of(p.y) - p.y};
  const double y = 1.0 - std::abs(p.x) - std::abs(p.y);
  if (y < 0.0) p = folded(p);
  return glm::normalize(glm::dvec3(p.x, y, p.y));
}

glm::dvec3 bordered_texel_direction(int size, int x, int y) {
  return octahedral_direction(glm::dvec2(x - 0.5, y - 0.5) / static_cast<double>(size - 2));
}

double octahedral_stretch(const glm::dvec3& direction) {
  // A face of the octahedron is flat and its normal has (|x| + |y| + |z|) / sqrt(3) to the direction; the square
  // shrinks it by sqrt(3) and has sides of 2.
  const double sum = std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z);
  return 4.0 * sum * sum * sum;
}

}  // namespace footprint
