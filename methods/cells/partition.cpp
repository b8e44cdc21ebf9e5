// Fits a mixture to the whole map. Then rounds of soft labels: each texel looks up the blocks that contain it, of all
// sizes and at a random shift, and is assigned to the parts that fit it best there.
#include "methods/cells/partition.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <stdexcept>

#include "renderer/bake/normal_chain.hpp"
#include "renderer/bake/slope_moments.hpp"
#include "renderer/image/mipmap.hpp"

namespace footprint::cells {
namespace {

constexpr std::size_t most_samples = 6000;  // of the mixture over the whole map
constexpr int starts = 3;
constexpr int steps = 60;       // of EM from each start
constexpr int block_sizes = 5;  // blocks of 2, 4, ... 32 texels

using Parts = std::array<double, most_parts>;
using Quadratics = std::array<Quadratic, most_parts>;

// Uniform in [0, 1); the standard's distributions may differ between libraries.
double uniform(std::mt19937& random) { return static_cast<double>(random()) / 4294967296.0; }

// exp(q - max) over its sum; returns the log of the sum.
double shares_of(const Quadratics& mixture, std::size_t parts, const glm::dvec2& p, Parts& out) {
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < parts; ++k) {
    out[k] = mixture[k].at(p);
    most = std::max(most, out[k]);
  }
  double sum = 0.0;
  for (std::size_t k = 0; k < parts; ++k) sum += out[k] = std::exp(out[k] - most);
  for (std::size_t k = 0; k < parts; ++k) out[k] /= sum;
  return most + std::log(sum);
}

// Points of the map that have a weight, at most most_samples, evenly drawn.
std::vector<glm::dvec2> sampled(std::span<const PlanePoint> points, std::mt19937& random) {
  std::vector<glm::dvec2> all;
  for (const PlanePoint& point : points)
    if (point.weight > 0.0) all.push_back(point.at);
  if (all.size() <= most_samples) return all;
  std::vector<glm::dvec2> some(most_samples);
  for (glm::dvec2& p : some) p = all[random() % all.size()];
  return some;
}

// Distant centres (Arthur and Vassilvitskii 2007, k-means++), each with the same share of the whole spread.
Quadratics spread_start(std::span<const glm::dvec2> samples, const PartitionSettings& settings, std::mt19937& random) {
  PlaneSums all;
  for (const glm::dvec2& p : samples) all.add(p, 1.0);
  const glm::dvec2 mean = all.first / all.weight;
  const double variance =
      std::max(0.5 * ((all.second.x + all.second.z) / all.weight - glm::dot(mean, mean)), 0.0) / settings.parts;
  std::vector<double> nearest(samples.size(), std::numeric_limits<double>::infinity());
  glm::dvec2 centre = samples[random() % samples.size()];
  Quadratics mixture{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(settings.parts); ++k) {
    const glm::dvec3 second(centre.x * centre.x + variance, centre.x * centre.y, centre.y * centre.y + variance);
    mixture[k] =
        log_density({.weight = 1.0, .first = centre, .second = second}, 1.0 / settings.parts, settings.variance);
    double total = 0.0;
    for (std::size_t j = 0; j < samples.size(); ++j) {
      const glm::dvec2 d = samples[j] - centre;
      nearest[j] = std::min(nearest[j], glm::dot(d, d) + 1e-12);
      total += nearest[j];
    }
    double left = uniform(random) * total;
    std::size_t j = 0;
    while (j + 1 < samples.size() && (left -= nearest[j]) > 0.0) ++j;
    centre = samples[j];
  }
  return mixture;
}

// EM of a mixture over the whole map, the likeliest of several starts.
Quadratics mixture_over(std::span<const PlanePoint> points, const PartitionSettings& settings) {
  std::mt19937 random(1);
  const std::vector<glm::dvec2> samples = sampled(points, random);
  Quadratics best{};
  if (samples.empty()) return best;
  const auto parts = static_cast<std::size_t>(settings.parts);
  const auto count = static_cast<double>(samples.size());
  double greatest = -std::numeric_limits<double>::infinity();
  for (int start = 0; start < starts; ++start) {
    Quadratics mixture = spread_start(samples, settings, random);
    double likelihood = 0.0;
    for (int step = 0; step < steps; ++step) {
      std::array<PlaneSums, most_parts> sums{};
      const double before = likelihood;
      likelihood = 0.0;
      Parts share{};
      for (const glm::dvec2& p : samples) {
        likelihood += shares_of(mixture, parts, p, share);
        for (std::size_t k = 0; k < parts; ++k) sums[k].add(p, share[k]);
      }
      for (std::size_t k = 0; k < parts; ++k)
        mixture[k] = log_density(sums[k], sums[k].weight / count, settings.variance);
      if (step > 0 && likelihood - before < 1e-5 * count) break;
    }
    if (likelihood <= greatest) continue;
    greatest = likelihood;
    best = mixture;
  }
  return best;
}

// The labels of a map, improved in rounds. Indices are of shifted texels, which wrap at the borders of the map.
class JointLabels {
 public:
  JointLabels(std::span<const PlanePoint> points, int width, int height, const PartitionSettings& settings,
              std::vector<float>& labels)
      : points_(points),
        width_(width),
        height_(height),
        parts_(static_cast<std::size_t>(settings.parts)),
        settings_(settings),
        labels_(&labels) {
    for (int size = 1; size <= block_sizes; ++size) {
      Blocks& blocks = blocks_.emplace_back();
      blocks.width = ((width - 1) >> size) + 1;
      blocks.height = ((height - 1) >> size) + 1;
      const std::size_t count = static_cast<std::size_t>(blocks.width) * static_cast<std::size_t>(blocks.height);
      blocks.sums.resize(count * parts_);
      blocks.density.resize(count * parts_);
    }
  }

