// Maps that are filled texel by texel, in parallel, each texel a pure function of its uv; and grids of values that
// tile.
#pragma once

#include <cstddef>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/image/image.hpp"
#include "renderer/scene/surface.hpp"

namespace footprint {

/// The unit normal at a point of the map: x to the right, y upwards, both within (0, 1).
using NormalAt = std::function<glm::dvec3(const glm::dvec2& uv)>;

/// The colour (0 to 1, linear) at such a point.
using ColorAt = std::function<glm::dvec3(const glm::dvec2& uv)>;

/// A single value, such as the exponent of a lobe, at such a point.
using ValueAt = std::function<double(const glm::dvec2& uv)>;

/// The normals at the texels' centres, with weight 1. The functions are called from several threads at once.
[[nodiscard]] Image fill_normals(int resolution, const NormalAt& normal_at);

/// Normals without relief, (0, 0, 1): Surface::normals of a surface that has only colours or a shape.
[[nodiscard]] Image flat_normals(const SurfaceSettings& settings);

/// The colours at the texels' centres of a map of any width and height, with alpha 1 in a fourth channel.
[[nodiscard]] Image fill_colors(glm::ivec2 size, const ColorAt& color_at);

/// The colours in three channels, and values in one.
[[nodiscard]] Image fill_rgb(glm::ivec2 size, const ColorAt& color_at);
[[nodiscard]] Image fill_values(glm::ivec2 size, const ValueAt& value_at);

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
