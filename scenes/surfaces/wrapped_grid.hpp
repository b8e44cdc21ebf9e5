// A grid of values over a map that tiles: whatever lies beyond one side is what lies at the other.
#pragma once

#include <cstddef>
#include <vector>

namespace footprint {

/// `index` as that of 0 to `count` - 1 on which it falls after whole turns.
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
