// Masks, and errors under them. Squares are chosen in the order of a low-discrepancy sequence.
#include "experiments/studies/pixel_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>

#include "experiments/studies/tile_pixels.hpp"
#include "renderer/image/metrics.hpp"

namespace footprint {

PixelParts pixel_parts(const Image& reference, const Interior& interior) {
  const Image object = object_pixels(reference);
  PixelParts parts{.interior = object, .edges = object};
  for (std::size_t i = 0; i < object.texels.size(); ++i) {
    (interior.mask.texels[i] > 0.0F ? parts.edges : parts.interior).texels[i] = 0.0F;
    if (parts.interior.texels[i] > 0.0F && interior.texels.texels[i] > 1.0F) ++parts.counts.minified;
  }
  parts.counts.object = pixel_count(object);
  parts.counts.interior = pixel_count(parts.interior);
  return parts;
}

ErrorCauses error_causes(const Image& picture, const Image& reference, const BoundPicture* bound,
                         const PixelParts& parts, float exposure) {
  ErrorCauses causes;
  causes.shading = normalized_color(picture, reference, exposure, parts.interior);
  causes.edges = normalized_color(picture, reference, exposure, parts.edges);
  if (bound == nullptr) return causes;
  causes.filter = normalized_color(bound->picture, reference, exposure, bound->pixels);
  causes.method = error_between(picture, bound->picture, reference, exposure, bound->pixels);
  return causes;
}

Image as_reference(Image picture, const Image& reference) {
  for (std::size_t i = 3; i < picture.texels.size(); i += 4) picture.texels[i] = reference.texels[i];
  return picture;
}

std::optional<double> error_between(const Image& picture, const Image& other, const Image& reference, float exposure,
                                    const Image& mask) {
  return normalized_color(picture, as_reference(other, reference), exposure, mask);
}

std::optional<double> error_noise(const Image& picture, const std::pair<Image, Image>& halves, float exposure,
                                  const Image& mask) {
  const Image first = error_map(picture, halves.first, exposure), second = error_map(picture, halves.second, exposure);
  double squares = 0;
  std::size_t pixels = 0;
  for (std::size_t i = 0; i < mask.texels.size(); ++i) {
    if (mask.texels[i] <= 0.0F) continue;
    squares += std::pow(0.5 * (static_cast<double>(first.texels[i]) - second.texels[i]), 2);
    ++pixels;
  }
  return pixels > 0 ? std::optional(std::sqrt(squares) / static_cast<double>(pixels)) : std::nullopt;
}

double cost_of(const Tile& tile, const PixelParts& parts, const PixelCost& cost) {
  double sum = 0;
  visit_pixels(tile, parts.interior.height, [&](int x, int y) {
    if (parts.interior.at(x, y)[0] + parts.edges.at(x, y)[0] > 0.0F) sum += cost(x, y);
  });
  return sum;
}

std::vector<Tile> cheap_parts(const PixelParts& parts, int edge, const PixelCost& cost, double most) {
  const std::vector<Tile> tiles = tiles_of({parts.interior.width, parts.interior.height}, edge);
  std::vector<std::size_t> order(tiles.size());
  std::iota(order.begin(), order.end(), 0U);
  // Multiples of the golden ratio fill the unit interval evenly (Weyl's sequence): each tile's turn.
  const auto turn = [](std::size_t i) { return std::fmod(static_cast<double>(i) * std::numbers::phi, 1.0); };
  std::ranges::stable_sort(order, {}, turn);
  std::vector<Tile> chosen;
  for (const std::size_t i : order) {
    const double price = cost_of(tiles[i], parts, cost);
    if (price == 0.0) continue;
    if (price > most) break;
    most -= price;
    chosen.push_back(tiles[i]);
  }
  return chosen;
}

void leave_out_infinite(const Image& picture, Image& mask) {
  for (std::size_t i = 0; i < mask.texels.size(); ++i) {
    const std::span<const float> texel = std::span(picture.texels).subspan(4 * i, 4);
    if (!std::ranges::all_of(texel, [](float value) { return std::isfinite(value); })) mask.texels[i] = 0.0F;
  }
}

Image within(const Image& mask, std::span<const Tile> tiles) {
  Image inside(mask.width, mask.height, 1);
  for (const Tile& tile : tiles)
    visit_pixels(tile, mask.height, [&](int x, int y) { inside.at(x, y)[0] = mask.at(x, y)[0]; });
  return inside;
}

}  // namespace footprint
