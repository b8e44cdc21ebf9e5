// Sums each window first along columns, then along the row.
#include "renderer/image/ssim.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace footprint {
namespace {

constexpr int radius = 5;
constexpr double deviation = 1.5;                     // pixels
constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;  // Wang's constants for a dynamic range of 1
using Weights = std::array<double, 2 * radius + 1>;

// Gaussian weights without a factor, which cancels out.
Weights gaussian() {
  Weights weights{};
  for (int i = -radius; i <= radius; ++i)
    weights.at(static_cast<std::size_t>(i + radius)) = std::exp(-i * i / (2 * deviation * deviation));
  return weights;
}

// Weighted sums over a part of a window.
struct Moments {
  double weight = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;

  void add(double w, const Moments& more) {
    weight += w * more.weight;
    x += w * more.x;
    y += w * more.y;
    xx += w * more.xx;
    yy += w * more.yy;
    xy += w * more.xy;
  }
};

Moments moments_of(double x, double y) { return {.weight = 1, .x = x, .y = y, .xx = x * x, .yy = y * y, .xy = x * y}; }

double similarity(const Moments& sums) {
  const double x = sums.x / sums.weight, y = sums.y / sums.weight;
  const double xx = sums.xx / sums.weight - x * x, yy = sums.yy / sums.weight - y * y;
  const double xy = sums.xy / sums.weight - x * y;
  return (2 * x * y + c1) * (2 * xy + c2) / ((x * x + y * y + c1) * (xx + yy + c2));
}

// The sums of each column over the rows of the windows that are centred on `row`.
std::vector<Moments> columns_of(const Image& picture, const Image& reference, const Image& mask, int row,
                                const Weights& weights) {
  std::vector<Moments> columns(static_cast<std::size_t>(mask.width));
  for (int i = -radius; i <= radius; ++i) {
    const double weight = weights.at(static_cast<std::size_t>(i + radius));
    for (int x = 0; x < mask.width; ++x) {
      if (mask.at(x, row + i)[0] > 0.0F)
        columns[static_cast<std::size_t>(x)].add(weight, moments_of(static_cast<double>(picture.at(x, row + i)[0]),
                                                                    static_cast<double>(reference.at(x, row + i)[0])));
    }
  }
  return columns;
}

}  // namespace

std::optional<double> mean_ssim(const Image& picture, const Image& reference, const Image& mask) {
  const Weights weights = gaussian();
  double sum = 0;
  std::size_t pixels = 0;
  for (int row = radius; row < mask.height - radius; ++row) {
    const std::vector<Moments> columns = columns_of(picture, reference, mask, row, weights);
    for (int x = radius; x < mask.width - radius; ++x) {
      if (mask.at(x, row)[0] <= 0.0F) continue;
      Moments window;
      for (std::size_t i = 0; i < weights.size(); ++i)
        window.add(weights.at(i), columns[static_cast<std::size_t>(x - radius) + i]);
      sum += similarity(window);
      ++pixels;
    }
  }
  return pixels > 0 ? std::optional(sum / static_cast<double>(pixels)) : std::nullopt;
}

}  // namespace footprint
