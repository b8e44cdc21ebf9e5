// Checks sizes in the header before it allocates memory; writes to a temporary file and renames it.
#include "renderer/image/image_io.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <memory>
#include <mutex>
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

using IOProxy = OIIO::Filesystem::IOProxy;

constexpr int largest_side = 16384;

struct Signature {
  std::size_t offset;
  std::string_view bytes;
  const char* format;  // OpenImageIO's name
};

// The format by the first bytes, because glTF buffers have no names and names may be wrong.
constexpr std::array<Signature, 9> signatures{{{0, "\x89PNG\r\n\x1a\n", "png"},
                                               {0, "\xff\xd8\xff", "jpeg"},
                                               {0, "\x76\x2f\x31\x01", "openexr"},
                                               {0, "#?RADIANCE", "hdr"},
                                               {0, "#?RGBE", "hdr"},
                                               {0, {"II*\0", 4}, "tiff"},
                                               {0, {"MM\0*", 4}, "tiff"},
                                               {0, "BM", "bmp"},
                                               {8, "WEBP", "webp"}}};

Error unreadable(const std::string& name, const std::string& message) {
  return {ErrorKind::usage, name, message, "give a whole PNG, JPEG, EXR, Radiance HDR, TIFF, BMP or WebP file"};
}

// OpenImageIO ends some messages with line breaks and repeats others.
std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

// The reason that the reader gives, or else the one in OpenImageIO's queue of this thread, which must not be left for
// the next caller to find.
std::string reason_of_failure(const OIIO::ImageInput* input) {
  const std::string queued = OIIO::geterror();
  const std::string own = input != nullptr ? input->geterror() : std::string{};
  const std::string reason = first_line(own.empty() ? queued : own);
  return reason.empty() ? "it is damaged" : reason;
}

std::string format_of(IOProxy& source, const std::string& name) {
  std::array<char, 16> head{};
  if (source.size() == 0) throw unreadable(name, "the file is empty");
  const std::size_t length = source.pread(head.data(), std::min(head.size(), source.size()), 0);
  const std::string_view start(head.data(), length);
  for (const Signature& signature : signatures) {
    if (start.size() > signature.offset && start.substr(signature.offset).starts_with(signature.bytes)) {
      return signature.format;
    }
  }
  if (start.starts_with("\xabKTX 20")) throw unreadable(name, "is a KTX2 image, which is not read");
  throw unreadable(name, "is not an image of a known kind");
}

// Walks the chunks of a PNG to its end. Where one ends early, libpng would write to stderr and OpenImageIO 2.4 would
// lose a string to libpng's longjmp.
void require_whole_png(IOProxy& source, const std::string& name) {
  constexpr std::size_t signature_size = 8, frame_size = 12;  // length, type and CRC of a chunk
  std::array<std::uint8_t, 8> head{};
  for (std::size_t start = signature_size; start + frame_size <= source.size();) {
    source.pread(head.data(), head.size(), static_cast<std::int64_t>(start));
    const std::size_t length =
        std::size_t{head[0]} << 24 | std::size_t{head[1]} << 16 | std::size_t{head[2]} << 8 | head[3];
    start += frame_size + length;
    const bool is_end = std::string_view(reinterpret_cast<const char*>(&head[4]), 4) == "IEND";
    if (is_end && start <= source.size()) return;
  }
  throw unreadable(name, "is truncated or damaged: the PNG does not reach its end");
}

std::unique_ptr<OIIO::ImageInput> open_image(IOProxy& source, const std::string& name) {
  OIIO::ImageSpec config;
  IOProxy* proxy = &source;
  config.attribute("oiio:UnassociatedAlpha", 1);
  config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  const std::string format = format_of(source, name);
  if (format == "png") require_whole_png(source, name);
  std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(format, false, &config, proxy);
  OIIO::ImageSpec spec;
  if (!input || !input->open(name, spec, config)) {
    throw unreadable(name, fmt::format("cannot be read: {}", reason_of_failure(input.get())));
  }
  return input;
}

