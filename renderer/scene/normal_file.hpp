// A file that normals are read from: stored normals, or heights with the filter that makes slopes of them.
#pragma once

#include <array>
#include <filesystem>
#include <optional>

#include "renderer/core/names.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// The derivative of a height field: differences of the two neighbours along an axis, over their distance of two
/// texels, as weighted means over three rows.
enum class SlopeFilter {
  central,  ///< the texel's own row alone
  sobel,    ///< rows weighted 1, 2, 1: OpenImageIO's `maketx --bumpslopes`
  scharr,   ///< rows weighted 3, 10, 3
};

inline constexpr std::array<Word<SlopeFilter>, 3> slope_filters{
    {{SlopeFilter::central, "central"}, {SlopeFilter::sobel, "sobel"}, {SlopeFilter::scharr, "scharr"}}};

/// How heights become slopes.
struct HeightSettings {
  SlopeFilter filter = SlopeFilter::central;
  std::array<Wrap, 2> wrap{Wrap::repeat, Wrap::repeat};  ///< neighbours beyond the border, along u and v
};

/// A file of normals, or of heights in its first channel.
struct NormalFile {
  std::filesystem::path path;
  double scale = 1.0;  ///< factor on slopes; for heights, the height of value 1 in widths of the map
  NormalChannels channels = NormalChannels::xyz;
  std::optional<HeightSettings> heights{};  ///< none: the file stores normals
};

}  // namespace footprint
