// The pixels of a view by where errors come from, the errors over them, and squares of them that are cheap to draw.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "renderer/image/image.hpp"
#include "renderer/pipeline/interior.hpp"
#include "renderer/pipeline/view.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// The object pixels of a reference by where errors come from. Masks have one channel, 1 or 0.
struct PixelParts {
  Image interior;  ///< one smooth piece of surface: what methods are ranked over
  Image edges;     ///< all others
  PixelCounts counts = {};
};

/// `reference` is the mean of the samples that `interior` was found with.
[[nodiscard]] PixelParts pixel_parts(const Image& reference, const Interior& interior);

/// The image of `exact`, and where it was rendered.
struct BoundPicture {
  Image picture;  ///< RGBA
  Image pixels;   ///< a mask of the interior pixels in which it was drawn, and is finite
};

/// E of a method's picture over the parts, `causes.light` aside. Filter and method are over the pixels of the bound;
/// null: it was not drawn.
[[nodiscard]] ErrorCauses error_causes(const Image& picture, const Image& reference, const BoundPicture* bound,
                                       const PixelParts& parts, float exposure);

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

}  // namespace footprint
