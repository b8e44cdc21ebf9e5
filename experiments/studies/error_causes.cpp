// Masks of pixels, errors over them, and the share of an image over which `exact` is cheap enough to be rendered by
// default, from the facets that it shades.
#include "experiments/studies/error_causes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "methods/registry.hpp"
#include "renderer/image/metrics.hpp"
#include "renderer/pipeline/supersample.hpp"

namespace footprint {
namespace {

constexpr double most_facets_per_level = 128.0 * 128.0;
// Under an environment, measured on golden_armor and armor_sky: a GGX lobe's nodes are looked up one by one.
constexpr double most_surrounded_per_level = 1428.0, surrounded_facet = 50.0;

// Tiles have row 0 at the bottom, pictures at the top.
template <typename Visit>  // visit(column, row of the picture)
void visit_pixels(const Tile& tile, int height, Visit visit) {
  for (int y = tile.origin.y; y < tile.origin.y + tile.size.y; ++y) {
    for (int x = tile.origin.x; x < tile.origin.x + tile.size.x; ++x) visit(x, height - 1 - y);
  }
}

constexpr std::string_view bound_name = "exact";
constexpr double cheap_facets = 1.5e7;  // shaded for all lights, of one distance: about a second on a CPU's two cores

}  // namespace

PixelParts pixel_parts(const Image& reference, const Interior& interior) {
  const Image object = object_pixels(reference);
  PixelParts parts{.interior = object, .edges = object, .counts = {}};
  for (std::size_t i = 0; i < object.texels.size(); ++i) {
    (interior.mask.texels[i] > 0.0F ? parts.edges : parts.interior).texels[i] = 0.0F;
    if (parts.interior.texels[i] > 0.0F && interior.texels.texels[i] > 1.0F) ++parts.counts.minified;
  }
  parts.counts.object = pixel_count(object);
  parts.counts.interior = pixel_count(parts.interior);
  return parts;
}

ErrorCauses error_causes(const CausePictures& pictures, const PixelParts& parts, float exposure) {
  ErrorCauses causes;
  causes.shading = normalized_color_over(pictures.method, pictures.reference, exposure, parts.interior);
  causes.edges = normalized_color_over(pictures.method, pictures.reference, exposure, parts.edges);
  if (pictures.bound == nullptr) return causes;
  causes.filter = normalized_color_over(*pictures.bound, pictures.reference, exposure, *pictures.bound_pixels);
  causes.method = error_between(pictures.method, *pictures.bound, pictures.reference, exposure, *pictures.bound_pixels);
  return causes;
}

Image as_reference(Image picture, const Image& reference) {
  for (std::size_t i = 3; i < picture.texels.size(); i += 4) picture.texels[i] = reference.texels[i];
  return picture;
}

std::optional<double> error_between(const Image& picture, const Image& other, const Image& reference, float exposure,
                                    const Image& mask) {
  return normalized_color_over(picture, as_reference(other, reference), exposure, mask);
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

double estimated_exact_cost(double texels, const BoundLights& lights) {
  const double level = std::floor(std::log2(std::max(texels, 1.0)));
  const auto facets = [&](double most) {
    return std::min(std::pow(4.0, level + 1.0), most) + std::min(std::pow(4.0, level + 2.0), most);
  };
  const double surrounded = lights.environment ? surrounded_facet * facets(most_surrounded_per_level) : 0.0;
  return static_cast<double>(lights.lights) * facets(most_facets_per_level) + surrounded;
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

std::optional<StagedMethod> stage_bound(const Stage& stage, BoundUse use, std::vector<std::string>& warnings) {
  if (use == BoundUse::off) return {};
  const auto all = all_methods();
  const auto found = std::ranges::find(all, bound_name, [](const Method* m) { return m->info.name; });
  if (found == all.end()) return {};
  const EffectSet left_out = stage.effects() & ~(*found)->info.honours;
  if (left_out.any()) {
    warnings.push_back(
        fmt::format("no bound is drawn: {} leaves out {}", bound_name, fmt::join(effect_names(left_out), ", ")));
    return {};
  }
  return stage.stage(parse_methods(std::string(bound_name)).front(), no_progress);
}

BoundPicture draw_bound(const Stage& stage, const StagedMethod& bound, BoundUse use, const View& view,
                        const PixelParts& parts, const Image& texels) {
  const BoundLights lights{.lights = stage.scene().lights.size(), .environment = stage.scene().environment.has_value()};
  const PixelCost facets = [&](int x, int y) { return estimated_exact_cost(texels.at(x, y)[0], lights); };
  const std::vector<Tile> whole{{.origin = {0, 0}, .size = view.size}};
  const bool all = use == BoundUse::on || cost_of(whole.front(), parts, facets) <= cheap_facets;
  const std::vector<Tile> tiles = all ? whole : cheap_parts(parts, bound_tile, facets, cheap_facets);
  const FrameRenderer& frames = bound.frames();
  BoundPicture out{.picture = all ? frames.render(view) : frames.render(view, tiles),
                   .pixels = within(parts.interior, tiles)};
  leave_out_infinite(out.picture, out.pixels);  // of more texels and lights than it sums
  return out;
}

}  // namespace footprint
