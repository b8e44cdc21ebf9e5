// A coarse texel sums up to three fine ones along each axis, weighed by the area that they share; rows in parallel.
#include "renderer/image/mipmap.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <utility>

#include "renderer/core/error.hpp"
#include "renderer/core/memory.hpp"

namespace footprint {
namespace {

template <typename Visit>  // visit(texel, share of the coarse texel's area)
void visit_taps(const Image& fine, const MipTaps& across, const MipTaps& down, Visit visit) {
  for (int j = 0; j < down.count; ++j) {
    for (int i = 0; i < across.count; ++i) {
      visit(fine.at(across.first + i, down.first + j), across.weight[i] * down.weight[j]);
    }
  }
}

double mean_of_channel(const Image& fine, const MipTaps& across, const MipTaps& down, std::size_t channel) {
  double sum = 0;
  visit_taps(fine, across, down, [&](std::span<const float> texel, double share) { sum += share * texel[channel]; });
  return sum;
}

void plain_mean(const Image& fine, const MipTaps& across, const MipTaps& down, std::span<float> coarse) {
  for (std::size_t c = 0; c < coarse.size(); ++c)
    coarse[c] = static_cast<float>(mean_of_channel(fine, across, down, c));
}

void weighted_mean(const Image& fine, const MipTaps& across, const MipTaps& down, std::span<float> coarse) {
  const std::size_t last = coarse.size() - 1;
  const double weight = mean_of_channel(fine, across, down, last);
  if (weight <= 0) return plain_mean(fine, across, down, coarse);
  for (std::size_t c = 0; c < last; ++c) {
    double sum = 0;
    visit_taps(fine, across, down, [&](std::span<const float> texel, double share) {
      if (texel[last] > 0) sum += share * texel[last] * texel[c];  // an invalid texel may be NaN, and 0 * NaN is not 0
    });
    coarse[c] = static_cast<float>(sum / weight);
  }
  coarse[last] = static_cast<float>(weight);
}

// Each coarse texel is a sum of its own in a fixed order, so the result does not depend on the number of threads.
template <typename Reduce>
Image reduced(const Image& fine, Reduce reduce) {
  Image coarse(std::max(fine.width / 2, 1), std::max(fine.height / 2, 1), fine.channels);
  constexpr int texels_per_task = 16384;
  const int rows_per_task = std::max(1, texels_per_task / coarse.width);
  tbb::parallel_for(tbb::blocked_range<int>(0, coarse.height, rows_per_task), [&](const tbb::blocked_range<int>& rows) {
    for (int y = rows.begin(); y < rows.end(); ++y) {
      const MipTaps down = mip_taps(fine.height, y);
      for (int x = 0; x < coarse.width; ++x) reduce(fine, mip_taps(fine.width, x), down, coarse.at(x, y));
    }
  });
  return coarse;
}

template <typename Reduce>
std::vector<Image> chain(Image finest, Reduce reduce) {
  if (finest.empty()) throw Error(ErrorKind::usage, "mip chain", "the image has no texels");
  require_texels(finest.width, finest.height, finest.texels.size() * sizeof(float) / 3, "the mip chain of a map");
  std::vector<Image> levels;
  levels.reserve(static_cast<std::size_t>(mip_level_count(finest.width, finest.height)));
  levels.push_back(std::move(finest));
  while (levels.back().texel_count() > 1) levels.push_back(reduced(levels.back(), reduce));
  return levels;
}

}  // namespace

MipTaps mip_taps(int fine_size, int i) {
  if (fine_size == 1) return {};
  if (fine_size % 2 == 0) return {2 * i, 2, {0.5, 0.5, 0.0}};
  const int m = fine_size / 2;
  const double n = fine_size;
  return {2 * i, 3, {(m - i) / n, m / n, (1 + i) / n}};
}

int mip_level_count(int width, int height) {
  return static_cast<int>(std::bit_width(static_cast<unsigned>(std::max({width, height, 1}))));
}

std::vector<Image> mip_chain(Image finest) { return chain(std::move(finest), plain_mean); }

std::vector<Image> weighted_mip_chain(Image finest) { return chain(std::move(finest), weighted_mean); }

Image nearest_texels(const Image& image, int width, int height) {
  Image out(width, height, image.channels);
  for_each_texel(out, [&](int x, int y) {
    std::ranges::copy(image.at(x * image.width / width, y * image.height / height), out.at(x, y).begin());
  });
  return out;
}

}  // namespace footprint
