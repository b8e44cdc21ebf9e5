// Divides the texels by roughness first, because a part's lobe has one width, and then each group by its normals.
#include "methods/cells/halves.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "renderer/bake/normal_chain.hpp"

namespace footprint::cells {
namespace {

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

}  // namespace

std::vector<double> texel_variances(const Material& material, int width, int height) {
  const Image map = lobe_variance_map(material);
  std::vector<double> variances;
  variances.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) variances.push_back(map.at(x * map.width / width, y * map.height / height)[0]);
  }
  return variances;
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
  ProgressParts steps(progress, 2);
  for (const bool group : {false, true}) {
    PartitionSettings own = settings;
    own.parts = group ? settings.parts / 2 : (settings.parts + 1) / 2;
    own.variance = mean_over(variances, upper, group);
    const auto count = static_cast<std::size_t>(own.parts);
    const std::vector<float> labels = partition(only(points, upper, group), width, height, own, steps.next(1, ""));
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (upper[i] == group) std::copy_n(&labels[i * count], count, &shares[i * parts + first]);
    }
    first += count;
  }
  return shares;
}

}  // namespace footprint::cells
