// Sums over facets drawn with a seed of their own, and interpolates between directions as the shader does.
#include "methods/iwasaki_sg/study/effective_brdf.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "methods/iwasaki_sg/lobe_fit.hpp"
#include "methods/iwasaki_sg/material_table.hpp"
#include "methods/iwasaki_sg/spherical_gaussian.hpp"
#include "renderer/core/numbers.hpp"
#include "renderer/lobes/lobe.hpp"
#include "renderer/microgeometry/direction_grid.hpp"
#include "renderer/microgeometry/microgeometry.hpp"

namespace footprint::iwasaki_sg {
namespace {

constexpr double least_area = 1e-6;  // of the patch, below which a direction sees nothing

constexpr std::size_t random_count = 192;  // directions to the light, and to the viewer
constexpr std::size_t reference_facets = 131'072;
constexpr double least_height = 0.05;  // cosine: 3 degrees over the horizon, where rays cross only a few periods
constexpr std::uint64_t reference_seed = 12'345;  // differs from the method's

// One bin per triangle with samples, which has its own normal instead of the mean over a cell.
BinnedFacets by_triangles(const Patch& patch, FacetSamples samples) {
  BinnedFacets out;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::uint32_t triangle = samples.triangles[i];
    if (i == 0 || triangle != samples.triangles[i - 1]) {
      const std::uint8_t paint = patch.paints.empty() ? std::uint8_t{0} : patch.paints[triangle];
      out.bins.push_back({facet_plane(patch, triangle).normal, paint, i, i});
    }
    out.bins.back().end = i + 1;
  }
  out.samples = std::move(samples);
  return out;
}

// Uniform over the directions above `least_height`.
std::vector<glm::dvec3> random_directions(std::size_t count) {
  std::mt19937_64 random(reference_seed);
  std::vector<glm::dvec3> directions;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = 1.0 - (1.0 - least_height) * uniform(random), azimuth = 2.0 * std::numbers::pi * uniform(random);
    const double sine = std::sqrt(1.0 - z * z);
    directions.emplace_back(sine * std::cos(azimuth), sine * std::sin(azimuth), z);
  }
  return directions;
}

// The base lobe, widened by the lobe of normals: slope variances add.
double widened(const Lobe& base, const SphericalGaussian& lobe, const glm::dvec3& h) {
  const float variance = lobe_variance(base) + static_cast<float>(1.0 / lobe.sharpness);
  return lobe_density(lobe_from_variance(base.distribution, variance), one_minus_dot(lobe.axis, h));
}

constexpr std::size_t most_rows = 16'384;

// The densities at all normals for one half vector.
Eigen::VectorXd densities(const Lobe& lobe, const std::vector<glm::dvec3>& normals, const glm::dvec3& h) {
  Eigen::VectorXd row(static_cast<Eigen::Index>(normals.size()));
  for (std::size_t i = 0; i < normals.size(); ++i)
    row[static_cast<Eigen::Index>(i)] = lobe_density(lobe, one_minus_dot(normals[i], h));
  return row;
}

// Rows at equal distances of all pairs of directions.
Eigen::MatrixXd some_rows(const Lobe& lobe, const std::vector<glm::dvec3>& normals, int side) {
  const std::vector<glm::dvec3> directions = direction_grid(side);
  const std::size_t pairs = directions.size() * directions.size(), count = std::min(pairs, most_rows);
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(normals.size()), static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t pair = i * pairs / count;
    const glm::dvec3 sum = directions[pair / directions.size()] + directions[pair % directions.size()];
    rows.col(static_cast<Eigen::Index>(i)) = densities(lobe, normals, glm::normalize(sum));
  }
  return rows;
}

// The light from wi that a lobe of normals reflects, with the half vector h.
glm::dvec3 convolved(const FacetReflection& reflection, const SphericalGaussian& fitted, const glm::dvec3& h,
                     const glm::dvec3& wi, bool approximate) {
  const SphericalGaussian lobe{fitted.axis, own_sharpness(fitted.sharpness)};
  if (const auto* const base = std::get_if<Lobe>(&reflection)) return glm::dvec3(widened(*base, lobe, h));
  if (const auto* const table = std::get_if<TabulatedLobes>(&reflection)) {
    glm::dvec3 sum(0.0);
    for (const ColorLobe& own : table->lobes) {
      sum += glm::dvec3(own.amplitude) * convolution(lobe, SphericalGaussian{h, own.sharpness});
    }
    const double theta_d = std::acos(std::clamp(glm::dot(wi, h), 0.0, 1.0));
    return glm::dvec3(table->diffuse) + sum * rise_at(*table, theta_d) / vmf_integral(lobe.sharpness);
  }
  double sum = 0.0;
  for (const BrdfLobe& own : std::get<std::vector<BrdfLobe>>(reflection)) {
    const SphericalGaussian about_h{h, own.sharpness};
    sum += own.amplitude * (approximate ? approximate_convolution(lobe, about_h) : convolution(lobe, about_h));
  }
  return glm::dvec3(sum / vmf_integral(lobe.sharpness));
}

