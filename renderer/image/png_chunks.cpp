// Reads each chunk's length and type, and the content of those that declare something.
#include "renderer/image/png_chunks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string_view>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

using IOProxy = OIIO::Filesystem::IOProxy;

constexpr std::size_t signature_size = 8, frame_size = 12;  // length, type and CRC of a chunk
constexpr std::size_t largest_content = 65536;              // of a chunk that declares something
constexpr std::array<std::string_view, 6> declaring{"eXIf", "cICP", "iCCP", "sRGB", "gAMA", "cHRM"};

std::uint32_t number_at(std::string_view bytes, std::size_t place) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8U | static_cast<std::uint8_t>(bytes[place + i]);
  return value;
}

std::string read_chunk_content(IOProxy& source, std::size_t start, std::size_t length) {
  std::string content(std::min(length, largest_content), '\0');
  content.resize(source.pread(content.data(), content.size(), static_cast<std::int64_t>(start)));
  return content;
}

// The declaring chunks by type. The walk goes to the end: where a chunk ends early, libpng would write to stderr and
// OpenImageIO 2.4 would lose a string to libpng's longjmp.
std::map<std::string, std::string> read_chunks(IOProxy& source, const std::string& name) {
  std::map<std::string, std::string> chunks;
  std::array<char, 8> head{};
  for (std::size_t start = signature_size; start + frame_size <= source.size();) {
    source.pread(head.data(), head.size(), static_cast<std::int64_t>(start));
    const std::size_t length = number_at({head.data(), 4}, 0);
    const std::string type(&head[4], 4);
    if (std::ranges::find(declaring, type) != declaring.end())
      chunks.emplace(type, read_chunk_content(source, start + head.size(), length));
    start += frame_size + length;
    if (type == "IEND" && start <= source.size()) return chunks;
  }
  throw Error(ErrorKind::usage, name, "is truncated or damaged: the PNG does not reach its end", "give a whole PNG");
}

// Coding-independent code points (ITU-T H.273).
void take_code_points(std::string_view content, Declarations& declared) {
  constexpr char rec709_primaries = 1, linear = 8, srgb = 13;
  const char primaries = content[0], curve = content[1];
  if (curve == linear) declared.gamma = 1.0;
  if (primaries == rec709_primaries && (curve == linear || curve == srgb)) return;
  declared.unknown_colors =
      fmt::format("declares colours of H.273's code points {} and {} (cICP)", int{primaries}, int{curve});
}

// sRGB's curve has no exponent: encoders write 1 / 2.2 for it, and libpng takes 5% around that for sRGB.
void take_gamma_chunk(std::string_view content, Declarations& declared) {
  constexpr double unit = 1e5, srgb = 0.45455, tolerance = 0.05;
  const double gamma = number_at(content, 0) / unit;
  if (gamma > 0.0 && std::abs(gamma / srgb - 1.0) > tolerance) declared.gamma = gamma;
}

// A white and three primaries.
void take_chromaticities(std::string_view content, Declarations& declared) {
  constexpr double unit = 1e5;
  Chromaticities& xy = declared.chromaticities.emplace();
  for (std::size_t i = 0; i < xy.size(); ++i) xy.at((i + 6) % xy.size()) = number_at(content, 4 * i) / unit;
}

}  // namespace

void read_png_chunks(IOProxy& source, const std::string& name, Declarations& declared) {
  const std::map<std::string, std::string> chunks = read_chunks(source, name);
  const auto content = [&](const char* type, std::size_t least) -> const std::string* {
    const auto found = chunks.find(type);
    return found != chunks.end() && found->second.size() >= least ? &found->second : nullptr;
  };
  if (const auto* exif = content("eXIf", 0)) declared.orientation = exif_orientation(*exif);
  if (const auto* points = content("cICP", 4)) return take_code_points(*points, declared);
  if (const auto* profile = content("iCCP", 1)) {
    declared.profile = profile->c_str();  // the name before the first zero
    return;
  }
  if (content("sRGB", 1) != nullptr) return;
  if (const auto* gamma = content("gAMA", 4)) take_gamma_chunk(*gamma, declared);
  if (const auto* chromaticities = content("cHRM", 32)) take_chromaticities(*chromaticities, declared);
}

}  // namespace footprint
