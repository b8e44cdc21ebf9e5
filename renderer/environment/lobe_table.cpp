// GGX's visible normals by quadrature: once slopes are divided by alpha, wo reflected by them fills a spherical cap
// evenly (Dupuy and Benyoub 2023), z from -wo.z to 1. f cos = F D G', and dwi = 4 (h.wo) dh: what a lobe reflects is 4
// times its visible area times the mean of F G' over the cap.
#include "renderer/environment/lobe_table.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

namespace footprint {
namespace {

using std::numbers::pi;

constexpr int columns = 64, rows = 32;
constexpr int rings = 24, sectors = 24;        // of each part, of one half of the cap: the other is its mirror image
constexpr double narrowest_alpha = 1e-3;       // smallest_alpha of common_lobes.glsl
constexpr double hemisphere_sharpness = 1.83;  // of environment_stack.glsl
constexpr std::size_t geometries = no_geometry + 1;

// G2 / (4 n.l n.v) times n.l (Heitz 2014, equation 99), the axis along z.
double smith_factor(double alpha2, double nl, double nv) {
  nv = std::max(nv, 1e-4);
  const double masked =
      nl * std::sqrt(alpha2 + (1.0 - alpha2) * nv * nv) + nv * std::sqrt(alpha2 + (1.0 - alpha2) * nl * nl);
  return 0.5 * nl / std::max(masked, 1e-12);
}

// Tan 2005 under the bound of a V-cavity's masking.
double tan_factor(double nh, double oh, double nv) {
  return std::min(1.0 / std::max(nv, 1e-3), 2.0 * std::max(nh, 0.0) / std::max(oh, 1e-6));
}

// The mean of max(h.wo, 0) over GGX's normals, c the cosine of view and axis (Walter 2007's Smith term).
double visible_area(double c, double alpha2) {
  const double root = std::sqrt(c * c + alpha2 * (1.0 - c * c));
  return c >= 0.0 ? 0.5 * (root + c) : 0.5 * alpha2 * (1.0 - c * c) / (root - c);
}

// What one part of a lobe reflects under one geometry factor.
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
  const double z = 1.0 - u * (1.0 + view.stretched.z);
  const double sine = std::sqrt(std::max(1.0 - z * z, 0.0));
  const glm::dvec3 cap = glm::dvec3(sine * std::cos(azimuth), sine * std::sin(azimuth), z) + view.stretched;
  const glm::dvec3 h = glm::normalize(glm::dvec3(view.alpha * cap.x, view.alpha * cap.y, std::max(cap.z, 1e-9)));
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

}  // namespace

double lobe_view(int x, int count) {
  const double along = 2.0 * x / (count - 1) - 1.0;
  return along * std::abs(along);
}

double lobe_width(int y, int count) {
  const double narrowest = std::sqrt(narrowest_alpha);
  return std::pow(narrowest + (1.0 - narrowest) * y / (count - 1), 2.0);
}

LobeTable make_lobe_table() {
  LobeTable table;
  for (std::size_t layer = 0; layer < 2 * geometries; ++layer) table.layers.emplace_back(columns, rows, 4);
  tbb::parallel_for(0, rows, [&](int y) {
    for (int x = 0; x < columns; ++x) {
      const View view(lobe_view(x, columns), lobe_width(y, rows));
      const double scale = 4.0 * visible_area(view.c, view.alpha * view.alpha) * 0.5 / (rings * sectors);
      for (int part = 0; part < 2; ++part) {
        const std::array<Sum, geometries> sums = sums_of(view, part);
        for (std::size_t g = 0; g < sums.size(); ++g)
          std::ranges::copy(texel_of(sums[g], view, scale),
                            table.layers[2 * g + static_cast<std::size_t>(part)].at(x, y).begin());
      }
    }
  });
  return table;
}

}  // namespace footprint