// `value` of pairs of cells, interpolated as the shader does.
template <class Value>
glm::dvec3 between(const glm::dvec3& wi, const glm::dvec3& wo, int side, const Value& value) {
  const GridCells in = cells_around(wi, side), out = cells_around(wo, side);
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t o = 0; o < 4; ++o)
      sum += in.weights.at(i) * out.weights.at(o) * value(in.cells.at(i), out.cells.at(o));
  }
  return sum;
}

}  // namespace

LowRankLobe::LowRankLobe(const Lobe& lobe, const LowRank& sizes)
    : lobe_(lobe), side_(sizes.normals), normals_(direction_grid(sizes.normals)) {
  const Eigen::MatrixXd rows = some_rows(lobe, normals_, sizes.side);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(rows * rows.transpose());
  vectors_ = solver.eigenvectors().rightCols(std::min<Eigen::Index>(sizes.values, rows.rows()));
}

Eigen::VectorXd LowRankLobe::row(const glm::dvec3& h) const {
  return vectors_.transpose() * densities(lobe_, normals_, h);
}

double LowRankLobe::density(const Eigen::VectorXd& row, const glm::dvec3& normal) const {
  const GridCells around = cells_around(normal, side_);
  double sum = 0.0;
  for (std::size_t i = 0; i < around.cells.size(); ++i)
    sum += around.weights.at(i) * vectors_.row(static_cast<Eigen::Index>(around.cells.at(i))).dot(row);
  return sum;
}

std::size_t LowRankLobe::byte_count(const LowRank& sizes) {
  const auto directions = static_cast<std::size_t>(sizes.side) * static_cast<std::size_t>(sizes.side);
  const auto normals = static_cast<std::size_t>(sizes.normals) * static_cast<std::size_t>(sizes.normals);
  return (directions * (directions + 1) / 2 + normals) * static_cast<std::size_t>(sizes.values) * sizeof(float);
}

FacetSum::FacetSum(const Material& material, const TableSettings& settings, BinnedFacets facets,
                   std::vector<glm::dvec3> directions, const Progress& progress)
    : bvndf_(make_bvndf(material.microgeometry->patch, std::move(facets), std::move(directions), progress)),
      lobe_{lobe_of(material)},
      support_(lobe_support(lobe_)),
      table_(material.microgeometry->brdf.get()),
      settings_(settings) {}

glm::dvec3 FacetSum::operator()(std::size_t wi, std::size_t wo) const {
  const glm::dvec3 to_light = bvndf_.directions[wi], to_viewer = bvndf_.directions[wo];
  const double area = bvndf_.visible_area[wo];
  glm::dvec3 sum(0.0);
  if (area < least_area * bvndf_.total_area()) return sum;
  const glm::dvec3 h = glm::normalize(to_light + to_viewer);
  const Eigen::VectorXd row = compressed_ ? compressed_->row(h) : Eigen::VectorXd();
  const auto density_at = [&](const glm::dvec3& n) {
    if (table_ != nullptr) return 1.0;
    if (compressed_) return compressed_->density(row, n);
    const double u = one_minus_dot(n, h);
    return u < support_ ? lobe_density(lobe_, u) : 0.0;
  };
  for (std::size_t i = 0; i < bvndf_.bins.size(); ++i) {
    const glm::dvec3& n = bvndf_.bins[i].normal;
    const double cosine_i = glm::dot(n, to_light), cosine_o = glm::dot(n, to_viewer);
    if (cosine_i <= 0.0 || cosine_o <= 0.0) continue;
    const double density = density_at(n);
    if (density == 0.0) continue;
    const double seen = bvndf_.gamma(i, wi, wo) * cosine_o * (settings_.cosines == Cosines::published ? cosine_i : 1.0);
    if (seen == 0.0) continue;
    const glm::vec3& paint = settings_.paints[bvndf_.bins[i].paint].specular;
    const glm::dvec3 own = table_ != nullptr ? glm::dvec3(table_->at(n, to_light, to_viewer)) : glm::dvec3(density);
    sum += seen * glm::dvec3(settings_.channels == 1 ? glm::vec3(paint.r) : paint) * own;
  }
  return sum / area;
}