void check_header(const OIIO::ImageSpec& spec, const std::string& name, int max_side, int most_channels) {
  if (spec.width < 1 || spec.height < 1 || spec.depth != 1 || spec.deep) {
    throw unreadable(name, fmt::format("is not a flat image ({} x {} x {})", spec.width, spec.height, spec.depth));
  }
  if (spec.width > max_side || spec.height > max_side) {
    throw Error(ErrorKind::usage, name, fmt::format("declares {} x {} texels", spec.width, spec.height),
                fmt::format("at most {0} x {0} are taken; scale it down", max_side));
  }
  if (spec.nchannels < 1 || spec.nchannels > most_channels) {
    throw Error(ErrorKind::usage, name, fmt::format("has {} channels", spec.nchannels),
                fmt::format("give one with 1 to {} channels", most_channels));
  }
}

// The sRGB transfer curve of IEC 61966-2-1 and its inverse.
float srgb_decoded(float value) {
  return value <= 0.04045F ? value / 12.92F : std::pow((value + 0.055F) / 1.055F, 2.4F);
}
float srgb_encoded(float value) {
  return value <= 0.0031308F ? value * 12.92F : 1.055F * std::pow(value, 1.0F / 2.4F) - 0.055F;
}

void decode_srgb(Image& image, int alpha_channel) {
  for (std::size_t i = 0; i < image.texels.size(); ++i) {
    const int channel = static_cast<int>(i % static_cast<std::size_t>(image.channels));
    if (channel != alpha_channel) image.texels[i] = srgb_decoded(image.texels[i]);
  }
}

std::unique_ptr<IOProxy> opened(const std::filesystem::path& file) {
  const std::string name = file.string();
  std::error_code ignored;  // opening the file will fail
  const std::filesystem::file_status status = std::filesystem::status(file, ignored);
  if (!std::filesystem::exists(status)) throw Error(ErrorKind::usage, name, "no such file", "check the path");
  if (!std::filesystem::is_regular_file(status)) throw unreadable(name, "is not a file");
  auto source = std::make_unique<OIIO::Filesystem::IOFile>(name, IOProxy::Read);
  if (!source->opened()) throw Error(ErrorKind::usage, name, "cannot be opened", "check its permissions");
  return source;
}

Image decode_level(OIIO::ImageInput& input, const OIIO::ImageSpec& spec, int level, const std::string& name) {
  require_memory(frame_bytes(spec.width, spec.height, spec.nchannels * sizeof(float)), name,
                 "scale the image down, or free memory");
  Image image(spec.width, spec.height, spec.nchannels);
  const bool complete = input.read_image(0, level, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, image.texels.data());
  // The JPEG reader fills missing data, returns success and leaves a message.
  if (!complete || input.has_error())
    throw unreadable(name, fmt::format("is truncated or damaged: {}", reason_of_failure(&input)));
  return image;
}

Image decode(IOProxy& source, const std::string& name, Transfer transfer, int max_side) {
  const std::unique_ptr<OIIO::ImageInput> input = open_image(source, name);
  const OIIO::ImageSpec& spec = input->spec();
  check_header(spec, name, max_side, 4);
  Image image = decode_level(*input, spec, 0, name);
  if (transfer == Transfer::srgb && !spec.format.is_floating_point()) decode_srgb(image, spec.alpha_channel);
  return image;
}

std::uint64_t texels_of_header(IOProxy& source) {
  try {
    const std::unique_ptr<OIIO::ImageInput> input = open_image(source, "");
    check_header(input->spec(), "", largest_side, 4);
    return static_cast<std::uint64_t>(input->spec().width) * static_cast<std::uint64_t>(input->spec().height);
  } catch (const Error&) {
    return 0;  // reading it reports the reason
  }
}

void require_writable(const std::filesystem::path& file, const Image& image) {
  const bool taken = image.channels == 1 || image.channels == 3 || image.channels == 4;
  if (taken && !image.empty()) return;
  throw Error(
      ErrorKind::usage, file.string(),
      fmt::format("an image of {} x {} x {} channels cannot be written", image.width, image.height, image.channels),
      "write 1, 3 or 4 channels");
}

