// The equations of the 2020 paper, section 4. Every kernel is a sum of Gaussians, or of a derivative of one, and is
// taken along rows and columns.
#include "renderer/image/flip.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "renderer/core/error.hpp"
#include "renderer/image/image.hpp"

namespace footprint {
namespace {

using std::numbers::pi;
using Color = std::array<double, 3>;

// XYZ of linear sRGB, by its primaries under D65.
Color xyz_of(const Color& rgb) {
  return {(10135552.0 * rgb[0] + 8788810.0 * rgb[1] + 4435075.0 * rgb[2]) / 24577794.0,
          (2613072.0 * rgb[0] + 8788810.0 * rgb[1] + 887015.0 * rgb[2]) / 12288897.0,
          (1425312.0 * rgb[0] + 8788810.0 * rgb[1] + 70074185.0 * rgb[2]) / 73733382.0};
}

Color rgb_of(const Color& xyz) {
  return {3.241003275 * xyz[0] - 1.537398934 * xyz[1] - 0.498615861 * xyz[2],
          -0.969224334 * xyz[0] + 1.875930071 * xyz[1] + 0.041554224 * xyz[2],
          0.055639423 * xyz[0] - 0.204011202 * xyz[1] + 1.057148933 * xyz[2]};
}

const Color& white() {
  static const Color xyz = xyz_of({1.0, 1.0, 1.0});
  return xyz;
}

// CIELAB without its cube root, the space of contrast sensitivity.
Color opponent_of(const Color& rgb) {
  const Color xyz = xyz_of(rgb);
  const double x = xyz[0] / white()[0], y = xyz[1] / white()[1], z = xyz[2] / white()[2];
  return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

Color rgb_of_opponent(const Color& c) {
  const double y = (c[0] + 16.0) / 116.0;
  return rgb_of({(y + c[1] / 500.0) * white()[0], y * white()[1], (y - c[2] / 200.0) * white()[2]});
}

double lab_curve(double t) {
  constexpr double delta = 6.0 / 29.0;
  return t > delta * delta * delta ? std::cbrt(t) : t / (3.0 * delta * delta) + 4.0 / 29.0;
}

// CIELAB, less colourful where it is dark (Hunt).
Color hunt_lab(const Color& rgb) {
  const Color xyz = xyz_of(rgb);
  const double x = lab_curve(xyz[0] / white()[0]), y = lab_curve(xyz[1] / white()[1]),
               z = lab_curve(xyz[2] / white()[2]);
  const double lightness = 116.0 * y - 16.0;
  return {lightness, 0.01 * lightness * 500.0 * (x - y), 0.01 * lightness * 200.0 * (y - z)};
}

double hyab(const Color& a, const Color& b) { return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]); }

// One value per pixel.
struct Plane {
  int width, height;
  std::vector<double> values;

