// The colour scale as a table, and text drawn by OpenImageIO into the image's own memory.
#include "renderer/image/false_color.hpp"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <system_error>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

using MapColor = std::array<float, 3>;

// Display values at equal steps, black through violet and orange to pale yellow: lightness rises all the way, so that
// the order survives a grey print and colour blindness (after "inferno" by Smith and van der Walt, 2015).
constexpr std::array<MapColor, 9> anchors{{{0.001F, 0.000F, 0.014F},
                                           {0.122F, 0.047F, 0.283F},
                                           {0.333F, 0.059F, 0.427F},
                                           {0.533F, 0.134F, 0.415F},
                                           {0.729F, 0.212F, 0.333F},
                                           {0.890F, 0.349F, 0.200F},
                                           {0.976F, 0.549F, 0.039F},
                                           {0.976F, 0.788F, 0.196F},
                                           {0.988F, 1.000F, 0.643F}}};

// NaN is shown as the maximum, so that it is visible.
MapColor color_at(float value, float maximum) {
  const float share = maximum > 0 ? value / maximum : 0.0F;
  const float position = (share < 1 ? std::max(share, 0.0F) : 1.0F) * static_cast<float>(anchors.size() - 1);
  const std::size_t lower = std::min(static_cast<std::size_t>(position), anchors.size() - 2);
  const float t = position - static_cast<float>(lower);
  MapColor color;
  for (std::size_t c = 0; c < color.size(); ++c) color[c] = std::lerp(anchors[lower][c], anchors[lower + 1][c], t);
  return color;
}

// The image over black as RGB, drawn with its top left corner in column `left` of row 0.
void place_picture(Image& canvas, const Image& picture, int left) {
  for_each_texel(picture, [&](int x, int y) {
    const std::span<const float> from = picture.at(x, y);
    const std::span<float> to = canvas.at(left + x, y);
    for (std::size_t c = 0; c < 3; ++c) to[c] = from[from.size() == 1 ? 0 : c] * (from.size() == 4 ? from[3] : 1.0F);
  });
}

void require_strip(const std::vector<Image>& pictures, const std::vector<std::string>& captions) {
  const auto refuse = [](const std::string& message) {
    throw Error(ErrorKind::usage, "labelled strip", message, "give images of one height and a caption for each");
  };
  if (pictures.empty() || pictures.size() != captions.size()) {
    refuse(fmt::format("{} images, {} captions", pictures.size(), captions.size()));
  }
  for (const Image& picture : pictures) {
    const bool taken = picture.channels == 1 || picture.channels == 3 || picture.channels == 4;
    if (picture.empty() || !taken || picture.height != pictures.front().height) {
      refuse(fmt::format("an image of {} x {} x {} channels", picture.width, picture.height, picture.channels));
    }
  }
}

using namespace OIIO::ImageBufAlgo;

// Where Debian, Fedora and Arch install it.
constexpr std::array<const char*, 3> font_folders{"/usr/share/fonts/truetype/dejavu",
                                                  "/usr/share/fonts/dejavu-sans-fonts", "/usr/share/fonts/TTF"};

std::string variable(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

bool is_file(const std::string& path) {
  std::error_code unknown;
  return std::filesystem::is_regular_file(path, unknown);
}

}  // namespace

Image false_color(const Image& scalar, float maximum) {
  if (scalar.channels != 1) {
    throw Error(ErrorKind::usage, "false colour", fmt::format("the image has {} channels", scalar.channels),
                "give one channel");
  }
  return mapped(scalar, 3,
                [=](const auto& in, const auto& out) { std::ranges::copy(color_at(in[0], maximum), out.begin()); });
}

Image false_color_legend(int width, int height, float maximum) {
  constexpr int smallest_font = 8;
  const int font_size = std::max(smallest_font, height / 2 - 2);
  const int bar_height = std::max(1, height - font_size - 4);
  Image legend(width, height, 3);
  for (int x = 0; x < width; ++x) {
    const MapColor color = color_at(static_cast<float>(x), static_cast<float>(std::max(width - 1, 1)));
    for (int y = 0; y < std::min(bar_height, height); ++y) std::ranges::copy(color, legend.at(x, y).begin());
  }
  const std::string top = fmt::format("{:.3g}", maximum);
  const int text_row = (bar_height + height) / 2;
  draw_text(legend, text_width("0", font_size) / 2 + 2, text_row, "0", font_size);
  draw_text(legend, width - text_width(top, font_size) / 2 - 2, text_row, top, font_size);
  return legend;
}

Image labelled_strip(const std::vector<Image>& pictures, const std::vector<std::string>& captions) {
  require_strip(pictures, captions);
  const int height = pictures.front().height;
  const int font_size = std::clamp(height / 16, 11, 28);
  const int gap = font_size / 2;
  std::vector<int> column_widths;  // a caption that is wider than its image widens the column
  int width = 0;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    column_widths.push_back(std::max(pictures[i].width, text_width(captions[i], font_size)));
    width += column_widths.back() + (i > 0 ? gap : 0);
  }
  Image strip(width, height + 2 * font_size, 3);
  int left = 0;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    place_picture(strip, pictures[i], left + (column_widths[i] - pictures[i].width) / 2);
    draw_text(strip, left + column_widths[i] / 2, height + font_size, captions[i], font_size);
    left += column_widths[i] + gap;
  }
  return strip;
}

std::string find_caption_font() {
  if (const std::string given = variable("FOOTPRINT_FONT"); !given.empty()) return is_file(given) ? given : "";
  std::vector<std::string> folders(font_folders.begin(), font_folders.end());
  std::istringstream listed(variable("OPENIMAGEIO_FONTS"));
  for (std::string folder; std::getline(listed, folder, ':');) folders.insert(folders.begin(), folder);
  for (const std::string& folder : folders) {
    if (std::string file = folder + "/DejaVuSans.ttf"; is_file(file)) return file;
  }
  return {};
}

int text_width(const std::string& text, int size) {
  const std::string font = text.empty() ? "" : find_caption_font();
  return font.empty() ? 0 : std::max(0, text_size(text, size, font).width());
}

void draw_text(Image& picture, int x, int y, const std::string& text, int size) {
  const std::string font = text.empty() ? "" : find_caption_font();
  if (font.empty()) return;
  const OIIO::ImageSpec spec(picture.width, picture.height, picture.channels, OIIO::TypeDesc::FLOAT);
  OIIO::ImageBuf canvas(spec, picture.texels.data());  // draws into the image's own memory
  render_text(canvas, x, y, text, size, font, 1.0F, TextAlignX::Center, TextAlignY::Center);
}

}  // namespace footprint