// Lines for files_not_finite.
class Ledger {
 public:
  void add(const std::filesystem::path& file, std::size_t broken, std::size_t pixels) {
    if (broken == 0) return;
    const std::lock_guard lock(mutex_);
    lines_.push_back(fmt::format("{}: {} of {} pixels are not finite", file.filename().string(), broken, pixels));
  }
  [[nodiscard]] std::vector<std::string> lines() const {
    const std::lock_guard lock(mutex_);
    return lines_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> lines_;
};

Ledger& ledger() {
  static Ledger all;
  return all;
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

// Of linear values, without the date: OpenImageIO stamps the hour, so equal images would be different files.
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
  const std::string reason = first_line(output ? output->geterror() : queued);
  // OpenImageIO reports nothing if it is out of memory.
  throw Error(ErrorKind::machine, name,
              fmt::format("cannot be encoded: {}", reason.empty() ? taken_memory_text() : reason));
}

}  // namespace

Image read_image(const std::filesystem::path& file, Transfer transfer, int max_side) {
  return decode(*opened(file), file.string(), transfer, max_side);
}

std::uint64_t texels_in_header(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return 0;
  OIIO::Filesystem::IOFile source(file.string(), IOProxy::Read);
  return source.opened() ? texels_of_header(source) : 0;
}

std::uint64_t texels_in_header(std::span<const std::uint8_t> bytes) {
  OIIO::Filesystem::IOMemReader source(bytes.data(), bytes.size());
  return texels_of_header(source);
}

bool is_exr(const std::filesystem::path& file) {
  constexpr std::array<char, 4> magic{'\x76', '\x2f', '\x31', '\x01'};
  std::array<char, 4> first{};
  std::ifstream(file, std::ios::binary).read(first.data(), first.size());
  return first == magic;
}

bool names_an_image(const std::filesystem::path& file) {
  constexpr std::array<std::string_view, 10> known{".exr",  ".png", ".jpg",  ".jpeg", ".tif",
                                                   ".tiff", ".bmp", ".webp", ".hdr",  ".tga"};
  return std::ranges::find(known, lower_extension(file)) != known.end();
}

Image read_image(std::span<const std::uint8_t> bytes, const std::string& name, Transfer transfer, int max_side) {
  OIIO::Filesystem::IOMemReader source(bytes.data(), bytes.size());
  return decode(source, name, transfer, max_side);
}

std::vector<std::string> files_not_finite() { return ledger().lines(); }

void write_exr(const std::filesystem::path& file, const Image& image) {
  require_writable(file, image);
  ledger().add(file, pixels_not_finite(image), image.texel_count());
  OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::FLOAT);
  if (image.channels == 1) spec.channelnames = {"Y"};
  describe_exr(spec);
  const std::array level{EncodedLevel{spec, image.texels.data()}};
  write_file_atomically(file, encoded(file.string(), "openexr", OIIO::TypeDesc::FLOAT, level));
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
  ledger().add(file, pixels_not_finite(image), image.texel_count());
  std::vector<std::uint8_t> bytes(image.texels.size());
  std::ranges::transform(image.texels, bytes.begin(),
                         [](float value) { return static_cast<std::uint8_t>(std::lround(clamped(value) * 255.0F)); });
  write_file_atomically(file, encoded_png(file.string(), image.width, image.height, image.channels, bytes));
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
  std::size_t broken = 0, texels = 0;
  for (const Image& level : chain.levels) {
    broken += pixels_not_finite(level);
    texels += level.texel_count();
  }
  ledger().add(file, broken, texels);
  for (const Image& level : chain.levels) levels.push_back({spec_of(chain, level, texel), level.texels.data()});
  write_file_atomically(file, encoded(file.string(), "openexr", OIIO::TypeDesc::FLOAT, levels));
}

ExrChain read_exr_chain(const std::filesystem::path& file, int most_channels) {
  const std::string name = file.string();
  const std::unique_ptr<IOProxy> source = opened(file);
  if (!is_exr(file)) throw Error(ErrorKind::usage, name, "is not an EXR", "give a whole EXR");
  const std::unique_ptr<OIIO::ImageInput> input = open_image(*source, name);
  OIIO::ImageSpec spec = input->spec();
  ExrChain chain{.levels = {}, .channels = spec.channelnames};
  for (int level = 0; input->seek_subimage(0, level, spec); ++level) {
    check_header(spec, name, largest_side, most_channels);
    chain.levels.push_back(decode_level(*input, spec, level, name));
  }
  (void)input->geterror();  // clears the message that no level follows
  return chain;
}

}  // namespace footprint
