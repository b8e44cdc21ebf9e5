// Rectangles packed on shelves: side by side, and on a further shelf where one is full.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>

namespace footprint {

/// Shelves of one width, in any unit. Place the highest rectangles first to waste little.
template <class Length>
class Shelves {
 public:
  using Size = glm::vec<2, Length>;

  explicit Shelves(Length width) : width_(width) {}

  /// The lower left corner of the next rectangle; one wider than a shelf gets its own shelf.
  Size place(const Size& size) {
    if (pen_.x > Length{0} && pen_.x + size.x > width_) {
      pen_ = {Length{0}, height()};
      shelf_ = Length{0};
    }
    const Size corner = pen_;
    shelf_ = std::max(shelf_, size.y);
    pen_.x += size.x;
    return corner;
  }

  /// The height of all shelves.
  [[nodiscard]] Length height() const { return pen_.y + shelf_; }

 private:
  Length width_, shelf_{0};
  Size pen_{0};
};

}  // namespace footprint
