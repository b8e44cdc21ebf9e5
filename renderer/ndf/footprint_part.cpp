// Both axes by themselves: the texels that the probes' bilinear lookups weigh at two levels, out to whole texels of the
// coarser one.
#include "renderer/ndf/footprint_part.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <memory>
#include <utility>

#include "renderer/image/mipmap.hpp"
#include "renderer/ndf/filter_probes.hpp"

namespace footprint {
namespace {

constexpr double negligible = 1e-6;  // the weight of a level or a texel that rounding alone brings in

// Texels first to end - 1 of an axis, counted on beyond the map's border.
struct Range {
  int first = 0, end = 0;

  [[nodiscard]] int size() const { return end - first; }
};

// The levels that a lookup blends.
struct Levels {
  int finer = 0, coarser = 0;
};

Levels levels_of(double level, int count) {
  const double inside = std::clamp(level, 0.0, count - 1.0);
  return {static_cast<int>(std::floor(inside + negligible)), static_cast<int>(std::ceil(inside - negligible))};
}

// What probes weigh of one axis, in whole texels of the coarser level.
Range range_of(const ProbeSet& probes, int axis, const Levels& levels) {
  double first = probes.probes.front().centre[axis], end = first;
  for (const Probe& probe : probes.probes) {
    for (int level = levels.finer; level <= levels.coarser; ++level) {
      const double texel = std::ldexp(1.0, level);
      const double at = probe.centre[axis] / texel - 0.5;
      first = std::min(first, texel * std::floor(at + negligible));
      end = std::max(end, texel * (std::ceil(at - negligible) + 1.0));
    }
  }
  const double block = std::ldexp(1.0, levels.coarser);
  return {static_cast<int>(block * std::floor(first / block)), static_cast<int>(block * std::ceil(end / block))};
}

// The texels to cut out of an axis of `size` texels, so that beyond the part's border lies what the wrap mode shows
// beyond the map's; the whole axis where that is not so.
Range cut(const Range& range, int size, Wrap wrap, int block) {
  const Range whole{0, size};
  if (size % block != 0 || range.size() >= size) return whole;
  if (wrap == Wrap::repeat || (range.first >= 0 && range.end <= size)) return range;
  if (range.first < 0 && range.end > size) return whole;
  const bool mirrored = wrap == Wrap::mirrored_repeat;
  if (range.first < 0) {
    const int end = std::max(range.end, mirrored ? -range.first : block);
    return end < size ? Range{0, end} : whole;
  }
  const int first = std::min(range.first, mirrored ? 2 * size - range.end : size - block);
  return first > 0 ? Range{first, size} : whole;
}

int wrapped(int texel, int size) { return ((texel % size) + size) % size; }

Image cut_out(const Image& map, const Range& columns, const Range& rows) {
  Image part(columns.size(), rows.size(), map.channels);
  for (int y = 0; y < part.height; ++y) {
    const int from = wrapped(rows.first + y, map.height);
    for (int x = 0; x < part.width; ++x)
      std::ranges::copy(map.at(wrapped(columns.first + x, map.width), from), part.at(x, y).begin());
  }
  return part;
}

}  // namespace

std::optional<FootprintPart> part_under(const Material& material, const FootprintRect& rect,
                                        const FootprintFilter& filter) {
  if (!material.normal_map || filter.kind == FootprintFilterKind::hardware) return {};
  const MapTexels& map = material.normal_map->image;
  const glm::dvec2 size(map.width(), map.height());
  const ProbeSet probes =
      probes_of(filter, {rect.centre() * size, {rect.size().x * size.x, 0.0}, {0.0, rect.size().y * size.y}});
  const Levels levels = levels_of(probes.level, mip_level_count(map.width(), map.height()));
  const std::array<Wrap, 2>& wrap = material.normal_map->coordinates.wrap;
  const int block = 1 << levels.coarser;
  const Range columns = cut(range_of(probes, 0, levels), map.width(), wrap[0], block);
  const Range rows = cut(range_of(probes, 1, levels), map.height(), wrap[1], block);
  if (2.0 * columns.size() * rows.size() > size.x * size.y) return {};

  const glm::dvec2 scale = size / glm::dvec2(columns.size(), rows.size());
  const glm::dvec2 offset = -glm::dvec2(columns.first, rows.first) / glm::dvec2(columns.size(), rows.size());
  FootprintPart part{material, {scale * rect.lower + offset, scale * rect.upper + offset}};
  TextureMap& cropped = *part.material.normal_map;
  cropped.image = std::make_shared<const Image>(cut_out(map.decoded(), columns, rows));
  glm::mat3x2& transform = cropped.coordinates.transform;
  for (int i = 0; i < 3; ++i) transform[i] = glm::vec2(scale * glm::dvec2(transform[i]));
  transform[2] += glm::vec2(offset);
  return part;
}

}  // namespace footprint
