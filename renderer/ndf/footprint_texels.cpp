// Clips texels to the footprint, sorts and merges facets, and cuts out parts of maps.
#include "renderer/ndf/footprint_texels.hpp"

#include <fmt/format.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <map>
#include <memory>
#include <tuple>
#include <utility>

#include "renderer/bake/facets.hpp"
#include "renderer/bake/material_maps.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/memory.hpp"
#include "renderer/image/mipmap.hpp"
#include "renderer/ndf/filter_probes.hpp"

namespace footprint {
namespace {

constexpr double shortest_normal = 1e-3;  // as in the loader of normal maps

// An interval of one axis within one texel of each map.
struct Stretch {
  int normal = 0, roughness = 0;  // column or row of each map
  double length = 0.0;            // in maps
};

// One axis of a map: texels, wrap mode, and the position of the normal map's coordinates.
struct Axis {
  int size = 1;
  Wrap wrap = Wrap::repeat;
  double scale = 1.0, offset = 0.0;

  [[nodiscard]] double texel_at(double u) const { return (scale * u + offset) * size; }
  [[nodiscard]] int index(double u) const {
    const double texel = std::floor(texel_at(u));
    const double period = texel - size * std::floor(texel / size);
    switch (wrap) {
      case Wrap::repeat:
        return static_cast<int>(period);
      case Wrap::mirrored_repeat: {
        const bool mirrored = std::fmod(std::abs(std::floor(texel / size)), 2.0) == 1.0;
        return mirrored ? size - 1 - static_cast<int>(period) : static_cast<int>(period);
      }
      case Wrap::clamp_to_edge:
        break;
    }
    return static_cast<int>(std::clamp(texel, 0.0, static_cast<double>(size - 1)));
  }
  // The borders of the texels of this map between two coordinates of the normal map.
  void add_borders(double lower, double upper, std::vector<double>& borders) const {
    if (scale == 0.0) return;
    const auto [first, last] = std::minmax({texel_at(lower), texel_at(upper)});
    for (double k = std::ceil(first); k <= last; k += 1.0) borders.push_back((k / size - offset) / scale);
  }
};

std::vector<Stretch> stretches(const Axis& normal, const Axis& roughness, double lower, double upper) {
  std::vector<double> borders{lower, upper};
  normal.add_borders(lower, upper, borders);
  roughness.add_borders(lower, upper, borders);
  std::ranges::sort(borders);
  std::map<std::pair<int, int>, double> lengths;
  for (std::size_t i = 1; i < borders.size(); ++i) {
    const double from = std::max(borders[i - 1], lower);
    const double to = std::min(borders[i], upper);
    if (!(to > from)) continue;
    const double middle = 0.5 * (from + to);
    lengths[{normal.index(middle), roughness.index(middle)}] += to - from;
  }
  std::vector<Stretch> out;
  out.reserve(lengths.size());
  for (const auto& [texels, length] : lengths) out.push_back({texels.first, texels.second, length});
  return out;
}

// Maps coordinates of the normal map to those of the roughness map: scale and offset per axis.
struct Alignment {
  glm::dvec2 scale{0.0}, offset{0.0};
};

glm::dmat3 as_matrix(const glm::mat3x2& transform) {
  return {glm::dvec3(glm::dvec2(transform[0]), 0.0), glm::dvec3(glm::dvec2(transform[1]), 0.0),
          glm::dvec3(glm::dvec2(transform[2]), 1.0)};
}

Alignment alignment(const Material& material) {
  if (width_map(material) == nullptr) return {};
  const TextureCoordinates normal = normal_coordinates(material);
  const TextureCoordinates roughness = roughness_coordinates(material);
  const auto refuse = [&](const std::string& message) {
    return Error(ErrorKind::usage, fmt::format("material {}", material.name), message,
                 "give --lobe, which takes the place of the roughness map");
  };
  if (material.normal_map && normal.set != roughness.set) {
    throw refuse("its normal and roughness maps use different texture coordinates");
  }
  const glm::dmat3 from_normal = material.normal_map ? as_matrix(normal.transform) : as_matrix(roughness.transform);
  const glm::dmat3 relation = as_matrix(roughness.transform) * glm::inverse(from_normal);
  const double turned = std::abs(relation[0][1]) + std::abs(relation[1][0]);
  if (!(turned < 1e-6 * (std::abs(relation[0][0]) + std::abs(relation[1][1])))) {
    throw refuse("its roughness map is turned against its normal map");
  }
  return {{relation[0][0], relation[1][1]}, glm::dvec2(relation[2])};
}

// The facet of a texel of each map; share 0 if the texel has no normal.
// parameters, stretches: of lobes, one per texel of the roughness map.
WeightedFacet facet_of(const Image& normals, const Image& parameters, const Image& stretches, const Stretch& column,
                       const Stretch& row, double area) {
  const auto texel = normals.at(column.normal, row.normal);
  const glm::dvec3 normal(texel[0], texel[1], texel[2]);
  const double length = glm::length(normal);
  const bool valid = texel[3] >= 0.5F && std::isfinite(length) && length >= shortest_normal;
  if (!valid) return {};
  return {normal / length, parameters.at(column.roughness, row.roughness)[0], column.length * row.length / area,
          glm::dvec2(glm::make_vec2(stretches.at(column.roughness, row.roughness).data()))};
}

auto order_of(const WeightedFacet& f) {
  return std::tie(f.parameter, f.stretch.x, f.stretch.y, f.normal.x, f.normal.y, f.normal.z);
}

// Merges equal facets. The sort orders all but equal facets, and their shares are added in order of size, so that the
// sum does not depend on threads.
void unite_equal(std::vector<WeightedFacet>& facets) {
  tbb::parallel_sort(facets.begin(), facets.end(), [](const WeightedFacet& a, const WeightedFacet& b) {
    return std::tuple_cat(order_of(a), std::tie(a.share)) < std::tuple_cat(order_of(b), std::tie(b.share));
  });
  std::size_t last = 0;
  for (std::size_t i = 1; i < facets.size(); ++i) {
    if (order_of(facets[i]) == order_of(facets[last])) {
      facets[last].share += facets[i].share;
    } else {
      facets[++last] = facets[i];
    }
  }
  facets.resize(std::min(last + 1, facets.size()));
}

// Replaces each facet by one per lobe of the material, about the axis of the lobe.
void multiply_by_lobes(const std::vector<FacetLobe>& lobes, std::vector<WeightedFacet>& facets) {
  std::vector<WeightedFacet> out;
  require_memory(frame_bytes(facets.size(), lobes.size(), sizeof(WeightedFacet)),
                 fmt::format("{} facets of {} lobes", facets.size(), lobes.size()), "give a smaller --region");
  out.reserve(facets.size() * lobes.size());
  for (const WeightedFacet& facet : facets) {
    for (const FacetLobe& lobe : lobes) {
      const glm::dvec3 axis = glm::normalize(glm::dvec3(lobe.axis));
      out.push_back({turned_with_normal(axis, facet.normal), lobe.parameter, facet.share * lobe.weight});
    }
  }
  facets = std::move(out);
  unite_equal(facets);
}

constexpr double negligible = 1e-6;  // weights of levels or texels that are rounding errors

// The texels first to end - 1 of an axis; indices continue beyond the border of the map.
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

// The range of probes along one axis, in whole texels of the coarser level.
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

// The texels to cut out of an axis of `size` texels. Beyond the border of the part, the wrap mode must return the same
// texels as in the map; otherwise the whole axis is used.
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

void check_footprint(const FootprintRect& rect, const std::string& place) {
  const auto refuse = [&](const std::string& message, const std::string& hint) {
    throw Error(ErrorKind::usage, place,
                fmt::format("{},{},{},{} {}", rect.lower.x, rect.lower.y, rect.upper.x, rect.upper.y, message), hint);
  };
  for (const double value : {rect.lower.x, rect.lower.y, rect.upper.x, rect.upper.y}) {
    if (!std::isfinite(value)) refuse("is not finite", "give u0,v0,u1,v1, for example 0,0,0.5,0.5");
    if (std::abs(value) > farthest_footprint) {
      refuse(fmt::format("reaches farther than {} maps", farthest_footprint), "the map is the unit square");
    }
  }
  if (rect.upper.x < rect.lower.x || rect.upper.y < rect.lower.y) {
    refuse("is reversed", "give the smaller coordinates first: u0,v0,u1,v1");
  }
  // Narrower than the rounding error of a texel index in the largest map.
  constexpr double narrowest = 1e-9;
  if (rect.size().x < narrowest || rect.size().y < narrowest) refuse("is empty", "give u0 < u1 and v0 < v1");
}

FootprintTexels texels_under(const Material& material, const FootprintRect& rect) {
  const Image normals = normal_map_of(material), parameters = lobe_parameter_map_of(material);
  const Image lobe_stretches =
      material.anisotropy ? stretch_map_of(material) : Image(parameters.width, parameters.height, 2, 0.0F);
  const Alignment aligned = alignment(material);
  const std::array<Wrap, 2> normal_wrap = normal_coordinates(material).wrap;
  const std::array<Wrap, 2> roughness_wrap = roughness_coordinates(material).wrap;
  const auto axis = [&](int i) {
    const int size = i == 0 ? normals.width : normals.height;
    const int rough = i == 0 ? parameters.width : parameters.height;
    const auto k = static_cast<std::size_t>(i);
    return stretches({size, normal_wrap[k], 1.0, 0.0}, {rough, roughness_wrap[k], aligned.scale[i], aligned.offset[i]},
                     rect.lower[i], rect.upper[i]);
  };
  const std::vector<Stretch> columns = axis(0);
  const std::vector<Stretch> rows = axis(1);
  require_memory(frame_bytes(columns.size(), rows.size(), sizeof(WeightedFacet)),
                 fmt::format("a footprint of {} x {} texels", columns.size(), rows.size()),
                 "give a smaller --region, or free memory");
  const double area = rect.size().x * rect.size().y;
  FootprintTexels out{area * static_cast<double>(normals.texel_count()), 0.0, {}};
  out.facets.reserve(columns.size() * rows.size());
  for (const Stretch& row : rows) {
    for (const Stretch& column : columns) {
      const WeightedFacet facet = facet_of(normals, parameters, lobe_stretches, column, row, area);
      if (facet.share > 0.0) out.facets.push_back(facet);
    }
  }
  unite_equal(out.facets);
  for (const WeightedFacet& facet : out.facets) out.valid_share += facet.share;
  if (out.facets.empty()) {
    throw Error(ErrorKind::usage, fmt::format("material {}", material.name), "no texel of the footprint has a normal",
                "give a --region where the map has some");
  }
  for (WeightedFacet& facet : out.facets) facet.share /= out.valid_share;
  if (!material.lobes.empty()) multiply_by_lobes(material.lobes, out.facets);
  return out;
}

MappedFootprint roughness_footprint(const Material& material, const FootprintRect& rect) {
  if (width_map(material) == nullptr) return {rect.centre(), {rect.size().x, 0.0}, {0.0, rect.size().y}};
  const Alignment aligned = alignment(material);
  const glm::dvec2 size = aligned.scale * rect.size();
  return {aligned.scale * rect.centre() + aligned.offset, {size.x, 0.0}, {0.0, size.y}};
}

std::vector<WeightedFacet> merged_facets(const std::vector<WeightedFacet>& facets, double spacing) {
  using Cell = std::array<std::int64_t, 5>;
  const auto cell_of = [&](const WeightedFacet& f) {
    constexpr double buckets_an_octave = 16.0, stretches_of_a_unit = 64.0;
    // Lambert's disc stretches distances by at most 2.
    const glm::dvec2 on_disc = glm::dvec2(f.normal) / std::sqrt(std::max(1.0 + f.normal.z, 1e-6));
    const glm::dvec2 cell = glm::floor(on_disc * (2.0 / spacing));
    const glm::dvec2 stretch = glm::floor(f.stretch * stretches_of_a_unit);
    const auto whole = [](double value) { return static_cast<std::int64_t>(value); };
    return Cell{whole(std::floor(buckets_an_octave * std::log2(f.parameter))), whole(cell.x), whole(cell.y),
                whole(stretch.x), whole(stretch.y)};
  };
  std::vector<std::pair<Cell, std::size_t>> order(facets.size());
  for (std::size_t i = 0; i < facets.size(); ++i) order[i] = {cell_of(facets[i]), i};
  tbb::parallel_sort(order.begin(), order.end());
  std::vector<WeightedFacet> out;
  for (std::size_t i = 0; i < order.size();) {
    WeightedFacet sum{.normal = glm::dvec3(0.0)};
    for (const Cell cell = order[i].first; i < order.size() && order[i].first == cell; ++i) {
      const WeightedFacet& facet = facets[order[i].second];
      sum.normal += facet.share * facet.normal;
      sum.parameter += facet.share * facet.parameter;
      sum.stretch += facet.share * facet.stretch;
      sum.share += facet.share;
    }
    out.push_back({sum.normal / sum.share, sum.parameter / sum.share, sum.share, sum.stretch / sum.share});
  }
  return out;
}

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
