// Encodes in memory; writes to a temporary file and renames it.
#include "renderer/image/image_io.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "renderer/core/bytes.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/files.hpp"
#include "renderer/core/memory.hpp"
#include "renderer/core/names.hpp"
#include "renderer/image/mipmap.hpp"

namespace footprint {
namespace {

// The inverse of the sRGB transfer curve of IEC 61966-2-1.
float srgb_encoded(float value) {
  return value <= 0.0031308F ? value * 12.92F : 1.055F * std::pow(value, 1.0F / 2.4F) - 0.055F;
}

void require_writable(const std::filesystem::path& file, const Image& image) {
  const bool taken = image.channels == 1 || image.channels == 3 || image.channels == 4;
  if (taken && !image.empty()) return;
  throw Error(
      ErrorKind::usage, file.string(),
      fmt::format("an image of {} x {} x {} channels cannot be written", image.width, image.height, image.channels),
      "write 1, 3 or 4 channels");
}

std::size_t pixels_not_finite(const Image& image) {
  std::size_t count = 0;
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i < image.texels.size(); i += channels) {
    const std::span<const float> pixel(&image.texels[i], channels);
    count += std::ranges::all_of(pixel, [](float value) { return std::isfinite(value); }) ? 0 : 1;
  }
  return count;
}

// After a file was written: it has the pixels that are finite, and the others must not pass unnoticed.
void require_finite(const std::filesystem::path& file, std::span<const Image> images) {
  std::size_t broken = 0, pixels = 0;
  for (const Image& image : images) {
    broken += pixels_not_finite(image);
    pixels += image.texel_count();
  }
  if (broken > 0)
    throw Error(ErrorKind::check, file.string(), fmt::format("{} of {} pixels are not finite", broken, pixels));
}

float clamped(float value) { return value > 0.0F ? std::min(value, 1.0F) : 0.0F; }  // NaN as 0

constexpr int exr_tile = 64;  // as maketx makes it

void require_chain(const ExrChain& chain) {
  const auto& levels = chain.levels;
  if (levels.empty()) throw std::logic_error("a chain has a level");
  const Image& finest = levels.front();
  const bool is_whole = static_cast<int>(levels.size()) == mip_level_count(finest.width, finest.height);
  if (levels.size() > 1 && !is_whole) throw std::logic_error("a chain goes down to one texel");
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const bool fits = levels[i].width == std::max(finest.width >> i, 1) &&
                      levels[i].height == std::max(finest.height >> i, 1) && levels[i].channels == finest.channels;
    if (!fits) throw std::logic_error("the sizes of the levels do not form a mip chain");
  }
  if (chain.channels.size() != static_cast<std::size_t>(finest.channels))
    throw std::logic_error("every channel has a name");
}

// Declares linear values, without the date: OpenImageIO stamps the hour, so equal images would be different files.
void describe_exr(OIIO::ImageSpec& spec) {
  spec.attribute("compression", "zip");
  spec.attribute("oiio:ColorSpace", "Linear");
  spec.attribute("DateTime", "");
}

OIIO::ImageSpec spec_of(const ExrChain& chain, const Image& level, ExrTexel texel) {
  OIIO::ImageSpec spec(level.width, level.height, level.channels,
                       texel == ExrTexel::half ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT);
  spec.channelnames = chain.channels;
  spec.alpha_channel = -1;  // no channel is coverage
  describe_exr(spec);
  if (chain.levels.size() > 1) {
    spec.tile_width = spec.tile_height = exr_tile;
    spec.attribute("textureformat", "Plain Texture");  // which makes OpenImageIO write levels
    spec.attribute("openexr:roundingmode", 0);         // floor(n / 2), OpenGL's sizes
  }
  return spec;
}

struct EncodedLevel {
  OIIO::ImageSpec spec;
  const void* texels;
};

// The bytes of a file of all levels, whose texels are of `type`.
std::vector<unsigned char> encoded(const std::string& name, const char* format, const OIIO::TypeDesc& type,
                                   std::span<const EncodedLevel> levels) {
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput target(bytes);
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format, &target);
  auto mode = OIIO::ImageOutput::Create;
  const auto written = [&](const EncodedLevel& level) {
    return output->open(name, level.spec, std::exchange(mode, OIIO::ImageOutput::AppendMIPLevel)) &&
           output->write_image(type, level.texels);
  };
  if (output && std::ranges::all_of(levels, written) && output->close()) return bytes;
  const std::string queued = OIIO::geterror();
  const std::string own = output ? output->geterror() : queued;
  const std::string reason = own.substr(0, own.find('\n'));  // further lines repeat it
  // OpenImageIO reports nothing if it is out of memory.
  throw Error(ErrorKind::machine, name,
              fmt::format("cannot be encoded: {}", reason.empty() ? taken_memory_text() : reason));
}

}  // namespace

void write_exr(const std::filesystem::path& file, const Image& image) {
  require_writable(file, image);
  OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::FLOAT);
  if (image.channels == 1) spec.channelnames = {"Y"};
  describe_exr(spec);
  const std::array level{EncodedLevel{spec, image.texels.data()}};
  write_file_atomically(file, encoded(file.string(), "openexr", OIIO::TypeDesc::FLOAT, level));
  require_finite(file, std::span(&image, 1));
}

std::vector<unsigned char> encoded_png(const std::string& name, int width, int height, int channels,
                                       std::span<const std::uint8_t> texels) {
  OIIO::ImageSpec spec(width, height, channels, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");  // browsers convert no other
  spec.attribute("oiio:UnassociatedAlpha", 1);
  const std::array level{EncodedLevel{spec, texels.data()}};
  return encoded(name, "png", OIIO::TypeDesc::UINT8, level);
}

void write_png(const std::filesystem::path& file, const Image& image) {
  require_writable(file, image);
  std::vector<std::uint8_t> bytes(image.texels.size());
  std::ranges::transform(image.texels, bytes.begin(),
                         [](float value) { return static_cast<std::uint8_t>(std::lround(clamped(value) * 255.0F)); });
  write_file_atomically(file, encoded_png(file.string(), image.width, image.height, image.channels, bytes));
  require_finite(file, std::span(&image, 1));
}

Image to_display(const Image& radiance, float exposure) {
  Image display = radiance;
  const bool has_alpha = radiance.channels == 4;
  for (std::size_t i = 0; i < display.texels.size(); ++i) {
    const bool is_alpha = has_alpha && i % 4 == 3;
    const bool background = has_alpha && !(radiance.texels[i / 4 * 4 + 3] > 0.0F);
    if (is_alpha || (!background && !std::isfinite(radiance.texels[i]))) continue;
    display.texels[i] = background ? 0.0F : srgb_encoded(clamped(exposure * radiance.texels[i]));
  }
  return display;
}

void write_exr_chain(const std::filesystem::path& file, const ExrChain& chain, ExrTexel texel) {
  require_chain(chain);
  std::vector<EncodedLevel> levels;
  for (const Image& level : chain.levels) levels.push_back({spec_of(chain, level, texel), level.texels.data()});
  write_file_atomically(file, encoded(file.string(), "openexr", OIIO::TypeDesc::FLOAT, levels));
  require_finite(file, chain.levels);
}

}  // namespace footprint
