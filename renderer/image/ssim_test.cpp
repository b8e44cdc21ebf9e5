// Structural similarity against sums over whole windows in another language: numpy, with weights normalised per window
// and variances as weighted means of squared deviations.
#include "renderer/image/ssim.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "renderer/image/metrics.hpp"

namespace footprint {
namespace {

Image filled(int width, int height, const std::function<double(int x, int y)>& value) {
  Image image(width, height, 1);
  for_each_texel(image, [&](int x, int y) { image.at(x, y)[0] = static_cast<float>(value(x, y)); });
  return image;
}

double wave(int x, int y) { return 0.5 + 0.4 * std::sin(0.7 * x + 0.3 * y); }
double other_wave(int x, int y) {
  return 0.5 + 0.3 * std::sin(0.7 * x + 0.45 * y + 0.2) + 0.05 * std::cos(1.9 * x - 0.8 * y);
}
double one(int /*x*/, int /*y*/) { return 1; }

double ssim_of_waves(int width, int height, const std::function<double(int x, int y)>& mask) {
  return mean_ssim(filled(width, height, other_wave), filled(width, height, wave), filled(width, height, mask)).value();
}

// With a whole mask these are the windows of Wang's own program, which takes those that lie within the image.
TEST(Ssim, IsThatOfSumsOverWholeWindows) {
  EXPECT_NEAR(ssim_of_waves(16, 13, one), 0.42815722948513907, 1e-10);
  EXPECT_NEAR(ssim_of_waves(11, 11, one), 0.526856050227735, 1e-10);
}

TEST(Ssim, WindowsLeaveOutWhatIsNotInTheMask) {
  const auto mask = [](int x, int y) { return (x + 2 * y) % 5 != 0 ? 1.0 : 0.0; };
  EXPECT_NEAR(ssim_of_waves(24, 19, mask), 0.024585528396803474, 1e-10);
  Image picture = filled(24, 19, other_wave);
  const Image reference = filled(24, 19, wave), masked = filled(24, 19, mask);
  for_each_texel(picture, [&](int x, int y) {
    if (masked.at(x, y)[0] <= 0.0F) picture.at(x, y)[0] = 100;
  });
  EXPECT_NEAR(mean_ssim(picture, reference, masked).value(), 0.024585528396803474, 1e-10);
}

TEST(Ssim, EqualImagesHaveOneAndSmallOnesNone) {
  EXPECT_NEAR(mean_ssim(filled(12, 12, wave), filled(12, 12, wave), filled(12, 12, one)).value(), 1, 1e-12);
  EXPECT_FALSE(mean_ssim(filled(10, 40, wave), filled(10, 40, wave), filled(10, 40, one)));
  EXPECT_FALSE(mean_ssim(filled(12, 12, wave), filled(12, 12, wave), Image(12, 12, 1)));
}

// Constants a and b: only the luminance differs, (2 a b + c) / (a^2 + b^2 + c).
TEST(Ssim, OfConstantsIsInClosedForm) {
  const Image a = filled(12, 12, [](int, int) { return 0.25; }), b = filled(12, 12, [](int, int) { return 0.75; });
  EXPECT_NEAR(mean_ssim(a, b, filled(12, 12, one)).value(), (0.375 + 1e-4) / (0.625 + 1e-4), 1e-9);
}

/// Grey RGBA of such values; alpha 1 where `covered`.
Image grey(const Image& values, const std::function<bool(int x, int y)>& covered) {
  Image image(values.width, values.height, 4);
  for_each_texel(image, [&](int x, int y) {
    for (std::size_t c = 0; c < 3; ++c) image.at(x, y)[c] = values.at(x, y)[0];
    image.at(x, y)[3] = covered(x, y) ? 1.0F : 0.0F;
  });
  return image;
}

// Displayed luminances of object pixels: half the radiance at twice the exposure, and a corner that is not covered.
TEST(Ssim, OfImagesIsOverDisplayedLuminances) {
  Image picture = filled(24, 19, other_wave), reference = filled(24, 19, wave);
  const auto covered = [](int x, int y) { return (x + 2 * y) % 5 != 0; };
  for (Image* image : {&picture, &reference}) {
    for (float& value : image->texels) value *= 0.5F;
  }
  const ErrorFigures figures = compare_images(grey(picture, covered), grey(reference, covered), 2.0F).value();
  EXPECT_NEAR(figures.ssim.value(), 0.024585528396803474, 1e-6);
}

}  // namespace
}  // namespace footprint
