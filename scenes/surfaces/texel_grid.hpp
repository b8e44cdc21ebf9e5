// Maps that are filled texel by texel, in parallel, each texel a pure function of its uv; and grids of values that
// tile.
#pragma once

#include <cstddef>
#include <functional>
#include <glm/glm.hpp>
#include <random>
#include <vector>

#include "renderer/image/image.hpp"
#include "renderer/scene/surface.hpp"

namespace footprint {

/// A unit normal, a linear colour of 0 to 1 or a number in x, at a point of the map: u to the right, v upwards, both
/// within (0, 1).
using ValueAt = std::function<glm::dvec3(const glm::dvec2& uv)>;

/// The values at the texels' centres, with 1 in a fourth channel. The function is called from several threads at once.
[[nodiscard]] Image fill_map(glm::ivec2 size, int channels, const ValueAt& value_at);

/// A map of normals.
[[nodiscard]] inline Image fill_normals(int resolution, const ValueAt& normal_at) {
  return fill_map(glm::ivec2{resolution}, 4, normal_at);
}

/// Normals without relief, (0, 0, 1): Surface::normals of a surface that has only colours or a shape.
[[nodiscard]] Image flat_normals(const SurfaceSettings& settings);

/// A function of Surface: the map of a member function, such as `double alpha(const glm::dvec2& uv) const`, of a class
/// that is constructed from the settings. The class may have a static function `size_of` (settings) of its maps.
template <int channels, auto value_at>
[[nodiscard]] Image map_of(const SurfaceSettings& settings) {
  const auto fill = [&]<class Field, class Value>(Value (Field::*value)(const glm::dvec2&) const) {
    const Field field(settings);
    glm::ivec2 size{settings.resolution};
    if constexpr (requires { Field::size_of(settings); }) size = Field::size_of(settings);
    return fill_map(size, channels, [&](const glm::dvec2& uv) { return glm::dvec3{(field.*value)(uv)}; });
  };
  return fill(value_at);
}

/// The unit normal of a height field with gradient `slope` (rise over run along x and y).
[[nodiscard]] inline glm::dvec3 normal_of_slope(const glm::dvec2& slope) {
  return glm::normalize(glm::dvec3{-slope, 1.0});
}

/// `index` modulo `count`, 0 to `count` - 1.
[[nodiscard]] inline int wrap(int index, int count) { return (index % count + count) % count; }

/// `columns` x `rows` values, both >= 1.
template <typename Value>
class WrappedGrid {
 public:
  WrappedGrid(int columns, int rows)
      : columns_(columns), rows_(rows), values_(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows)) {}

  /// Any column and row, negative ones too.
  [[nodiscard]] Value& at(int column, int row) { return values_[index(column, row)]; }
  [[nodiscard]] const Value& at(int column, int row) const { return values_[index(column, row)]; }

  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }

  /// Row by row.
  [[nodiscard]] auto begin() { return values_.begin(); }
  [[nodiscard]] auto end() { return values_.end(); }

 private:
  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(wrap(row, rows_)) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(wrap(column, columns_));
  }

  int columns_, rows_;
  std::vector<Value> values_;
};

}  // namespace footprint