  Plane(int w, int h) : width(w), height(h), values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

// Weights of -radius to radius.
using Kernel = std::vector<double>;

// Filters along rows, or along columns; the border's values continue beyond it.
Plane filtered(const Plane& plane, const Kernel& kernel, bool along_rows) {
  Plane out(plane.width, plane.height);
  const int radius = static_cast<int>(kernel.size() / 2);
  tbb::parallel_for(0, plane.height, [&](int y) {
    for (int x = 0; x < plane.width; ++x) {
      double sum = 0;
      for (std::size_t i = 0; i < kernel.size(); ++i) {
        const int step = static_cast<int>(i) - radius;
        const int column = along_rows ? std::clamp(x + step, 0, plane.width - 1) : x;
        const int row = along_rows ? y : std::clamp(y + step, 0, plane.height - 1);
        sum += kernel[i] * plane.values[plane.index(column, row)];
      }
      out.values[out.index(x, y)] = sum;
    }
  });
  return out;
}

Plane filtered(const Plane& plane, const Kernel& along_x, const Kernel& along_y) {
  return filtered(filtered(plane, along_x, true), along_y, false);
}

template <typename Weight>
Kernel make_kernel(int radius, Weight weight) {
  Kernel kernel;
  for (int i = -radius; i <= radius; ++i) kernel.push_back(weight(static_cast<double>(i)));
  return kernel;
}

double sum_of(const Kernel& kernel) { return std::accumulate(kernel.begin(), kernel.end(), 0.0); }

// A contrast sensitivity: a sqrt(pi / b) exp(-pi^2 d^2 / b) over degrees d, and a second one of the same form.
struct Sensitivity {
  double a1, b1, a2, b2;
};
constexpr std::array<Sensitivity, 3> sensitivities{
    {{1.0, 0.0047, 0.0, 1e-5}, {1.0, 0.0053, 0.0, 1e-5}, {34.1, 0.04, 13.5, 0.025}}};
constexpr double widest_sensitivity = 0.04;

Plane as_seen(const Plane& plane, const Sensitivity& s, double pixels_per_degree) {
  const int radius =
      static_cast<int>(std::ceil(3.0 * std::sqrt(widest_sensitivity / (2.0 * pi * pi)) * pixels_per_degree));
  const auto gaussian = [&](double b) {
    return make_kernel(
        radius, [&](double i) { return std::exp(-pi * pi * i * i / (b * pixels_per_degree * pixels_per_degree)); });
  };
  const Kernel first = gaussian(s.b1), second = gaussian(s.b2);
  const double one = s.a1 * std::sqrt(pi / s.b1), two = s.a2 * std::sqrt(pi / s.b2);
  const double whole = one * std::pow(sum_of(first), 2) + two * std::pow(sum_of(second), 2);
  Plane out = filtered(plane, first, first);
  for (double& value : out.values) value *= one / whole;
  if (two == 0.0) return out;
  const Plane other = filtered(plane, second, second);
  for (std::size_t i = 0; i < out.values.size(); ++i) out.values[i] += two / whole * other.values[i];
  return out;
}

struct Seen {
  std::vector<Color> color;  // Hunt's, filtered
  Plane edges, points;       // lengths of the gradients
};

// The weights above 0 sum to 1, those below to -1.
Kernel balanced(Kernel kernel) {
  double above = 0, below = 0;
  for (const double weight : kernel) (weight > 0 ? above : below) += std::abs(weight);
  for (double& weight : kernel) weight /= weight > 0 ? above : below;
  return kernel;
}

Plane lengths(const Plane& x, const Plane& y) {
  Plane out(x.width, x.height);
  for (std::size_t i = 0; i < out.values.size(); ++i) out.values[i] = std::hypot(x.values[i], y.values[i]);
  return out;
}

// Edges and points of the achromatic channel, 0 to 1, by the first and second derivative of a Gaussian.
std::array<Plane, 2> features_of(const Plane& grey, double pixels_per_degree) {
  constexpr double feature_width = 0.082;  // degrees, peak to trough
  const double sigma = 0.5 * feature_width * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3.0 * sigma));
  const auto gaussian = [&](double i) { return std::exp(-i * i / (2.0 * sigma * sigma)); };
  Kernel smooth = make_kernel(radius, gaussian);
  const double sum = sum_of(smooth);
  for (double& weight : smooth) weight /= sum;
  const Kernel slope = balanced(make_kernel(radius, [&](double i) { return -i * gaussian(i); }));
  const Kernel bend =
      balanced(make_kernel(radius, [&](double i) { return (i * i / (sigma * sigma) - 1.0) * gaussian(i); }));
  return {lengths(filtered(grey, slope, smooth), filtered(grey, smooth, slope)),
          lengths(filtered(grey, bend, smooth), filtered(grey, smooth, bend))};
}

Seen seen(const std::vector<Color>& rgb, int width, int height, double pixels_per_degree) {
  std::array<Plane, 3> opponent{Plane(width, height), Plane(width, height), Plane(width, height)};
  Plane grey(width, height);
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    const Color c = opponent_of(rgb[i]);
    for (std::size_t k = 0; k < 3; ++k) opponent.at(k).values[i] = c.at(k);
    grey.values[i] = (c[0] + 16.0) / 116.0;
  }
  for (std::size_t k = 0; k < 3; ++k) opponent.at(k) = as_seen(opponent.at(k), sensitivities.at(k), pixels_per_degree);
  auto [edges, points] = features_of(grey, pixels_per_degree);
  Seen out{std::vector<Color>(rgb.size()), std::move(edges), std::move(points)};
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    Color c = rgb_of_opponent({opponent[0].values[i], opponent[1].values[i], opponent[2].values[i]});
    for (double& channel : c) channel = std::clamp(channel, 0.0, 1.0);
    out.color[i] = hunt_lab(c);
  }
  return out;
}

constexpr double color_power = 0.7;

// Compresses large distances: the first 0.4 of the range maps to 0.95 of the scale.
double color_difference(const Color& a, const Color& b) {
  static const double largest = std::pow(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), color_power);
  constexpr double bend = 0.4, at_bend = 0.95;
  const double distance = std::pow(hyab(a, b), color_power);
  const double knee = bend * largest;
  if (distance < knee) return at_bend / knee * distance;
  return std::min(at_bend + (distance - knee) / (largest - knee) * (1.0 - at_bend), 1.0);
}

Image difference(const Seen& picture, const Seen& reference) {
  Image out(picture.edges.width, picture.edges.height, 1);
  for (std::size_t i = 0; i < out.texels.size(); ++i) {
    const double color = color_difference(picture.color[i], reference.color[i]);
    const double feature = std::max(std::abs(picture.edges.values[i] - reference.edges.values[i]),
                                    std::abs(picture.points.values[i] - reference.points.values[i]));
    const double stretched = std::sqrt(feature / std::numbers::sqrt2);
    out.texels[i] = static_cast<float>(std::pow(color, 1.0 - std::min(stretched, 1.0)));
  }
  return out;
}

