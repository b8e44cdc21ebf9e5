// The model of the tests of bad and odd input: a quad whose normal map is a file beside it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "tests/support/gltf_builder.hpp"

namespace footprint::test {

/// The quad of make_quad() with the material `bumpy`, whose normal map is the file bumps.png.
[[nodiscard]] GltfBuilder make_bumpy_quad();

/// The one primitive of such a quad.
[[nodiscard]] nlohmann::json& primitive_of(GltfBuilder& quad);

/// An RGB picture of 8 bits a channel as a PNG file; `rows` are its bytes, each row after a zero. The header says
/// `width` x `height` for any content.
[[nodiscard]] std::string png_text(std::uint32_t width, std::uint32_t height, std::string_view rows);

/// A normal map of 2 x 2 texels, tilted four ways.
[[nodiscard]] std::string bumps_png();

}  // namespace footprint::test
