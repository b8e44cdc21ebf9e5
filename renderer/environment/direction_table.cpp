// Each texel's share of all light, and the sums of the shares with their guides (Chen and Asau 1974).
#include "renderer/environment/direction_table.hpp"

#include <algorithm>
#include <numeric>
#include <span>

namespace footprint {
namespace {

// The share of each texel of all light.
std::vector<double> shares_of(const Image& radiance, const std::vector<double>& solid_angles) {
  std::vector<double> weight(radiance.texel_count());
  const auto width = static_cast<std::size_t>(radiance.width);
  const auto fill = [&](auto light) {
    for (std::size_t i = 0; i < weight.size(); ++i) weight[i] = light(i) * solid_angles[i / width];
    return std::accumulate(weight.begin(), weight.end(), 0.0);
  };
  double sum = fill([&](std::size_t i) {
    const float* const texel = &radiance.texels[3 * i];
    return (static_cast<double>(texel[0]) + texel[1] + texel[2]) / 3.0;
  });
  if (sum <= 0.0) sum = fill([](std::size_t) { return 1.0; });
  for (double& w : weight) w /= sum;
  return weight;
}

// Sums of `weights` up to and with each entry as shares of all, the last one 1; evenly where all are 0.
std::vector<float> sums_of(std::span<const double> weights) {
  std::vector<float> sums;
  const double all = std::accumulate(weights.begin(), weights.end(), 0.0);
  double sum = 0;
  for (const double weight : weights) {
    sum += all > 0.0 ? weight / all : 1.0 / static_cast<double>(weights.size());
    sums.push_back(static_cast<float>(std::min(sum, 1.0)));
  }
  sums.back() = 1.0F;
  return sums;
}

// For each of as many equal parts of 0 to 1 as there are sums: the first entry whose sum exceeds where the part begins.
std::vector<float> guides_of(std::span<const float> sums) {
  std::vector<float> guides;
  std::size_t entry = 0;
  for (std::size_t part = 0; part < sums.size(); ++part) {
    const double begin = static_cast<double>(part) / static_cast<double>(sums.size());
    while (entry + 1 < sums.size() && sums[entry] <= begin) ++entry;
    guides.push_back(static_cast<float>(entry));
  }
  return guides;
}

double share_of(std::span<const float> sums, std::size_t entry) {
  return entry == 0 ? sums[0] : static_cast<double>(sums[entry]) - sums[entry - 1];
}

}  // namespace

DirectionTable direction_table(const Image& radiance) {
  const std::vector<double> solid_angles = row_solid_angles(radiance.width, radiance.height);
  const std::vector<double> shares = shares_of(radiance, solid_angles);
  const auto width = static_cast<std::size_t>(radiance.width), height = static_cast<std::size_t>(radiance.height);
  DirectionTable table{Image(radiance.width, radiance.height, 4), Image(radiance.width + 1, radiance.height, 2)};
  std::vector<double> rows;
  for (std::size_t y = 0; y < height; ++y) {
    const std::span<const double> row = std::span(shares).subspan(y * width, width);
    rows.push_back(std::accumulate(row.begin(), row.end(), 0.0));
  }
  const auto set = [&](std::size_t x, std::size_t y, float sum, float guide) {
    table.sums.texels[2 * (y * (width + 1) + x)] = sum;
    table.sums.texels[2 * (y * (width + 1) + x) + 1] = guide;
  };
  const std::vector<float> row_sums = sums_of(rows);
  const std::vector<float> row_guides = guides_of(row_sums);
  for (std::size_t y = 0; y < height; ++y) {
    set(width, y, row_sums[y], row_guides[y]);
    const std::vector<float> sums = sums_of(std::span(shares).subspan(y * width, width));
    const std::vector<float> guides = guides_of(sums);
    for (std::size_t x = 0; x < width; ++x) {
      set(x, y, sums[x], guides[x]);
      float* const texel = &table.radiance.texels[4 * (y * width + x)];
      std::copy_n(&radiance.texels[3 * (y * width + x)], 3, texel);
      texel[3] = static_cast<float>(share_of(row_sums, y) * share_of(sums, x) / solid_angles[y]);
    }
  }
  return table;
}

}  // namespace footprint
