// Tiles of a reference are refined, the noisiest first.
#include "experiments/studies/reference_noise.hpp"

#include <algorithm>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "experiments/studies/tile_pixels.hpp"
#include "renderer/image/metrics.hpp"

namespace footprint {
namespace {

constexpr int tile_edge = 128;  // each draw of a tile goes through all vertices
constexpr int samples_factor = 4;

// The sum over a tile's object pixels of half the error between the halves, over their number.
double noise_of(const Image& error, const Image& counted, const Tile& tile) {
  double sum = 0, count = 0;
  visit_pixels(tile, error.height, [&](int x, int y) {
    sum += error.at(x, y)[0] / 2.0;
    count += counted.at(x, y)[3] >= 1.0F ? 1.0 : 0.0;
  });
  return count > 0.0 ? sum / count : 0.0;
}

double pixels_of(const Tile& tile) { return static_cast<double>(tile.size.x) * tile.size.y; }

// The `tiles` whose noise is above `noise`, the noisiest first.
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
  out.reserve(found.size());
  for (const auto& entry : found) out.push_back(entry.second);
  return out;
}

}  // namespace

std::optional<double> noise_floor(const Supersampled& reference, float exposure, const Image& mask) {
  if (!reference.halves) return std::nullopt;
  const auto difference = normalized_color(reference.halves->first, reference.halves->second, exposure, mask);
  if (!difference) return std::nullopt;
  return *difference / halves_over_whole;
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
