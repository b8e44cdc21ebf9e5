// What one sample of the reference shades.
#pragma once

#include <array>

#include "renderer/core/words.hpp"

namespace footprint {

/// What one sample shades.
enum class ReferenceFilter {
  after_shading,  ///< one texel's own base BRDF, the texel drawn with the bilinear weights
  nearest,        ///< the nearest texel's
  bilinear,       ///< the bilinear filter of the map's values: interpolates the normal first
};

/// As users write it.
inline constexpr std::array<Word<ReferenceFilter>, 3> reference_filters{{
    {ReferenceFilter::after_shading, "after_shading"},
    {ReferenceFilter::nearest, "nearest"},
    {ReferenceFilter::bilinear, "bilinear"},
}};

}  // namespace footprint
