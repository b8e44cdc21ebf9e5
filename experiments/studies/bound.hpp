// The bound of a view: the image of `exact`, which no method can beat under the same footprint filter.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "experiments/settings/run_settings.hpp"
#include "experiments/studies/pixel_parts.hpp"
#include "experiments/studies/stage.hpp"
#include "renderer/image/image.hpp"
#include "renderer/pipeline/view.hpp"

namespace footprint {

/// The edge of the squares in which the bound is drawn where it is not drawn whole, pixels.
inline constexpr int bound_tile = 32;

/// The lights of a scene; facets are shaded for each.
struct BoundLights {
  std::size_t lights = 0;
  bool environment = false;
};

/// The cost of `exact` for a pixel whose footprint's longer edge spans `texels`, in facets shaded for one light: those
/// under the four texels of each of two levels, as a trilinear filter blends them, up to 128 x 128 per level. Of facets
/// that an environment lights there are less (methods/exact), and each costs what 50 do.
[[nodiscard]] double estimated_exact_cost(double texels, const BoundLights& lights);

/// `exact` over a stage, where this build has it, `use` wants it and it knows every effect of the scene; none
/// otherwise, and the last reason is added to `warnings`.
[[nodiscard]] std::optional<StagedMethod> stage_bound(const Stage& stage, BoundUse use,
                                                      std::vector<std::string>& warnings);

/// Draws it whole if requested or cheap, else in squares.
/// texels: those of Interior.
[[nodiscard]] BoundPicture draw_bound(const Stage& stage, const StagedMethod& bound, BoundUse use, const View& view,
                                      const PixelParts& parts, const Image& texels);

}  // namespace footprint
