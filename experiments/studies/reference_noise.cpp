// Noise from the two halves of a reference, which differ by nothing else. Levels of four times the samples, each over
// the tiles that are still too noisy and that the work allows.
#include "experiments/studies/reference_noise.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "renderer/image/metrics.hpp"
#include "renderer/pipeline/supersample.hpp"

namespace footprint {
namespace {

constexpr double halves_over_whole = 2.0;  // A - B has twice the deviation of the reference's own error

constexpr int tile_edge = 128;  // each draw of a tile goes through all vertices
constexpr int samples_factor = 4;

// The sum over a tile's object pixels of half the error between the halves, over their number.
double noise_of(const Image& error, const Image& counted, const Tile& tile) {
  double sum = 0, count = 0;
  for (int y = 0; y < tile.size.y; ++y) {
    const int row = error.height - 1 - (tile.origin.y + y);
    for (int x = tile.origin.x; x < tile.origin.x + tile.size.x; ++x) {
      sum += error.at(x, row)[0] / 2.0;
      count += counted.at(x, row)[3] >= 1.0F ? 1.0 : 0.0;
    }
  }
  return count > 0.0 ? sum / count : 0.0;
}

double pixels_of(const Tile& tile) { return static_cast<double>(tile.size.x) * tile.size.y; }

// Those of `tiles` whose noise is above `noise`, the noisiest first.
std::vector<Tile> noisy(const Supersampled& picture, std::span<const Tile> tiles, const Convergence& wanted) {
  Supersampled counted = picture;
  leave_out(counted, unresolved(picture, wanted.exposure));
  const Image error = error_map(counted.halves->first, counted.halves->second, wanted.exposure);
  std::vector<std::pair<double, Tile>> found;
  for (const Tile& tile : tiles) {
    const double noise = noise_of(error, counted.mean, tile);
    if (noise > wanted.noise) found.emplace_back(noise, tile);
  }
  std::ranges::stable_sort(found, std::greater<>(), [](const auto& entry) { return entry.first; });
  std::vector<Tile> out;
  for (const auto& entry : found) out.push_back(entry.second);
  return out;
}

}  // namespace

std::optional<double> noise_floor(const Supersampled& reference, float exposure) {
  return noise_floor_over(reference, exposure, object_pixels(reference.mean));
}

std::optional<double> noise_floor_over(const Supersampled& reference, float exposure, const Image& mask) {
  if (!reference.halves) return std::nullopt;
  const auto difference = normalized_color_over(reference.halves->first, reference.halves->second, exposure, mask);
  if (!difference) return std::nullopt;
  return *difference / halves_over_whole;
}

std::optional<Flicker> flicker_between(const Image& before, const Image& picture, const Supersampled& reference_before,
                                       const Supersampled& reference, float exposure) {
  const auto figures = compare_changes(before, picture, reference_before.mean, reference.mean, exposure);
  if (!figures) return std::nullopt;
  Flicker flicker{.mean = figures->mean, .p99 = figures->p99, .noise_floor = {}};
  flicker.ghosting = normalized_color_over(picture, reference.mean, exposure,
                                           trailing_edges(reference_before.mean, reference.mean, exposure));
  if (!reference_before.halves || !reference.halves) return flicker;
  const auto& [old_even, old_odd] = *reference_before.halves;
  const auto& [even, odd] = *reference.halves;
  if (const auto noise = compare_changes(old_even, even, old_odd, odd, exposure)) {
    flicker.noise_floor = noise->mean / halves_over_whole;
  }
  return flicker;
}

Image as_converged(const Image& picture, const Image& same, const Image& converged) {
  Image out = converged;
  for (std::size_t t = 0; t < out.texels.size(); t += 4) {
    if (picture.texels[t + 3] <= 0.0F || same.texels[t + 3] <= 0.0F) continue;
    for (std::size_t c = t; c < t + 3; ++c)
      out.texels[c] = std::max(converged.texels[c] + (picture.texels[c] - same.texels[c]), 0.0F);
  }
  return out;
}

double converge(const Supersampler& sampler, Supersampled& picture, const View& view, std::uint64_t seed,
                const Convergence& wanted, const Progress& progress) {
  const double pixels = static_cast<double>(view.size.x) * view.size.y;
  double work = wanted.max_extra_work * picture.spp * pixels;
  double samples = picture.spp * pixels;
  std::vector<Tile> tiles = tiles_of(view.size, tile_edge);
  int before = picture.spp;
  while (picture.halves && before < wanted.spp_max) {
    const int spp = std::min(before * samples_factor, wanted.spp_max);
    tiles = noisy(picture, tiles, wanted);
    std::vector<Tile> taken;
    for (const Tile& tile : tiles) {
      const double cost = spp * pixels_of(tile);
      if (cost > work) break;
      work -= cost;
      samples += (spp - before) * pixels_of(tile);
      taken.push_back(tile);
    }
    if (taken.empty()) break;
    sampler.refine(picture, view, taken, spp, seed, progress);
    tiles = std::move(taken);
    before = spp;
  }
  progress("reference", 1.0);
  return samples / pixels;
}

}  // namespace footprint