BrdfFunction dense_table(const Material& material, const TableSettings& settings, int side, const Progress& progress,
                         const std::optional<LowRank>& compressed) {
  const Patch& patch = material.microgeometry->patch;
  FacetSum sum(material, settings, bin_facets(patch, sample_facets(patch, settings.facets, settings.seed)),
               direction_grid(side), progress);
  if (compressed) sum.compress(*compressed);
  const bool with_cosine = settings.cosines == Cosines::published;
  const std::size_t n = sum.directions().size();
  std::vector<glm::vec3> values(n * n);  // [wi][wo]
  tbb::parallel_for(std::size_t{0}, n, [&](std::size_t wi) {
    const double scale = with_cosine ? 1.0 / sum.directions()[wi].z : 1.0;
    for (std::size_t wo = 0; wo < n; ++wo) values[wi * n + wo] = glm::vec3(scale * sum(wi, wo));
  });
  return [side, n, with_cosine, values = std::move(values)](const glm::dvec3& wi, const glm::dvec3& wo) {
    const auto value = [&](std::size_t i, std::size_t o) { return glm::dvec3(values[i * n + o]); };
    return between(wi, wo, side, value) * (with_cosine ? wi.z : 1.0);
  };
}

std::size_t dense_table_bytes(int side, std::size_t channels) {
  const auto n = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  return n * n * channels * sizeof(float);
}

double relative_error(const Material& material, const TableSettings& settings, const BrdfFunction& brdf) {
  const Patch& patch = material.microgeometry->patch;
  const FacetSum reference(material, settings,
                           by_triangles(patch, sample_facets(patch, reference_facets, reference_seed)),
                           random_directions(2 * random_count), no_progress);
  std::vector<double> away(random_count), all(random_count);
  tbb::parallel_for(std::size_t{0}, random_count, [&](std::size_t i) {
    for (std::size_t o = random_count; o < 2 * random_count; ++o) {
      const glm::dvec3 sum = reference(i, o);
      const glm::dvec3 difference = brdf(reference.directions()[i], reference.directions()[o]) - sum;
      away[i] += glm::dot(difference, difference);
      all[i] += glm::dot(sum, sum);
    }
  });
  const double whole = std::accumulate(all.begin(), all.end(), 0.0);
  return whole > 0.0 ? std::sqrt(std::accumulate(away.begin(), away.end(), 0.0) / whole) : 0.0;
}

FacetReflection facet_reflection(const Material& material, const Options& options) {
  if (is_tabulated(material)) return lobes_of(*material.microgeometry->brdf);
  const Lobe lobe = lobe_of(material);
  if (options.word("lobe") == "sg") return lobes_of(lobe);
  return lobe;
}

BrdfFunction effective_brdf(const MaterialTable& table, const TableSettings& settings, FacetReflection reflection,
                            bool approximate) {
  const bool with_cosine = settings.cosines == Cosines::published;
  return [&table = table.amplitudes, side = settings.side, directions = direction_grid(settings.side), with_cosine,
          reflection = std::move(reflection), approximate](const glm::dvec3& wi, const glm::dvec3& wo) {
    const double length = glm::length(wi + wo);
    glm::dvec3 sum(0.0);
    if (length < 1e-4) return sum;
    for (std::size_t j = 0; j < table.lobes.size(); ++j) {
      // The mass; a table that includes the cosine to the light stores it over that of the surface.
      const auto mass = [&](std::size_t i, std::size_t o) {
        glm::dvec3 own;
        for (std::size_t c = 0; c < 3; ++c) own[static_cast<int>(c)] = table.mass(j, table.channels == 1 ? 0 : c, i, o);
        return own / (with_cosine ? directions[i].z : 1.0);
      };
      sum += between(wi, wo, side, mass) * convolved(reflection, table.lobes[j], (wi + wo) / length, wi, approximate);
    }
    return with_cosine ? sum * wi.z : sum;
  };
}

}  // namespace footprint::iwasaki_sg
