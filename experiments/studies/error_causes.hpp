// The causes of an error (docs/reference/metrics.md): over which pixels it is measured, and what is rendered to
// separate them, such as the bound: the image of `exact`, which no method can beat under the same footprint filter.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "experiments/studies/stage.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/image/image.hpp"
#include "renderer/pipeline/interior.hpp"
#include "renderer/pipeline/view.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// The object pixels of a reference by where errors come from. Masks have one channel, 1 or 0.
struct PixelParts {
  Image interior;  ///< one smooth piece of surface: what methods are ranked over
  Image edges;     ///< all others
  PixelCounts counts;
};

/// `reference` is the mean of the samples that `interior` was found with.
[[nodiscard]] PixelParts pixel_parts(const Image& reference, const Interior& interior);

/// The pictures that errors of one distance are taken between.
struct CausePictures {
  const Image& method;
  const Image& reference;
  const Image* bound = nullptr;  ///< of `exact`, where it was drawn
  const Image* bound_pixels = nullptr;
};

/// E over the parts, `causes.light` aside. Where the bound is there, filter and method are over its pixels.
[[nodiscard]] ErrorCauses error_causes(const CausePictures& pictures, const PixelParts& parts, float exposure);

/// The standard error that the reference's noise gives E(picture, reference) over `mask`, from the reference's two
/// halves: half of the difference of a pixel's errors against them has the deviation of its error against the whole.
/// Errors of two methods that differ by several of it differ by more than noise. None where no pixel counts.
[[nodiscard]] std::optional<double> error_noise(const Image& picture, const std::pair<Image, Image>& halves,
                                                float exposure, const Image& mask);

/// `picture` with the coverage of the reference, to take its place: the reference decides which pixels count.
[[nodiscard]] Image as_reference(Image picture, const Image& reference);

/// E between two pictures of methods over a mask, `other` in place of the reference.
[[nodiscard]] std::optional<double> error_between(const Image& picture, const Image& other, const Image& reference,
                                                  float exposure, const Image& mask);

/// The edge of the squares in which the bound is drawn where it is not drawn whole, and of those that are lit by all of
/// an environment, pixels.
inline constexpr int bound_tile = 32, light_tile = 8;

/// The lights of a scene; facets are shaded for each.
struct BoundLights {
  std::size_t lights = 0;
  bool environment = false;
};

/// The cost of `exact` for a pixel whose footprint's longer edge spans `texels`, in facets shaded for one light: those
/// under the four texels of each of two levels, as a trilinear filter blends them, up to 128 x 128 per level. Of facets
/// that an environment lights there are less (methods/exact), and each costs what 50 do.
[[nodiscard]] double estimated_exact_cost(double texels, const BoundLights& lights);

/// The cost of a pixel; column, row.
using PixelCost = std::function<double(int, int)>;

/// The total cost of the object pixels of a part of the image.
[[nodiscard]] double cost_of(const Tile& tile, const PixelParts& parts, const PixelCost& cost);

/// Squares of the picture, `edge` pixels per side, whose object pixels cost at most `most`, in a fixed order that
/// spreads them over the image. `parts`: for the object pixels.
[[nodiscard]] std::vector<Tile> cheap_parts(const PixelParts& parts, int edge, const PixelCost& cost, double most);

/// Takes out of a mask the pixels at which a value of the image is not finite.
void leave_out_infinite(const Image& picture, Image& mask);

/// The mask's pixels in the tiles.
[[nodiscard]] Image within(const Image& mask, std::span<const Tile> tiles);

/// The image of `exact`, and where it was rendered.
struct BoundPicture {
  Image picture;  ///< RGBA
  Image pixels;   ///< a mask of the interior pixels in which it was drawn, and is finite
};

/// `exact` over a stage, where this build has it, `use` wants it and it knows every effect of the scene; none
/// otherwise, and the last reason is added to `warnings`.
[[nodiscard]] std::optional<StagedMethod> stage_bound(const Stage& stage, BoundUse use,
                                                      std::vector<std::string>& warnings);

/// Whole if requested or cheap, else in squares. `texels` are those of Interior.
[[nodiscard]] BoundPicture draw_bound(const Stage& stage, const StagedMethod& bound, BoundUse use, const View& view,
                                      const PixelParts& parts, const Image& texels);

}  // namespace footprint