void require_flippable(const Image& picture, const Image& reference) {
  if (picture.width != reference.width || picture.height != reference.height) {
    throw Error(ErrorKind::usage, "comparison",
                fmt::format("the image is {} x {}, the reference {} x {}", picture.width, picture.height,
                            reference.width, reference.height),
                "compare images of one size");
  }
  for (const Image* const image : {&picture, &reference}) {
    if (image->channels != 3 && image->channels != 4) {
      throw Error(ErrorKind::usage, "comparison", fmt::format("an image has {} channels", image->channels),
                  "compare RGB or RGBA images");
    }
    for (std::size_t i = 0; i < image->texels.size(); ++i) {
      if (std::isfinite(image->texels[i])) continue;
      const std::size_t pixel = i / static_cast<std::size_t>(image->channels);
      throw Error(ErrorKind::usage,
                  fmt::format("comparison, pixel ({}, {})", pixel % static_cast<std::size_t>(image->width),
                              pixel / static_cast<std::size_t>(image->width)),
                  "the value is not a finite number");
    }
  }
}

template <typename Display>
std::vector<Color> displayed(const Image& image, Display display) {
  std::vector<Color> out(image.texel_count());
  for (std::size_t i = 0; i < out.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c)
      out[i].at(c) = std::clamp(display(image.texels[i * static_cast<std::size_t>(image.channels) + c]), 0.0, 1.0);
  }
  return out;
}

template <typename Display>
Image compute_flip(const Image& picture, const Image& reference, double pixels_per_degree, Display display) {
  return difference(seen(displayed(picture, display), picture.width, picture.height, pixels_per_degree),
                    seen(displayed(reference, display), reference.width, reference.height, pixels_per_degree));
}

// Narkowicz's curve (k0 x^2 + k1 x) / (k3 x^2 + k4 x + k5) with the exposure that it was fitted for.
constexpr double k0 = 0.36 * 2.51, k1 = 0.6 * 0.03, k3 = 0.36 * 2.43, k4 = 0.6 * 0.59, k5 = 0.14;

double tone(double x) {
  const double value = std::max(x, 0.0);
  if (value > 1e8) return 1.0;
  return value * (k0 * value + k1) / (value * (k3 * value + k4) + k5);
}

// The argument at which the curve is `t`: the root above 0 of (k0 - t k3) x^2 + (k1 - t k4) x - t k5.
double tone_inverse(double t) {
  const double a = k0 - t * k3, b = k1 - t * k4, c = -t * k5;
  return (-b + std::sqrt(b * b - 4.0 * a * c)) / (2.0 * a);
}

}  // namespace

Image ldr_flip(const Image& picture, const Image& reference, double pixels_per_degree) {
  require_flippable(picture, reference);
  return compute_flip(picture, reference, pixels_per_degree, [](float value) { return static_cast<double>(value); });
}

FlipExposures flip_exposures(const Image& reference) {
  std::vector<double> luminances;
  for (std::size_t i = 0; i < reference.texel_count(); ++i) {
    const float* const rgb = &reference.texels[i * static_cast<std::size_t>(reference.channels)];
    luminances.push_back(std::max(luminance<double>(rgb[0], rgb[1], rgb[2]), 0.0));
  }
  std::ranges::sort(luminances);
  if (luminances.empty() || luminances.back() <= 0.0) return {};
  double median = luminances[luminances.size() / 2];
  if (median <= 0.0) median = *std::ranges::upper_bound(luminances, 0.0);
  const double white_at = tone_inverse(0.85);
  FlipExposures out{.start = std::log2(white_at / luminances.back()), .stop = std::log2(white_at / median)};
  out.count = std::max(2, static_cast<int>(std::ceil(out.stop - out.start)));
  return out;
}

Image hdr_flip(const Image& picture, const Image& reference, const FlipExposures& exposures, double pixels_per_degree) {
  require_flippable(picture, reference);
  Image largest(picture.width, picture.height, 1);
  for (int i = 0; i < exposures.count; ++i) {
    const double stops = std::lerp(exposures.start, exposures.stop, i / (exposures.count - 1.0));
    const double factor = std::exp2(stops);
    const Image one = compute_flip(picture, reference, pixels_per_degree,
                                   [factor](float value) { return tone(factor * static_cast<double>(value)); });
    for (std::size_t k = 0; k < one.texels.size(); ++k) largest.texels[k] = std::max(largest.texels[k], one.texels[k]);
  }
  return largest;
}

}  // namespace footprint