  // `finest`: the index of the smallest block size that is used.
  void round(int shift_x, int shift_y, int finest) {
    shift_x_ = shift_x;
    shift_y_ = shift_y;
    sum_texels();
    for (std::size_t i = 1; i < blocks_.size(); ++i) sum_blocks(blocks_[i - 1], blocks_[i]);
    const double factor = 1.0 / (block_sizes - finest);
    for (int i = block_sizes - 1; i >= 0; --i) {
      const auto index = static_cast<std::size_t>(i);
      add_densities(blocks_[index], i + 1 < block_sizes ? &blocks_[index + 1] : nullptr, i >= finest ? factor : 0.0);
    }
    label_texels();
  }

 private:
  struct Blocks {
    int width = 0, height = 0;
    std::vector<PlaneSums> sums;     // parts_ for each block
    std::vector<Quadratic> density;  // the same: log density of this block and of all larger ones that contain it
  };

  [[nodiscard]] std::size_t first_part(const Blocks& blocks, int x, int y) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(blocks.width) + static_cast<std::size_t>(x)) *
           parts_;
  }
  [[nodiscard]] std::size_t texel(int x, int y) const {
    const int from_x = (x + width_ - shift_x_) % width_;
    const int from_y = (y + height_ - shift_y_) % height_;
    return static_cast<std::size_t>(from_y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(from_x);
  }

  void sum_texels() {
    Blocks& blocks = blocks_.front();
    tbb::parallel_for(0, blocks.height, [&](int row) {
      for (int column = 0; column < blocks.width; ++column) {
        PlaneSums* const sums = &blocks.sums[first_part(blocks, column, row)];
        std::fill_n(sums, parts_, PlaneSums{});
        for (int y = 2 * row; y < std::min(2 * row + 2, height_); ++y) {
          for (int x = 2 * column; x < std::min(2 * column + 2, width_); ++x) {
            const std::size_t i = texel(x, y);
            if (points_[i].weight <= 0.0) continue;
            for (std::size_t k = 0; k < parts_; ++k)
              sums[k].add(points_[i].at, points_[i].weight * static_cast<double>((*labels_)[i * parts_ + k]));
          }
        }
      }
    });
  }

  void sum_blocks(const Blocks& small, Blocks& large) const {
    std::ranges::fill(large.sums, PlaneSums{});
    for (int y = 0; y < small.height; ++y) {
      for (int x = 0; x < small.width; ++x) {
        for (std::size_t k = 0; k < parts_; ++k)
          large.sums[first_part(large, x / 2, y / 2) + k].add(small.sums[first_part(small, x, y) + k]);
      }
    }
  }

  void add_densities(Blocks& blocks, const Blocks* larger, double factor) const {
    tbb::parallel_for(0, blocks.height, [&](int y) {
      for (int x = 0; x < blocks.width; ++x) {
        const std::size_t first = first_part(blocks, x, y);
        double total = 0.0;
        for (std::size_t k = 0; k < parts_; ++k) total += blocks.sums[first + k].weight;
        for (std::size_t k = 0; k < parts_; ++k) {
          Quadratic& density = blocks.density[first + k];
          density = larger != nullptr ? larger->density[first_part(*larger, x / 2, y / 2) + k] : Quadratic{};
          if (factor <= 0.0 || total <= 0.0) continue;
          const PlaneSums& sums = blocks.sums[first + k];
          density.add(log_density(sums, sums.weight / total, settings_.variance), factor);
        }
      }
    });
  }

  void label_texels() {
    const Blocks& blocks = blocks_.front();
    tbb::parallel_for(0, height_, [&](int y) {
      Quadratics density{};
      Parts share{};
      for (int x = 0; x < width_; ++x) {
        const std::size_t i = texel(x, y);
        std::copy_n(&blocks.density[first_part(blocks, x / 2, y / 2)], parts_, density.begin());
        shares_of(density, parts_, points_[i].at, share);
        for (std::size_t k = 0; k < parts_; ++k) (*labels_)[i * parts_ + k] = static_cast<float>(share[k]);
      }
    });
  }

  std::span<const PlanePoint> points_;
  int width_, height_;
  std::size_t parts_;
  PartitionSettings settings_;
  std::vector<float>* labels_;
  std::vector<Blocks> blocks_;
  int shift_x_ = 0, shift_y_ = 0;
};

