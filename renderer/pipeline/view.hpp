// From a camera and a picture's size to the matrices of its tiles.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene/scene.hpp"

namespace footprint {

/// A picture to be taken: size in pixels, from a camera.
struct View {
  glm::ivec2 size{512, 512};
  Camera camera;
};

/// A rectangle of the picture that is drawn at once; pixels, row 0 at the bottom as in a GL window.
struct Tile {
  glm::ivec2 origin{0};
  glm::ivec2 size{0};
};

/// The picture in tiles of at most `edge` pixels a side, from the bottom left.
[[nodiscard]] std::vector<Tile> tiles_of(const glm::ivec2& size, int edge);

/// The same of a part of it.
[[nodiscard]] std::vector<Tile> tiles_in(const Tile& part, int edge);

/// World to clip space for a tile, its samples moved by `offset` pixels (0, 0: pixel centres). Depth is reversed, 1 at
/// the near plane and 0 at the far one: what is nearer is GL_GREATER (contexts have clip depths of 0 to 1). In double:
/// the parts of a large picture differ in the last digits of the whole picture's matrix.
[[nodiscard]] glm::mat4 tile_matrix(const View& view, const Tile& tile, const glm::dvec2& offset);

/// The rotation from world axes to the camera's: x right, y up, z towards the viewer.
[[nodiscard]] glm::mat3 world_to_camera(const Camera& camera);

[[nodiscard]] glm::vec3 camera_position(const Camera& camera);

/// The direction to an orthographic camera, the same from everywhere.
[[nodiscard]] glm::vec3 direction_to_camera(const Camera& camera);

}  // namespace footprint
