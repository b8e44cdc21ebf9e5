// File names, exposed and false-colour pictures, and strips of several; scales in round figures, so that images of
// several runs often share one.
#include "experiments/studies/picture_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "experiments/studies/finished_work.hpp"
#include "experiments/studies/score.hpp"
#include "renderer/core/names.hpp"
#include "renderer/image/false_color.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/image/pixel_script.hpp"
#include "renderer/pipeline/timing.hpp"

namespace footprint {
namespace {

constexpr double scale_quantile = 0.99;
constexpr double smallest_error_scale = 0.01;

Image read_back(const RunFolder& folder, const std::string& file) {
  return read_image(folder / file, Transfer::linear);
}

// The reference without the pixels that no figure includes.
Image counted_reference(const RunFolder& folder, const DistanceResult& result) {
  Image reference = read_back(folder, result.reference);
  Image mask(reference.width, reference.height, 1);
  for (const std::uint32_t pixel : result.unresolved) {
    if (pixel < mask.texels.size()) mask.texels[pixel] = 1.0F;
  }
  uncover(reference, mask);
  return reference;
}

// For FLIP, which takes every pixel, those too that no figure includes because they are not finite.
Image seen(const Image& radiance, float exposure) { return finite_part(shown(radiance, exposure)); }

std::string error_file(const RunFolder& folder, const Record& record, const std::string& end, const Image& error,
                       double top) {
  const std::string file =
      fmt::format("images/{}{}.png", std::filesystem::path(record.images.color).stem().string(), end);
  folder.attempt(file, [&] { write_png(folder / file, false_color(error, static_cast<float>(top))); });
  return file;
}

// The image of a method, as it was written; empty if it was lost.
Image picture_of(const RunFolder& folder, const Record& record) {
  Image picture;
  folder.attempt(record.images.color, [&] { picture = read_back(folder, record.images.color); });
  return picture;
}

// The images beside each other, and their errors over the legend of the scale.
void write_strips(const RunFolder& folder, const std::string& stem, const Strip& pictures, const Strip& errors,
                  double top) {
  const std::string file = "images/" + stem;
  folder.attempt(file, [&] { write_png(folder / (file + ".png"), pictures.drawn()); });
  if (errors.pictures.empty()) return;  // no method could be drawn
  folder.attempt(file, [&] {
    const Image strip = errors.drawn();
    const Image legend = false_color_legend(strip.width, std::max(24, strip.height / 12), static_cast<float>(top));
    write_png(folder / (file + "_errors.png"), stacked(strip, legend));
  });
}

}  // namespace

void paste(const Image& part, int left, int top, Image& picture) {
  for (int y = std::max(0, -top); y < std::min(part.height, picture.height - top); ++y) {
    for (int x = std::max(0, -left); x < std::min(part.width, picture.width - left); ++x)
      std::ranges::copy(part.at(x, y), picture.at(left + x, top + y).begin());
  }
}

Image stacked(const Image& top, const Image& bottom) {
  Image both(std::max(top.width, bottom.width), top.height + bottom.height, top.channels);
  paste(top, 0, 0, both);
  paste(bottom, 0, top.height, both);
  return both;
}

void Strip::add(Image picture, const std::string& caption) {
  pictures.push_back(std::move(picture));
  captions.push_back(caption);
}

Image Strip::drawn() const { return labelled_strip(pictures, captions); }

std::string method_stem(std::span<const MethodSpec> methods, std::size_t index) {
  const std::string stem = file_stem(methods[index].text);
  const auto same = [&](const MethodSpec& other) { return file_stem(other.text) == stem; };
  return std::ranges::count_if(methods, same) > 1 || stem == "reference" ? fmt::format("{}.{}", stem, index) : stem;
}

std::string distance_stem(double distance, const std::string& what) {
  return fmt::format("d{}_{}", file_stem(fmt::format("{}", distance)), what);
}

std::string write_picture(const RunFolder& folder, const std::string& stem, const Image& radiance, float exposure) {
  const std::string file = "images/" + stem;
  folder.attempt(file, [&] { write_exr(folder / (file + ".exr"), radiance); });
  folder.attempt(file, [&] { write_png(folder / (file + ".png"), to_display(radiance, exposure)); });
  return file + ".exr";
}

std::string write_page_picture(const RunFolder& folder, const std::string& stem, const Image& radiance, float exposure,
                               const Image& left_out) {
  const std::string file = fmt::format("images/{}_values.js", stem);
  folder.attempt(file, [&] { write_pixel_script(folder / file, radiance, left_out); });
  return write_picture(folder, stem, radiance, exposure);
}

std::vector<std::string> page_picture_files(const std::string& exr) {
  const std::string stem = exr.substr(0, exr.size() - std::string_view(".exr").size());
  return {exr, stem + ".png", stem + "_values.js"};
}

std::string write_mask(const RunFolder& folder, const std::string& stem, const Image& mask) {
  Image picture(mask.width, mask.height, 4, 1.0F);
  for (std::size_t i = 0; i < mask.texels.size(); ++i)
    std::fill_n(picture.texels.begin() + static_cast<std::ptrdiff_t>(4 * i), 3, mask.texels[i]);
  return write_picture(folder, stem, picture, 1.0F);
}

double error_percentile(const Image& error) {
  std::vector<double> values;
  std::ranges::copy_if(error.texels, std::back_inserter(values), [](float v) { return v > 0.0F; });
  return values.empty() ? 0.0 : quantile(std::move(values), scale_quantile);
}

double error_scale(double largest, const std::optional<double>& given) {
  if (given) return *given;
  const double scale = std::max(largest, smallest_error_scale);
  const double step = std::pow(10.0, std::floor(std::log10(scale)) - 1.0);
  return std::ceil(scale / step) * step;
}

void write_error_images(const RunFolder& folder, DistanceResult& result, double top) {
  folder.attempt(result.reference, [&] {
    const Image reference = counted_reference(folder, result);
    const Image whole = read_back(folder, result.reference);
    const Image seen_reference = seen(whole, result.exposure.factor);
    Strip pictures, errors;
    pictures.add(to_display(whole, result.exposure.factor), fmt::format("reference, {:.0f} spp", result.work.samples));
    for (Record& record : result.records) {
      if (record.failure) continue;
      const Image picture = picture_of(folder, record);
      if (picture.empty()) continue;
      const Image error = error_map(picture, reference, result.exposure.factor);
      record.images.error = error_file(folder, record, "_error", error, top);
      record.images.error_shared = record.images.error;
      const Image flip = ldr_flip(seen(picture, result.exposure.factor), seen_reference);
      record.images.flip = error_file(folder, record, "_flip", flip, 1.0);
      pictures.add(to_display(picture, result.exposure.factor), record.method);
      errors.add(false_color(error, static_cast<float>(top)), record.method);
    }
    write_strips(folder, distance_stem(result.distance, "all"), pictures, errors, top);
  });
}

void write_shared_error_images(const RunFolder& folder, DistanceResult& result, double top) {
  folder.attempt(result.reference, [&] {
    const Image reference = counted_reference(folder, result);
    for (Record& record : result.records) {
      if (record.failure) continue;
      const Image picture = picture_of(folder, record);
      if (picture.empty()) continue;
      record.images.error_shared =
          error_file(folder, record, "_error_shared", error_map(picture, reference, result.exposure.factor), top);
    }
  });
}

}  // namespace footprint
