// Parses the lines of the header (Ward, "Real pixels", Graphics Gems II; Radiance's file format document).
#include "renderer/image/radiance_header.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <sstream>
#include <vector>

#include "renderer/core/error.hpp"
#include "renderer/core/numbers.hpp"

namespace footprint {
namespace {

Error damaged(const std::string& name, const std::string& message) {
  return {ErrorKind::usage, name, message, "give a whole Radiance HDR file"};
}

std::vector<std::string> words_of(std::string_view text) {
  std::istringstream stream{std::string(text)};
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

// The numbers of a line; none if there are not `count` finite ones.
std::optional<std::vector<double>> numbers_in(std::string_view text, std::size_t count) {
  std::vector<double> numbers;
  for (const std::string& word : words_of(text)) {
    const auto number = parse_whole_of<double>(word.starts_with('+') ? word.substr(1) : word);
    if (!number || !std::isfinite(*number)) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers.size() == count ? std::optional(numbers) : std::nullopt;
}

// Multiplies the factors by those of a line: one for all channels, or one for each.
void multiply(std::string_view line, std::string_view text, std::size_t count, const std::string& name,
              glm::dvec3& factors) {
  const auto numbers = numbers_in(text, count);
  for (std::size_t c = 0; c < 3; ++c) {
    const double factor = numbers ? numbers->at(c % count) : 0.0;
    factors[static_cast<int>(c)] *= factor;
    const double product = factors[static_cast<int>(c)];
    if (!(factor > 0.0) || !(product > 0.0) || !std::isfinite(product))
      throw damaged(name, fmt::format("`{:.80}` is not {} above 0", line, count == 1 ? "a number" : "three numbers"));
  }
}

void take_format(std::string_view text, const std::string& name, Declarations& declared) {
  const std::vector<std::string> words = words_of(text);
  declared.xyz = words == std::vector<std::string>{"32-bit_rle_xyze"};
  if (declared.xyz || words == std::vector<std::string>{"32-bit_rle_rgbe"}) return;
  throw Error(ErrorKind::usage, name, fmt::format("its format `{:.80}` is neither RGBE nor XYZE", text),
              "save it as RGBE, or as an EXR");
}

void take_gamma(std::string_view text, Declarations& declared) {
  const auto gamma = numbers_in(text, 1);
  if (gamma && std::abs(gamma->front() - 1.0) < 1e-3) return;
  declared.unknown_colors = fmt::format("declares GAMMA={:.40}, but radiance is linear", text);
}

void take_line(std::string_view line, const std::string& name, Declarations& declared) {
  const std::size_t equals = line.find('=');
  if (line.starts_with('#') || equals == std::string_view::npos) return;
  const std::string_view key = line.substr(0, equals), value = line.substr(equals + 1);
  if (key == "FORMAT") take_format(value, name, declared);
  if (key == "EXPOSURE") multiply(line, value, 1, name, declared.factors);
  if (key == "COLORCORR") multiply(line, value, 3, name, declared.factors);
  if (key == "GAMMA") take_gamma(value, declared);
  if (key != "PRIMARIES") return;
  const auto numbers = numbers_in(value, 8);
  if (!numbers) throw damaged(name, fmt::format("`{:.80}` is not eight chromaticities", line));
  std::ranges::copy(*numbers, declared.chromaticities.emplace().begin());
}

// EXIF's number for an order: the axes of scanlines and of pixels, as "-Y+X".
int orientation_of(std::string_view order) {
  constexpr std::array<std::string_view, 8> orders{"-Y+X", "-Y-X", "+Y-X", "+Y+X", "+X-Y", "-X-Y", "-X+Y", "+X+Y"};
  return static_cast<int>(std::ranges::find(orders, order) - orders.begin()) + 1;
}

void take_size(std::string_view line, const std::string& name, RadianceHeader& header) {
  const std::vector<std::string> words = words_of(line);
  constexpr int orders = 8;
  if (words.size() == 4) {
    const auto scanlines = parse_whole_of<int>(words[1]), pixels = parse_whole_of<int>(words[3]);
    header.declared.orientation = orientation_of(words[0] + words[2]);
    if (scanlines && pixels && *scanlines > 0 && *pixels > 0 && header.declared.orientation <= orders) {
      header.height = *scanlines;
      header.width = *pixels;
      return;
    }
  }
  throw damaged(name, fmt::format("`{:.80}` is not the line of its size, such as -Y 512 +X 1024", line));
}

}  // namespace

RadianceHeader read_radiance_header(std::string_view bytes, const std::string& name) {
  RadianceHeader header;
  header.declared.floats = true;
  bool in_size = false;  // the next line is the one of the size
  while (header.size < bytes.size() && header.size < largest_radiance_header) {
    const std::size_t end = bytes.find('\n', header.size);
    if (end == std::string_view::npos) break;
    std::string_view line = bytes.substr(header.size, end - header.size);
    if (line.ends_with('\r')) line.remove_suffix(1);
    header.size = end + 1;
    if (in_size) {
      take_size(line, name, header);
      return header;
    }
    in_size = line.empty();
    take_line(line, name, header.declared);
  }
  throw damaged(name, "is truncated or damaged: its header does not end");
}

std::string plain_radiance_header(const RadianceHeader& header) {
  return fmt::format("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", header.height, header.width);
}

}  // namespace footprint
