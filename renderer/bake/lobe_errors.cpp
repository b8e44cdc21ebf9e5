// In slope space the GGX density of half vectors is 1 / (pi alpha^2 (1 + |d|^2 / alpha^2)^2), d from the texel's slope.
// A covariance C widens alpha^2 I to alpha^2 I + 2 C, as for Beckmann, where it is exact (Olano and Baker 2010).
#include "renderer/bake/lobe_errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <random>
#include <vector>

#include "renderer/bake/slope_moments.hpp"
#include "renderer/core/error.hpp"

namespace footprint {
namespace {

// Blocks of a level: fewer of large ones, for about as many texels.
int block_count(int level) { return std::clamp(level < 10 ? (1 << 20) >> (2 * level) : 1, 1, 1024); }

constexpr double half_vector_slopes[][2] = {{0.1255, 0.0992}, {-0.2807, 0.3898}};  // of the scenes' two lights

struct Texel {
  glm::dvec2 slope{0.0};
  double alpha = 1;
};

double ggx(const glm::dvec2& d, const glm::dmat2& alpha_squared) {
  const double q = glm::dot(d, glm::inverse(alpha_squared) * d);
  return 1.0 / (std::numbers::pi * std::sqrt(glm::determinant(alpha_squared)) * (1.0 + q) * (1.0 + q));
}

class Sampler {
 public:
  Sampler(const Image& normals, const Image& alphas) : normals_(normals), alphas_(alphas) {}

  [[nodiscard]] Texel at(int x, int y) const {
    const auto normal = normals_.at(x, y);
    const bool is_flat = normal[3] <= 0.0F;
    return {.slope = is_flat ? glm::dvec2(0.0) : slope_of(glm::dvec3(normal[0], normal[1], normal[2])),
            .alpha = alphas_.texel_count() == 1 ? alphas_.at(0, 0)[0] : alphas_.at(x, y)[0]};
  }

  // The texels of a random block; the one in its middle comes first.
  std::vector<Texel> block(int level) {
    const int width = std::min(1 << level, normals_.width), height = std::min(1 << level, normals_.height);
    const int x = start(normals_.width - width), y = start(normals_.height - height);
    std::vector<Texel> texels{at(x + width / 2, y + height / 2)};
    for (int j = 0; j < height; ++j) {
      for (int i = 0; i < width; ++i) {
        if (i != width / 2 || j != height / 2) texels.push_back(at(x + i, y + j));
      }
    }
    return texels;
  }

 private:
  int start(int most) { return static_cast<int>(random_() % (static_cast<unsigned>(most) + 1U)); }

  const Image& normals_;
  const Image& alphas_;
  std::mt19937 random_{1};
};

// The sums of a map: squared errors by lobe, and exact values.
struct Sums {
  LobeErrors squares{};
  double exact = 0;
};

void add_block(const std::vector<Texel>& texels, Sums& sums) {
  const auto count = static_cast<double>(texels.size());
  Texel mean{.slope = glm::dvec2(0.0), .alpha = 0};
  for (const Texel& texel : texels) {
    mean.slope += texel.slope / count;
    mean.alpha += texel.alpha / count;
  }
  glm::dmat2 spread(0.0);
  for (const Texel& texel : texels)
    spread += glm::outerProduct(texel.slope - mean.slope, texel.slope - mean.slope) / count;
  const glm::dmat2 base(mean.alpha * mean.alpha);
  const glm::dmat2 shapes[] = {base, base + glm::dmat2(spread[0][0] + spread[1][1]), base + 2.0 * spread};
  for (const auto& slopes : half_vector_slopes) {
    const glm::dvec2 half(slopes[0], slopes[1]);
    const auto of_texel = [&](const Texel& t) { return ggx(half - t.slope, glm::dmat2(t.alpha * t.alpha)); };
    double exact = 0;
    for (const Texel& texel : texels) exact += of_texel(texel) / count;
    LobeErrors values{of_texel(texels.front())};
    for (std::size_t i = 0; i < std::size(shapes); ++i) values.at(i + 1) = ggx(half - mean.slope, shapes[i]);
    for (std::size_t i = 0; i < values.size(); ++i) sums.squares.at(i) += std::pow(values.at(i) - exact, 2);
    sums.exact += exact;
  }
}

}  // namespace

LobeErrors lobe_errors(const Image& normals, const Image& alphas, int level) {
  const bool fits = alphas.width == normals.width && alphas.height == normals.height;
  if (alphas.texel_count() != 1 && !fits)
    throw Error(
        ErrorKind::usage, {},
        fmt::format("is {}x{}, the normal map {}x{}", alphas.width, alphas.height, normals.width, normals.height),
        "resample one of them");
  Sampler sampler(normals, alphas);
  Sums sums;
  const int blocks = block_count(level);
  for (int i = 0; i < blocks; ++i) add_block(sampler.block(level), sums);
  const auto samples = static_cast<double>(blocks) * static_cast<double>(std::size(half_vector_slopes));
  LobeErrors errors{};
  for (std::size_t i = 0; i < errors.size(); ++i)
    errors.at(i) = std::sqrt(sums.squares.at(i) / samples) / (sums.exact / samples);
  return errors;
}

double mean_of(const Image& map) {
  double sum = 0;
  for (std::size_t i = 0; i < map.texel_count(); ++i) sum += map.texels[i * static_cast<std::size_t>(map.channels)];
  return sum / static_cast<double>(map.texel_count());
}

}  // namespace footprint
