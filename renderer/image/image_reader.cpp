// Reads texels, and gives them the meaning that their file declares or that their use demands.
#include <OpenImageIO/filesystem.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <memory>
#include <span>
#include <string_view>
#include <utility>

#include "renderer/core/error.hpp"
#include "renderer/core/names.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/image/opened_image.hpp"

namespace footprint {
namespace {

using IOProxy = OIIO::Filesystem::IOProxy;

constexpr int largest_side = 16384;

// The sRGB transfer curve of IEC 61966-2-1.
float srgb_decoded(float value) {
  return value <= 0.04045F ? value / 12.92F : std::pow((value + 0.055F) / 1.055F, 2.4F);
}

// What becomes of an image: its colour channels, and whether its file's colour space counts.
struct Reading {
  Transfer transfer;
  const Declarations& declared;
  int colors;     // channels that are not coverage
  bool coverage;  // the last channel is coverage

  [[nodiscard]] bool has_own_space() const {
    return transfer == Transfer::declared || (transfer == Transfer::srgb && declared.floats);
  }
};

template <class Change>
void change_colors(Image& image, const Reading& reading, const Change& change) {
  for (std::size_t i = 0; i < image.texel_count(); ++i) {
    float* const texel = &image.texels[i * static_cast<std::size_t>(image.channels)];
    change(std::span(texel, static_cast<std::size_t>(reading.colors)));
  }
}

// Takes each mantissa of a Radiance HDR as (m + 1/2) of 256, the middle of what is stored as m, as Radiance does.
// OpenImageIO takes m, which is up to 0.4% too dark. The largest mantissa of a pixel is 128 or more.
void centre_mantissas(Image& image) {
  for (std::size_t i = 0; i < image.texel_count(); ++i) {
    const std::span texel(&image.texels[i * static_cast<std::size_t>(image.channels)], 3);
    const float largest = std::ranges::max(texel);
    if (largest <= 0.0F) continue;
    int exponent = 0;
    std::frexp(largest, &exponent);
    for (float& value : texel) value += std::ldexp(0.5F, exponent - 8);
  }
}

void divide_by_factors(Image& image, const Reading& reading) {
  const glm::dvec3& factors = reading.declared.factors;
  if (factors == glm::dvec3(1.0)) return;
  change_colors(image, reading, [&](std::span<float> color) {
    for (std::size_t c = 0; c < color.size(); ++c)
      color[c] = static_cast<float>(color[c] / factors[static_cast<int>(std::min<std::size_t>(c, 2))]);
  });
}

// Whether colours are below alpha everywhere, as those that were multiplied by it are.
bool is_multiplied(const Image& image, const Reading& reading) {
  bool opaque = true;
  for (std::size_t i = 0; i < image.texel_count(); ++i) {
    const float* const texel = &image.texels[i * static_cast<std::size_t>(image.channels)];
    const float alpha = texel[reading.colors];
    opaque = opaque && alpha >= 1.0F;
    if (std::any_of(texel, texel + reading.colors, [&](float value) { return value > alpha; })) return false;
  }
  return !opaque;
}

// Straight colours of an image whose file multiplied them by alpha. Of data nothing is left under alpha 0.
void divide_by_alpha(Image& image, const Reading& reading, const std::string& name) {
  if (!reading.coverage || !reading.declared.associated || reading.declared.floats || !is_multiplied(image, reading))
    return;
  if (reading.transfer == Transfer::linear) {
    throw Error(ErrorKind::usage, name, "its channels are multiplied by alpha (associated alpha), but they are data",
                "save it without alpha, or with unassociated alpha");
  }
  for (std::size_t i = 0; i < image.texel_count(); ++i) {
    float* const texel = &image.texels[i * static_cast<std::size_t>(image.channels)];
    if (const float alpha = texel[reading.colors]; alpha > 0.0F)
      std::for_each(texel, texel + reading.colors, [&](float& value) { value = std::min(value / alpha, 1.0F); });
  }
}

void decode_curve(Image& image, const Reading& reading) {
  if (reading.transfer == Transfer::linear || reading.declared.floats) return;
  const bool has_power = reading.transfer == Transfer::declared && reading.declared.gamma;
  const double exponent = has_power ? 1.0 / *reading.declared.gamma : 1.0;
  change_colors(image, reading, [&](std::span<float> color) {
    for (float& value : color)
      value = has_power ? static_cast<float>(std::pow(static_cast<double>(value), exponent)) : srgb_decoded(value);
  });
}

void convert_space(Image& image, const Reading& reading, const std::string& name) {
  if (reading.transfer == Transfer::linear && reading.declared.xyz)
    throw Error(ErrorKind::usage, name, "stores CIE XYZ, but data is expected", "save it as RGB");
  if (!reading.has_own_space()) return;
  const std::optional<glm::dmat3> matrix = rec709_from(reading.declared, name);
  if (!matrix || reading.colors != 3) return;
  change_colors(image, reading, [&](std::span<float> color) {
    const glm::dvec3 converted = *matrix * glm::dvec3(color[0], color[1], color[2]);
    for (std::size_t c = 0; c < 3; ++c) color[c] = static_cast<float>(converted[static_cast<int>(c)]);
  });
}

Image with_coverage(const Image& image) {
  return mapped(
      image, 4, [](const auto& in, const auto& out) { std::ranges::copy(in, out.begin()); }, 1.0F);
}

// A picture that stores a part of its pixels covers no others.
Image in_its_window(Image image, const Reading& reading) {
  const Declarations& declared = reading.declared;
  if (declared.stored == declared.shown) return image;
  if (reading.transfer == Transfer::declared && image.channels == 3) image = with_coverage(image);
  return placed(image, declared.stored, declared.shown);
}

bool stores_all(const PixelWindow& stored, const PixelWindow& shown) {
  return stored.x <= shown.x && stored.y <= shown.y && stored.x + stored.width >= shown.x + shown.width &&
         stored.y + stored.height >= shown.y + shown.height;
}

std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t most = 4;
  const std::size_t count = std::min(names.size(), most);
  const std::string text = fmt::format("{}", fmt::join(names.begin(), names.begin() + static_cast<int>(count), ", "));
  return names.size() > most ? fmt::format("{} and {} more", text, names.size() - most) : text;
}

// Notes on what is left out of a file, one line each.
std::vector<std::string> notes_of(const OpenedImage& file, const Reading& reading, bool turned) {
  const Declarations& declared = file.declared();
  std::vector<std::string> notes = declared.left_out;
  const std::vector<std::string>& others = file.channels().left_out;
  if (!others.empty())
    notes.push_back(fmt::format("channel{} {}: left out", others.size() == 1 ? "" : "s", listed(others)));
  if (!file.channels().layer.empty()) notes.push_back(fmt::format("its layer `{}` is read", file.channels().layer));
  if (!stores_all(declared.stored, declared.shown)) {
    notes.push_back(fmt::format("it stores a part of its {} x {} pixels: the others are 0", declared.shown.width,
                                declared.shown.height));
  }
  if (!turned && declared.orientation != 1) {
    notes.push_back(fmt::format("its orientation ({}) is ignored: a map has its rows as stored; turn the pixels",
                                declared.orientation));
  }
  if (reading.transfer == Transfer::declared && !declared.profile.empty() &&
      lower_case(declared.profile).find("srgb") == std::string::npos) {
    notes.push_back(
        fmt::format("its ICC profile ({:.60}) is ignored: its colours are taken as sRGB", declared.profile));
  }
  return notes;
}

FileImage decode(IOProxy& source, const std::string& name, Transfer transfer, int max_side) {
  OpenedImage file(source, name, {.side = max_side, .takes_vectors = transfer == Transfer::linear});
  FileImage out{.image = file.texels(), .floats = file.declared().floats, .notes = {}};
  const bool coverage = file.channels().has_coverage;
  const Reading reading{.transfer = transfer,
                        .declared = file.declared(),
                        .colors = out.image.channels - (coverage ? 1 : 0),
                        .coverage = coverage};
  if (file.is_radiance_hdr()) centre_mantissas(out.image);
  divide_by_factors(out.image, reading);
  divide_by_alpha(out.image, reading, name);
  decode_curve(out.image, reading);
  convert_space(out.image, reading, name);
  out.image = in_its_window(std::move(out.image), reading);
  const bool turned = transfer == Transfer::declared || file.is_radiance_hdr();
  if (turned) out.image = oriented(std::move(out.image), file.declared().orientation);
  out.notes = notes_of(file, reading, turned);
  return out;
}

std::uint64_t texels_of_header(IOProxy& source) {
  try {
    const OpenedImage file(source, "", {.side = largest_side});
    const PixelWindow& shown = file.declared().shown;
    return static_cast<std::uint64_t>(shown.width) * static_cast<std::uint64_t>(shown.height);
  } catch (const Error&) {
    return 0;  // reading it reports the reason
  }
}

}  // namespace

