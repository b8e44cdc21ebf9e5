// The pixels of a picture in a tile.
#pragma once

#include "renderer/pipeline/view.hpp"

namespace footprint {

/// Calls `visit(column, row)` for the pixels of a tile, in an image of that height. Rows of tiles start at the bottom,
/// rows of images at the top.
template <class Visit>
void visit_pixels(const Tile& tile, int height, Visit visit) {
  for (int y = tile.origin.y; y < tile.origin.y + tile.size.y; ++y) {
    for (int x = tile.origin.x; x < tile.origin.x + tile.size.x; ++x) visit(x, height - 1 - y);
  }
}

}  // namespace footprint
