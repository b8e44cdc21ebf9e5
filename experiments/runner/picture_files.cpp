// See picture_files.hpp.
#include "experiments/runner/picture_files.hpp"

#include <algorithm>
#include <cctype>

#include "renderer/image/false_color.hpp"
#include "renderer/image/image_io.hpp"

namespace footprint {

std::string file_stem(const std::string& text) {
  std::string stem = text;
  std::ranges::replace_if(
      stem, [](unsigned char c) { return std::isalnum(c) == 0 && c != '-' && c != '.' && c != '_'; }, '_');
  return stem;
}

std::string write_picture(const std::filesystem::path& folder, const std::string& stem, const Image& radiance,
                          float exposure) {
  write_exr(folder / "images" / (stem + ".exr"), radiance);
  write_png(folder / "images" / (stem + ".png"), to_display(radiance, exposure));
  return "images/" + stem + ".exr";
}

std::string write_error_picture(const std::filesystem::path& folder, const std::string& stem, const Image& error,
                                float scale) {
  write_png(folder / "images" / (stem + ".png"), false_color(error, scale));
  return "images/" + stem + ".png";
}

}  // namespace footprint