// The index of the smallest block size of a round: smaller sizes are added one by one during the first half.
int finest_of(int round, int rounds) { return std::max(0, block_sizes - 1 - 2 * block_sizes * round / rounds); }

constexpr int most_rounds = 50;

// The points with weight 0 outside a group.
std::vector<PlanePoint> only(std::span<const PlanePoint> points, const std::vector<bool>& upper, bool group) {
  std::vector<PlanePoint> own(points.begin(), points.end());
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (upper[i] != group) own[i].weight = 0.0;
  }
  return own;
}

double mean_over(std::span<const double> values, const std::vector<bool>& upper, bool group) {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (upper[i] != group) continue;
    sum += values[i];
    count += 1.0;
  }
  return sum / std::max(count, 1.0);
}

constexpr double least_share = 1e-6;  // a part that is empty here may gain texels later

}  // namespace

std::vector<PlanePoint> plane_points(const Image& normals, Coordinates coordinates, double steepest) {
  std::vector<PlanePoint> points(normals.texel_count());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float* const n = &normals.texels[4 * i];
    const glm::dvec3 normal(n[0], n[1], n[2]);
    if (n[3] <= 0.0F || glm::length(normal) < 1e-3) continue;
    const glm::dvec3 unit = glm::normalize(normal);
    points[i] = {.at = coordinates == Coordinates::slopes ? slope_of(unit, steepest) : stereographic_of(unit),
                 .weight = n[3]};
  }
  return points;
}

void PlaneSums::add(const glm::dvec2& p, double w) {
  weight += w;
  first += w * p;
  second += w * glm::dvec3(p.x * p.x, p.x * p.y, p.y * p.y);
}

void PlaneSums::add(const PlaneSums& others) {
  weight += others.weight;
  first += others.first;
  second += others.second;
}

void Quadratic::add(const Quadratic& other, double factor) {
  c += factor * other.c;
  b += factor * other.b;
  a += factor * other.a;
}

double Quadratic::at(const glm::dvec2& p) const {
  return c + glm::dot(b, p) - 0.5 * (a.x * p.x * p.x + a.z * p.y * p.y) - a.y * p.x * p.y;
}

