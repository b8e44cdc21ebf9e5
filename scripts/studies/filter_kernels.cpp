// footprint_filter_kernels FILE.png: draws the kernels of the footprint filters over an even, a sheared and a grazing
// footprint in one image, and prints the table of docs/reference/filters.md.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "renderer/core/error.hpp"
#include "renderer/image/image_io.hpp"
#include "tests/support/filter_kernel.hpp"

namespace footprint {
namespace {

using testing::box_kernel, testing::filter_kernel, testing::kernel_moments, testing::KernelMoments;

constexpr int edge = 64;    // texels of the map that a kernel is drawn on
constexpr int phases = 64;  // places of a footprint that figures are means over
constexpr std::array<const char*, 12> filters{"trilinear", "anisotropic:8", "anisotropic:16", "box:2",
                                              "box:3",     "box:4",         "box:8",          "area:2",
                                              "area:3",    "area:4",        "ewa:8",          "ewa:16"};

struct Case {
  const char* name;
  glm::dvec2 dx, dy;  // texels
};
constexpr std::array<Case, 3> cases{
    {{"even", {13.0, 0.0}, {0.0, 13.0}}, {"sheared", {17.0, 5.0}, {9.0, 12.0}}, {"grazing", {29.0, 8.0}, {-1.2, 4.0}}}};

// Places that no filter's grid prefers: a golden-ratio sequence about the middle of the map.
glm::dvec2 place(int i) { return 0.5 * edge + 4.0 * glm::fract(glm::dvec2(0.7548776662, 0.5698402910) * (i + 1.0)); }

struct Figures {
  double along = 0.0, across = 0.0;  // deviations over the box's own
  double apart = 0.0;                // half of the sum of absolute differences to the box
};

Figures figures_of(const FootprintFilter& filter, const Case& footprint, const std::vector<Image>& boxes) {
  Figures out;
  for (int i = 0; i < phases; ++i) {
    const TexelFootprint at{place(i), footprint.dx, footprint.dy};
    const Image kernel = filter_kernel(filter, at, edge);
    const Image& box = boxes[static_cast<std::size_t>(i)];
    const KernelMoments own = kernel_moments(kernel, at), of_box = kernel_moments(box, at);
    out.along += own.along / of_box.along / phases;
    out.across += own.across / of_box.across / phases;
    for (std::size_t k = 0; k < kernel.texels.size(); ++k)
      out.apart += 0.5 * std::abs(kernel.texels[k] - box.texels[k]) / phases;
  }
  return out;
}

// One kernel on a grey scale whose white is the box's own height, twice over.
void paint(Image& picture, int column, int row, const Image& kernel, double height) {
  for (int y = 0; y < edge; ++y) {
    for (int x = 0; x < edge; ++x) {
      const double value = kernel.at(x, y)[0] / (2.0 * height);
      const auto shade = static_cast<float>(std::clamp(value, 0.0, 1.0));
      std::ranges::fill(picture.at(column * (edge + 2) + x, row * (edge + 2) + y), shade);
    }
  }
}

void run(const std::string& file) {
  Image picture((static_cast<int>(filters.size()) + 1) * (edge + 2), static_cast<int>(cases.size()) * (edge + 2), 3,
                0.25F);
  std::string table = "| filter | lookups |", rule = "\n|---|---:|";
  std::vector<std::vector<Image>> boxes(cases.size());
  std::vector<double> heights;
  for (std::size_t c = 0; c < cases.size(); ++c) {
    table += fmt::format(" {}: along | across | apart |", cases[c].name);
    rule += "---:|---:|---:|";
    for (int i = 0; i < phases; ++i) boxes[c].push_back(box_kernel({place(i), cases[c].dx, cases[c].dy}, edge));
    heights.push_back(std::ranges::max(boxes[c][0].texels));
    paint(picture, 0, static_cast<int>(c), boxes[c][0], heights[c]);
  }
  table += rule;
  for (std::size_t f = 0; f < filters.size(); ++f) {
    const FootprintFilter filter = parse_footprint_filter(filters[f], "");
    std::size_t most = 0;
    std::string row;
    for (std::size_t c = 0; c < cases.size(); ++c) {
      const TexelFootprint at{place(0), cases[c].dx, cases[c].dy};
      most = std::max(most, probes_of(filter, at).probes.size());
      const Figures figures = figures_of(filter, cases[c], boxes[c]);
      row += fmt::format(" {:.2f} | {:.2f} | {:.2f} |", figures.along, figures.across, figures.apart);
      paint(picture, static_cast<int>(f) + 1, static_cast<int>(c), filter_kernel(filter, at, edge), heights[c]);
    }
    table += fmt::format("\n| `{}` | {} |{}", filters[f], most, row);
  }
  write_png(file, picture);
  fmt::print("{}\n", table);
}

}  // namespace
}  // namespace footprint

int main(int count, char** arguments) {
  try {
    if (count != 2) {
      fmt::print(stderr, "footprint_filter_kernels: give one file for the picture, as kernels.png\n");
      return static_cast<int>(footprint::ErrorKind::usage);
    }
    footprint::run(arguments[1]);
    return 0;
  } catch (const footprint::Error& error) {
    fmt::print(stderr, "footprint_filter_kernels: {}\n", error.what());
    return static_cast<int>(error.kind());
  }
}
