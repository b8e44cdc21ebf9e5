// Each texel's share of all light, and the alias table of the shares (Vose 1991).
#include "renderer/environment/direction_table.hpp"

#include <numeric>

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

// Vose 1991: entries that are less than full are topped up by one texel that has more than its entry holds.
void fill_alias(const std::vector<double>& shares, Image& alias) {
  const auto count = static_cast<double>(shares.size());
  std::vector<double> left(shares.size());
  std::vector<std::size_t> small, large;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    left[i] = shares[i] * count;
    (left[i] < 1.0 ? small : large).push_back(i);
    alias.texels[2 * i] = 1.0F;
    alias.texels[2 * i + 1] = static_cast<float>(i);
  }
  while (!small.empty() && !large.empty()) {
    const std::size_t low = small.back();
    const std::size_t high = large.back();
    small.pop_back();
    alias.texels[2 * low] = static_cast<float>(left[low]);
    alias.texels[2 * low + 1] = static_cast<float>(high);  // exact: tables have fewer than 2^24 texels
    left[high] -= 1.0 - left[low];
    if (left[high] >= 1.0) continue;
    large.pop_back();
    small.push_back(high);
  }
}

}  // namespace

DirectionTable direction_table(const Image& radiance) {
  const std::vector<double> solid_angles = row_solid_angles(radiance.width, radiance.height);
  const std::vector<double> shares = shares_of(radiance, solid_angles);
  const auto width = static_cast<std::size_t>(radiance.width);
  DirectionTable table{Image(radiance.width, radiance.height, 4), Image(radiance.width, radiance.height, 2)};
  for (std::size_t i = 0; i < shares.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) table.radiance.texels[4 * i + c] = radiance.texels[3 * i + c];
    table.radiance.texels[4 * i + 3] = static_cast<float>(shares[i] / solid_angles[i / width]);
  }
  fill_alias(shares, table.alias);
  return table;
}

}  // namespace footprint
