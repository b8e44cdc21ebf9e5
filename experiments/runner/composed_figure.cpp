// Cuts, enlarges and labels the pictures of a composed figure and pads them into rows.
#include "experiments/runner/run_experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "experiments/studies/picture_files.hpp"
#include "renderer/image/false_color.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/image/metrics.hpp"

namespace footprint {
namespace {

constexpr int smallest_shown = 300;  // pixels per side that a picture is enlarged to, by whole factors
constexpr int frame_width = 2;

struct Rectangle {
  int left, top, width, height;
};

Rectangle rectangle_of(const Image& picture, const Crop& crop) {
  const auto start = [](double share, int length) {
    return std::clamp(static_cast<int>(share * length), 0, length - 1);
  };
  const int left = start(crop[0], picture.width), top = start(crop[1], picture.height);
  const auto extent = [](double share, int length, int from) {
    return std::clamp(static_cast<int>(std::lround(share * length)), from + 1, length) - from;
  };
  return {left, top, extent(crop[2], picture.width, left), extent(crop[3], picture.height, top)};
}

// Each pixel as a square of `factor` pixels: what a method did is not smoothed away.
Image enlarged(const Image& picture, int factor) {
  Image large(picture.width * factor, picture.height * factor, picture.channels);
  for (int y = 0; y < large.height; ++y) {
    for (int x = 0; x < large.width; ++x) std::ranges::copy(picture.at(x / factor, y / factor), large.at(x, y).begin());
  }
  return large;
}

void paste_framed(const Image& part, int left, int top, Image& picture) {
  const int line = frame_width;
  paste(Image(part.width + 2 * line, part.height + 2 * line, part.channels, 1.0F), left - line, top - line, picture);
  paste(part, left, top, picture);
}

Image shown(const Image& display, const FigurePicture& picture, const FigureLayout& layout) {
  Image part = cropped(display, picture.crop.value_or(layout.crop));
  const int factor = std::max(1, (smallest_shown + part.width - 1) / std::max(part.width, 1));
  if (factor > 1) part = enlarged(part, factor);
  return layout.inset ? with_inset(part, *layout.inset) : part;
}

// On black, all as high as the highest: a row has one height.
void pad_to_one_height(std::vector<Image>& pictures) {
  if (pictures.empty()) return;
  const int height = std::ranges::max(pictures, {}, &Image::height).height;
  for (Image& picture : pictures) {
    Image padded(picture.width, height, picture.channels);
    paste(picture, 0, (height - picture.height) / 2, padded);
    picture = std::move(padded);
  }
}

Image stacked_rows(const std::vector<Image>& rows) {
  return std::accumulate(rows.begin() + 1, rows.end(), rows.front(), stacked);
}

struct Composer {
  const FigureLayout& layout;
  const Experiment& experiment;
  const Results& results;
  const RunFolder& folder;

  [[nodiscard]] std::vector<std::string> write() const {
    std::vector<Image> rows, error_rows;
    for (const std::vector<FigurePicture>& row : layout.rows) add_row(row, rows, error_rows);
    write_png(folder / "images/figure.png", stacked_rows(rows));
    if (error_rows.empty()) return {"images/figure.png"};
    const int width = std::ranges::max(error_rows, {}, &Image::width).width;
    error_rows.push_back(false_color_legend(width, 28, static_cast<float>(results.error_scale)));
    write_png(folder / "images/figure_errors.png", stacked_rows(error_rows));
    return {"images/figure.png", "images/figure_errors.png"};
  }

  void add_row(const std::vector<FigurePicture>& row, std::vector<Image>& rows, std::vector<Image>& error_rows) const {
    Strip pictures, errors;
    for (const FigurePicture& picture : row) {
      const Record& record = record_of(picture);
      const auto exposure = static_cast<float>(results.scene.exposure);
      const Image reference = read_image(folder / record.images.reference, Transfer::linear);
      const Image image = picture.method ? read_image(folder / record.images.color, Transfer::linear) : reference;
      pictures.add(shown(to_display(image, exposure), picture, layout), caption(picture, record));
      if (!picture.method) continue;
      const Image error = false_color(error_map(image, reference, exposure), static_cast<float>(results.error_scale));
      errors.add(shown(error, picture, layout), pictures.captions.back());
    }
    pad_to_one_height(pictures.pictures);
    pad_to_one_height(errors.pictures);
    rows.push_back(pictures.drawn());
    if (!errors.pictures.empty()) error_rows.push_back(errors.drawn());
  }

  // Records stand frame by frame, in each in the order of the methods.
  const Record& record_of(const FigurePicture& picture) const {
    return results.records.at(picture.frame * experiment.run.methods.size() + picture.method.value_or(0));
  }

  // The mean, because the noise may need more samples than `spp` in some tiles.
  std::string samples_text() const {
    const ReferenceInfo& reference = results.reference;
    if (reference.samples <= reference.spp) return fmt::format("{} spp", reference.spp);
    return fmt::format("{:.0f} spp on average", reference.samples);
  }

  std::string caption(const FigurePicture& picture, const Record& record) const {
    const std::string label = picture.label.empty() ? "" : picture.label + " ";
    if (!picture.method) return fmt::format("{}reference, {}", label, samples_text());
    const std::string error = record.error ? fmt::format(": {:.3f}", record.error->normalized_color) : "";
    return label + record.method + error;
  }
};

}  // namespace

Image cropped(const Image& picture, const Crop& crop) {
  const Rectangle part = rectangle_of(picture, crop);
  Image result(part.width, part.height, picture.channels);
  paste(picture, -part.left, -part.top, result);
  return result;
}

Image with_inset(const Image& picture, const Crop& inset, double share) {
  const Rectangle part = rectangle_of(picture, inset);
  const Image own = cropped(picture, inset);
  const Image large = enlarged(own, std::max(1, static_cast<int>(share * picture.width / part.width)));
  Image result = picture;
  paste_framed(own, part.left, part.top, result);
  paste_framed(large, std::max(0, picture.width - large.width - frame_width),
               std::max(0, picture.height - large.height - frame_width), result);
  return result;
}

std::vector<std::string> write_figures(const FigureLayout& layout, const Experiment& experiment, const Results& results,
                                       const RunFolder& folder) {
  if (layout.rows.empty()) return {};
  return Composer{layout, experiment, results, folder}.write();
}

}  // namespace footprint
