// The quad of GltfBuilder under a normal map of 2 x 2 texels, whose PNG file is made in memory.
#include "tests/command_line/bumpy_quad.hpp"

#include "tests/support/png_file.hpp"

namespace footprint::test {

nlohmann::json& primitive_of(GltfBuilder& quad) { return quad.json["meshes"][0]["primitives"][0]; }

GltfBuilder make_bumpy_quad() {
  GltfBuilder quad = make_quad();
  quad.json["images"] = {{{"uri", "bumps.png"}}};
  quad.json["textures"] = {{{"source", 0}}};
  quad.json["materials"] = {{{"name", "bumpy"}, {"normalTexture", {{"index", 0}}}}};
  primitive_of(quad)["material"] = 0;
  return quad;
}

std::string png_text(std::uint32_t width, std::uint32_t height, std::string_view rows) {
  const std::vector<std::uint8_t> bytes = png_file(width, height, 8, PngColor::rgb, rows);
  return {bytes.begin(), bytes.end()};
}

std::string bumps_png() {
  return png_text(2, 2,
                  {"\0\xa0\x80\xf0\x60\x80\xf0"
                   "\0\x80\xa0\xf0\x80\x60\xf0",
                   14});
}

}  // namespace footprint::test
