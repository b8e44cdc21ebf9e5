// Decides where `exact` is cheap enough to be rendered by default, from the facets that it shades.
#include "experiments/studies/bound.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "methods/registry.hpp"

namespace footprint {
namespace {

constexpr std::string_view bound_name = "exact";
constexpr double cheap_facets = 1.5e7;  // shaded for all lights, of one distance: about a second on a CPU's two cores

}  // namespace

std::optional<StagedMethod> stage_bound(const Stage& stage, BoundUse use, std::vector<std::string>& warnings) {
  if (use == BoundUse::off) return {};
  const auto all = all_methods();
  const auto found = std::ranges::find(all, bound_name, [](const Method* m) { return m->info().name; });
  if (found == all.end()) return {};
  const EffectSet left_out = stage.effects() & ~(*found)->info().honours;
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
