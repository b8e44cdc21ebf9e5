// Unfolds and fills the normal map, and differentiates it on the disc.
#include "methods/yan_gaussians/elements.hpp"

#include <algorithm>
#include <cmath>

#include "renderer/bake/material_maps.hpp"
#include "renderer/image/mipmap.hpp"

namespace footprint {
namespace {

// The texel of the mean of valid normals of the finest level that has one over (x, y) of the finest map.
std::span<const float> valid_mean(const std::vector<Image>& chain, int x, int y) {
  const Image& finest = chain.front();
  for (const Image& level : chain) {
    const auto texel = level.at(static_cast<int>(static_cast<std::int64_t>(x) * level.width / finest.width),
                                static_cast<int>(static_cast<std::int64_t>(y) * level.height / finest.height));
    const float size = std::hypot(texel[0], texel[1], texel[2]);
    if (texel[3] > 0.0F && size > 1e-3F) return texel;
  }
  return {};
}

// Every normal of unit length and weight 1.
Image filled(const Image& normals) {
  std::vector<Image> chain{normals};
  const bool holes = [&] {
    for (std::size_t i = 3; i < normals.texels.size(); i += 4) {
      if (normals.texels[i] <= 0.0F) return true;
    }
    return false;
  }();
  if (holes) chain = weighted_mip_chain(normals);
  Image out(normals.width, normals.height, 4, 1.0F);
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      const auto mean = valid_mean(chain, x, y);
      const glm::vec3 normal = mean.empty() ? glm::vec3(0, 0, 1) : glm::normalize(glm::vec3(mean[0], mean[1], mean[2]));
      std::copy_n(&normal.x, 3, out.at(x, y).begin());
    }
  }
  return out;
}

// A map that goes on as its own mirror image along each axis that does not repeat.
Image unfolded(const Image& map, const std::array<Wrap, 2>& wrap) {
  const bool along_u = wrap[0] != Wrap::repeat, along_v = wrap[1] != Wrap::repeat;
  Image out(map.width * (along_u ? 2 : 1), map.height * (along_v ? 2 : 1), map.channels);
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      const int from_x = x < map.width ? x : 2 * map.width - 1 - x,
                from_y = y < map.height ? y : 2 * map.height - 1 - y;
      std::ranges::copy(map.at(from_x, from_y), out.at(x, y).begin());
    }
  }
  return out;
}

NormalJacobian jacobian_at(const Image& normals, int x, int y) {
  const auto left = normals.at((x + normals.width - 1) % normals.width, y);
  const auto right = normals.at((x + 1) % normals.width, y);
  const auto before = normals.at(x, (y + normals.height - 1) % normals.height);
  const auto behind = normals.at(x, (y + 1) % normals.height);
  return {0.5F * (right[0] - left[0]), 0.5F * (behind[0] - before[0]), 0.5F * (right[1] - left[1]),
          0.5F * (behind[1] - before[1])};
}

}  // namespace

Elements make_elements(const Material& material, bool jacobians) {
  Elements elements{.normals = unfolded(filled(normal_map_of(material)), normal_coordinates(material).wrap),
                    .jacobians = {}};
  if (!jacobians) return elements;
  elements.jacobians.reserve(elements.normals.texel_count());
  for (int y = 0; y < elements.normals.height; ++y) {
    for (int x = 0; x < elements.normals.width; ++x) elements.jacobians.push_back(jacobian_at(elements.normals, x, y));
  }
  return elements;
}

float normal_reach(const Elements& elements, std::size_t texel) {
  if (elements.jacobians.empty()) return 0.0F;
  const auto [x_by_u, x_by_v, y_by_u, y_by_v] = elements.jacobians[texel];
  const glm::dvec2 disc(elements.normals.texels[4 * texel], elements.normals.texels[4 * texel + 1]);
  const auto height = [](const glm::dvec2& at) { return std::sqrt(std::max(1.0 - glm::dot(at, at), 0.0)); };
  double squares = 0.0;
  for (const glm::dvec2 slope : {glm::dvec2(x_by_u, y_by_u), glm::dvec2(x_by_v, y_by_v)}) {
    const double rise = 0.5 * (height(disc + slope) - height(disc - slope));
    squares += glm::dot(slope, slope) + rise * rise;
  }
  return static_cast<float>(seed_deviation * std::sqrt(squares));
}

}  // namespace footprint
