// Finds the highest triangle over each texel of a patch.
#include "renderer/microgeometry/microgeometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace footprint {
namespace {

constexpr std::uint32_t nothing = std::numeric_limits<std::uint32_t>::max();

// The highest triangle over the centre of each texel.
class TopView {
 public:
  TopView(const Patch& patch, int size)
      : patch_(patch),
        size_(size),
        heights_(static_cast<std::size_t>(size) * static_cast<std::size_t>(size),
                 -std::numeric_limits<double>::infinity()),
        triangles_(heights_.size(), nothing) {}

  void draw(std::size_t triangle) {
    const glm::dvec3 normal = facet_plane(patch_, triangle).normal;
    if (!(normal.z > 0.0)) return;
    std::array<glm::dvec3, 3> corners{};
    const glm::dvec2 scale = static_cast<double>(size_) / glm::dvec2(patch_.period);
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 v(patch_.vertices[patch_.triangles[triangle][i]]);
      corners.at(static_cast<std::size_t>(i)) = glm::dvec3(glm::dvec2(v) * scale - 0.5, v.z);  // centres are whole
    }
    const glm::ivec2 low(glm::ceil(glm::dvec2(glm::min(glm::min(corners[0], corners[1]), corners[2]))));
    const glm::ivec2 high(glm::floor(glm::dvec2(glm::max(glm::max(corners[0], corners[1]), corners[2]))));
    const glm::dvec2 slope = -glm::dvec2(normal) / normal.z / scale;
    for (int y = low.y; y <= high.y; ++y) {
      for (int x = low.x; x <= high.x; ++x) {
        const glm::dvec2 p(x, y);
        if (!inside(corners, p)) continue;
        const double height = corners[0].z + glm::dot(slope, p - glm::dvec2(corners[0]));
        const std::size_t texel = index(x, y);
        if (height <= heights_[texel]) continue;
        heights_[texel] = height;
        triangles_[texel] = static_cast<std::uint32_t>(triangle);
      }
    }
  }

  [[nodiscard]] const std::vector<std::uint32_t>& triangles() const { return triangles_; }

 private:
  static bool inside(const std::array<glm::dvec3, 3>& corners, const glm::dvec2& p) {
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec2 a(corners.at(i)), b(corners.at((i + 1) % 3));
      if ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) < 0.0) return false;
    }
    return true;
  }

  // Row 0 of a map is its top, where y is largest.
  [[nodiscard]] std::size_t index(int x, int y) const {
    const auto wrapped = [this](int i) { return static_cast<std::size_t>((i % size_ + size_) % size_); };
    return wrapped(-1 - y) * static_cast<std::size_t>(size_) + wrapped(x);
  }

  const Patch& patch_;
  int size_;
  std::vector<double> heights_;
  std::vector<std::uint32_t> triangles_;
};

}  // namespace

bool needs_colors(const Microgeometry& microgeometry) {
  return has_colors(microgeometry.patch) ||
         (microgeometry.brdf && facet_color(microgeometry.patch, 0) != glm::vec3(1.0F));
}

PatchMaps patch_maps(const Patch& patch, int size) {
  TopView view(patch, size);
  for (std::size_t t = 0; t < patch.triangles.size(); ++t) view.draw(t);
  PatchMaps out{.normals = Image(size, size, 4), .mean_color = glm::vec3(0.0F)};
  glm::dvec3 sum(0.0);
  std::size_t count = 0;
  for (std::size_t i = 0; i < view.triangles().size(); ++i) {
    const std::uint32_t triangle = view.triangles()[i];
    const glm::vec4 texel = triangle == nothing ? glm::vec4(0.0F, 0.0F, 1.0F, 0.0F)
                                                : glm::vec4(glm::vec3(facet_plane(patch, triangle).normal), 1.0F);
    std::copy_n(&texel.x, 4, out.normals.texels.begin() + static_cast<std::ptrdiff_t>(4 * i));
    if (triangle == nothing) continue;
    sum += glm::dvec3(facet_color(patch, triangle));
    ++count;
  }
  if (count > 0) out.mean_color = glm::vec3(sum / static_cast<double>(count));
  return out;
}

}  // namespace footprint
