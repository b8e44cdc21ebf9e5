// An environment from a picture file: see load_environment in environment.hpp.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renderer/core/error.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/scene/environment.hpp"

namespace footprint {
namespace {

void require_finite(const Image& image, const std::string& name) {
  const auto bad = std::ranges::find_if_not(image.texels, [](float value) { return std::isfinite(value); });
  if (bad == image.texels.end()) return;
  const auto texel = static_cast<std::size_t>(bad - image.texels.begin()) / static_cast<std::size_t>(image.channels);
  const auto width = static_cast<std::size_t>(image.width);
  throw Error(ErrorKind::usage, name,
              fmt::format("the texel in column {}, row {} is {}", texel % width, texel / width, *bad),
              "radiance must be finite: fix the image");
}

// Three channels of a picture that has one or four; of four in place, as the largest take gigabytes.
Image with_three_channels(Image image) {
  if (image.channels == 1) {
    Image out(image.width, image.height, 3);
    for (std::size_t i = 0; i < out.texels.size(); ++i) out.texels[i] = image.texels[i / 3];
    return out;
  }
  for (std::size_t i = 0; i < image.texel_count(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) image.texels[3 * i + c] = image.texels[4 * i + c];
  }
  image.channels = 3;
  image.texels.resize(3 * image.texel_count());
  return image;
}

std::size_t clamp_negative(Image& image) {
  std::size_t count = 0;
  for (float& value : image.texels) {
    if (value >= 0.0F) continue;
    value = 0.0F;
    ++count;
  }
  return count;
}

}  // namespace

Environment load_environment(const std::filesystem::path& file, std::vector<std::string>& warnings) {
  Image image = read_image(file, Transfer::srgb);
  const std::string name = file.filename().string();
  if (image.channels == 2) {
    throw Error(ErrorKind::usage, file.string(), "has 2 channels", "give an environment with 1, 3 or 4 channels");
  }
  if (image.channels != 3) image = with_three_channels(std::move(image));
  require_finite(image, file.string());
  if (const std::size_t negative = clamp_negative(image); negative > 0)
    warnings.push_back(fmt::format("{}: {} negative values of radiance are taken as 0", name, negative));
  if (image.width > largest_environment_width || image.height > largest_environment_width / 2) {
    warnings.push_back(fmt::format("{}: {} x {} texels are averaged down to {} x {}", name, image.width, image.height,
                                   largest_environment_width, largest_environment_width / 2));
    image = resampled_environment(image, largest_environment_width, largest_environment_width / 2);
  }
  return {.name = name, .radiance = std::make_shared<const Image>(std::move(image))};
}

}  // namespace footprint
