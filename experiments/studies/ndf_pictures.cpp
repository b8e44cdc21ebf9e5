// Discs of the hemisphere in false colour, side by side and each alone.
#include "experiments/studies/ndf_pictures.hpp"

#include <algorithm>
#include <cmath>

#include "experiments/studies/picture_files.hpp"
#include "renderer/image/false_color.hpp"
#include "renderer/image/image_io.hpp"

namespace footprint {
namespace {

constexpr float around = 0.18F;  // grey outside of the disc, so that its edge shows

Image one_channel(int size, std::span<const float> densities) {
  Image image(size, size, 1);
  std::ranges::copy(densities, image.texels.begin());
  return image;
}

bool outside(int size, int column, int row) {
  const double x = 2.0 * (column + 0.5) / size - 1.0;
  const double y = 2.0 * (row + 0.5) / size - 1.0;
  return x * x + y * y >= 1.0;
}

Image colored(int size, std::span<const float> values, float scale) {
  Image picture = false_color(one_channel(size, values), scale);
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column) {
      if (outside(size, column, row)) std::ranges::fill(picture.at(column, row), around);
    }
  }
  return picture;
}

std::vector<float> differences(std::span<const float> a, std::span<const float> b) {
  std::vector<float> out(a.size());
  std::ranges::transform(a, b, out.begin(), [](float x, float y) { return std::abs(x - y); });
  return out;
}

// A strip with one row of captions: the images and the captions under them.
struct Row {
  std::vector<Image> pictures;
  std::vector<std::string> captions;

  void add(const Image& picture, const std::string& caption) {
    pictures.push_back(picture);
    captions.push_back(caption);
  }
};

}  // namespace

void write_ndf_pictures(const std::filesystem::path& folder, int size, const NdfPicture& exact,
                        std::span<const NdfPicture> methods, NdfResults& results) {
  const float scale = *std::ranges::max_element(exact.densities);
  results.scale = scale;
  const auto write = [&](const NdfPicture& picture, NdfImages& images) {
    images.density = "images/" + picture.stem + ".exr";
    images.picture = "images/" + picture.stem + ".png";
    Image shown = colored(size, picture.densities, scale);
    write_exr(folder / images.density, one_channel(size, picture.densities));
    write_png(folder / images.picture, shown);
    return shown;
  };
  Row densities, errors;
  densities.add(write(exact, results.exact.images), exact.caption);
  errors.add(Image(size, size, 3, around), "| method - truth |");
  for (std::size_t i = 0; i < methods.size(); ++i) {
    NdfImages& images = results.records.at(i).images;
    densities.add(write(methods[i], images), methods[i].caption);
    images.difference = "images/" + methods[i].stem + "_difference.png";
    errors.add(colored(size, differences(methods[i].densities, exact.densities), scale), methods[i].caption);
    write_png(folder / images.difference, errors.pictures.back());
  }
  const Image strip =
      stacked(labelled_strip(densities.pictures, densities.captions), labelled_strip(errors.pictures, errors.captions));
  const Image legend = false_color_legend(strip.width, std::max(24, size / 12), scale);
  results.strip = "ndf.png";
  write_png(folder / results.strip, stacked(strip, legend));
}

}  // namespace footprint
