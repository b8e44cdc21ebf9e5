// File names, exposed and false-colour pictures, and strips of several.
#include "experiments/studies/picture_files.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "renderer/core/names.hpp"
#include "renderer/image/false_color.hpp"
#include "renderer/image/image_io.hpp"

namespace footprint {
namespace {

constexpr float dark_gain = 1.0F / 16.0F;  // four stops: results/report/page.js

}  // namespace

Image stacked(const Image& top, const Image& bottom) {
  Image both(std::max(top.width, bottom.width), top.height + bottom.height, top.channels);
  const auto place = [&](const Image& part, int first_row) {
    for (int y = 0; y < part.height; ++y) {
      for (int x = 0; x < part.width; ++x) std::ranges::copy(part.at(x, y), both.at(x, first_row + y).begin());
    }
  };
  place(top, 0);
  place(bottom, top.height);
  return both;
}

std::string method_stem(std::span<const MethodSpec> methods, std::size_t index) {
  const std::string stem = file_stem(methods[index].text);
  const auto same = [&](const MethodSpec& other) { return file_stem(other.text) == stem; };
  return std::ranges::count_if(methods, same) > 1 || stem == "reference" ? fmt::format("{}.{}", stem, index) : stem;
}

std::string distance_stem(double distance, const std::string& what) {
  return fmt::format("d{}_{}", file_stem(fmt::format("{}", distance)), what);
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

std::string write_exposable_picture(const std::filesystem::path& folder, const std::string& stem, const Image& radiance,
                                    float exposure) {
  write_png(folder / "images" / (stem + "_dark.png"), to_display(radiance, exposure * dark_gain));
  return write_picture(folder, stem, radiance, exposure);
}

std::vector<std::string> exposable_files(const std::string& exr) {
  const std::string stem = exr.substr(0, exr.size() - std::string_view(".exr").size());
  return {exr, stem + ".png", stem + "_dark.png"};
}

std::string write_mask(const std::filesystem::path& folder, const std::string& stem, const Image& mask) {
  Image picture(mask.width, mask.height, 4, 1.0F);
  for (std::size_t i = 0; i < mask.texels.size(); ++i)
    std::fill_n(picture.texels.begin() + static_cast<std::ptrdiff_t>(4 * i), 3, mask.texels[i]);
  return write_picture(folder, stem, picture, 1.0F);
}

void write_strips(const std::filesystem::path& folder, const std::string& stem, const std::vector<StripPanel>& panels,
                  float exposure, float scale) {
  std::vector<Image> pictures, errors;
  std::vector<std::string> captions, error_captions;
  for (const StripPanel& panel : panels) {
    pictures.push_back(to_display(panel.picture, exposure));
    captions.push_back(panel.caption);
    if (panel.error.empty()) continue;
    errors.push_back(false_color(panel.error, scale));
    error_captions.push_back(panel.caption);
  }
  write_png(folder / "images" / (stem + ".png"), labelled_strip(pictures, captions));
  if (errors.empty()) return;  // no method could be drawn
  const Image strip = labelled_strip(errors, error_captions);
  const Image legend = false_color_legend(strip.width, std::max(24, strip.height / 12), scale);
  write_png(folder / "images" / (stem + "_errors.png"), stacked(strip, legend));
}

}  // namespace footprint