FileImage read_file_image(const std::filesystem::path& file, Transfer transfer, int max_side) {
  return decode(*opened_source(file), file.string(), transfer, max_side);
}

FileImage read_file_image(std::span<const std::uint8_t> bytes, const std::string& name, Transfer transfer,
                          int max_side) {
  OIIO::Filesystem::IOMemReader source(bytes.data(), bytes.size());
  return decode(source, name, transfer, max_side);
}

Image read_image(const std::filesystem::path& file, Transfer transfer, int max_side) {
  return read_file_image(file, transfer, max_side).image;
}

Image read_image(std::span<const std::uint8_t> bytes, const std::string& name, Transfer transfer, int max_side) {
  return read_file_image(bytes, name, transfer, max_side).image;
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
  constexpr std::array<std::string_view, 11> known{".exr", ".png",  ".jpg", ".jpeg", ".tif", ".tiff",
                                                   ".bmp", ".webp", ".hdr", ".pic",  ".rgbe"};
  return std::ranges::find(known, lower_extension(file)) != known.end();
}

ExrChain read_exr_chain(const std::filesystem::path& file, int most_channels) {
  const std::string name = file.string();
  const std::unique_ptr<IOProxy> source = opened_source(file);
  if (!is_exr(file)) throw Error(ErrorKind::usage, name, "is not an EXR", "give a whole EXR");
  OpenedImage opened(*source, name, {.side = largest_side, .channels = most_channels});
  if (opened.declared().stored != opened.declared().shown) {
    throw Error(ErrorKind::usage, name, "stores other pixels than its picture has (data and display window)",
                "save it with equal windows");
  }
  ExrChain chain{.levels = {}, .channels = opened.channel_names()};
  for (int level = 0; opened.seek_level(level); ++level) chain.levels.push_back(opened.texels());
  return chain;
}

}  // namespace footprint