Quadratic log_density(const PlaneSums& sums, double share, double variance) {
  const double weight = std::max(sums.weight, 1e-12);
  const glm::dvec2 mean = sums.first / weight;
  const double scale = 0.5 * (1.0 + glm::dot(mean, mean));
  const double floor = std::max(lobe_floor * variance * scale * scale, 1e-9);
  const double xx = std::max(sums.second.x / weight - mean.x * mean.x, 0.0) + floor;
  const double yy = std::max(sums.second.z / weight - mean.y * mean.y, 0.0) + floor;
  const double most = std::sqrt((xx - floor) * (yy - floor));
  const double xy = std::clamp(sums.second.y / weight - mean.x * mean.y, -most, most);
  const double determinant = xx * yy - xy * xy;
  const glm::dvec3 inverse = glm::dvec3(yy, -xy, xx) / determinant;
  const glm::dvec2 b(inverse.x * mean.x + inverse.y * mean.y, inverse.y * mean.x + inverse.z * mean.y);
  return {.c = std::log(std::max(share, least_share)) - 0.5 * std::log(determinant) - 0.5 * glm::dot(b, mean),
          .b = b,
          .a = inverse};
}

std::vector<float> partition(std::span<const PlanePoint> points, int width, int height,
                             const PartitionSettings& settings, const Progress& progress) {
  const auto parts = static_cast<std::size_t>(settings.parts);
  if (points.size() != static_cast<std::size_t>(width) * static_cast<std::size_t>(height) || parts < 1 ||
      parts > most_parts) {
    throw std::logic_error("partition: as many points as texels, and 1 to 8 parts");
  }
  std::vector<float> labels(points.size() * parts, 1.0F);
  if (parts == 1) return labels;
  const Quadratics mixture = mixture_over(points, settings);
  tbb::parallel_for(0, height, [&](int y) {
    Parts share{};
    for (std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(width), x = 0;
         x < static_cast<std::size_t>(width); ++x, ++i) {
      shares_of(mixture, parts, points[i].at, share);
      for (std::size_t k = 0; k < parts; ++k) labels[i * parts + k] = static_cast<float>(share[k]);
    }
  });
  if (settings.labels == Labels::global) return labels;
  JointLabels joint(points, width, height, settings, labels);
  std::mt19937 random(2);
  for (int round = 0; round < settings.rounds; ++round) {
    const int shift_x = static_cast<int>(random() % static_cast<unsigned>(width));
    const int shift_y = static_cast<int>(random() % static_cast<unsigned>(height));
    joint.round(shift_x, shift_y, finest_of(round, settings.rounds));
    progress(fmt::format("parting normals, {} x {}", width, height), (round + 1.0) / settings.rounds);
  }
  return labels;
}

std::vector<double> texel_variances(const Material& material, int width, int height) {
  const Image variances = nearest_texels(lobe_variance_map(material), width, height);
  return {variances.texels.begin(), variances.texels.end()};
}

std::vector<bool> upper_group(std::span<const double> values) {
  std::vector<bool> upper(values.size(), false);
  if (values.empty()) return upper;
  const auto [least, most] = std::ranges::minmax(values);
  double boundary = 0.5 * (least + most);
  for (int round = 0; round < most_rounds; ++round) {
    for (std::size_t i = 0; i < values.size(); ++i) upper[i] = values[i] > boundary;
    const double moved = 0.5 * (mean_over(values, upper, false) + mean_over(values, upper, true));
    if (std::ranges::find(upper, true) == upper.end() || moved == boundary) break;
    boundary = moved;
  }
  return upper;
}

std::vector<float> partition_with_roughness(std::span<const PlanePoint> points, std::span<const double> variances,
                                            int width, int height, const PartitionSettings& settings,
                                            const Progress& progress) {
  std::vector<double> logarithms(variances.size());
  std::ranges::transform(variances, logarithms.begin(), [](double v) { return std::log(v); });
  const std::vector<bool> upper = upper_group(logarithms);
  if (settings.parts == 1 || std::ranges::find(upper, true) == upper.end())
    return partition(points, width, height, settings, progress);
  const auto parts = static_cast<std::size_t>(settings.parts);
  std::vector<float> shares(points.size() * parts, 0.0F);
  std::size_t first = 0;
  ProgressParts halves(progress, 2);
  for (const bool group : {false, true}) {
    PartitionSettings own = settings;
    own.parts = group ? settings.parts / 2 : (settings.parts + 1) / 2;
    own.variance = mean_over(variances, upper, group);
    const auto count = static_cast<std::size_t>(own.parts);
    const std::vector<float> labels = partition(only(points, upper, group), width, height, own, halves.next(1, ""));
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (upper[i] == group) std::copy_n(&labels[i * count], count, &shares[i * parts + first]);
    }
    first += count;
  }
  return shares;
}

}  // namespace footprint::cells
