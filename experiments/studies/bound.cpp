// The cost of `exact` is estimated pixel by pixel; where all of it is too much, squares are drawn.
#include "experiments/studies/bound.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "experiments/settings/setting.hpp"
#include "methods/registry.hpp"
#include "renderer/effects/effects.hpp"

namespace footprint {
namespace {

constexpr double most_facets_per_level = 128.0 * 128.0;
// Under an environment, measured on golden_armor and armor_sky: a GGX lobe's nodes are looked up one by one.
constexpr double most_surrounded_per_level = 1428.0, surrounded_facet = 50.0;

constexpr std::string_view bound_name = "exact";
constexpr double cheap_facets = 1.5e7;  // shaded for all lights, of one distance: about a second on a CPU's two cores

}  // namespace

double estimated_exact_cost(double texels, const BoundLights& lights) {
  const double level = std::floor(std::log2(std::max(texels, 1.0)));
  const auto facets = [&](double most) {
    return std::min(std::pow(4.0, level + 1.0), most) + std::min(std::pow(4.0, level + 2.0), most);
  };
  const double surrounded = lights.environment ? surrounded_facet * facets(most_surrounded_per_level) : 0.0;
  return static_cast<double>(lights.lights) * facets(most_facets_per_level) + surrounded;
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
  leave_out_infinite(out.picture, out.pixels);  // where `exact` reached its limit of texels or lights
  return out;
}

}  // namespace footprint
