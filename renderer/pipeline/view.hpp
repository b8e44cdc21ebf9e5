// The matrices of an image's tiles, from camera and size.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene/scene.hpp"

namespace footprint {

/// An image to render: size in pixels, and camera.
struct View {
  glm::ivec2 size{512, 512};
  Camera camera;
  std::uint64_t seed = 0;   ///< of what stochastic footprints draw
  std::uint32_t frame = 0;  ///< number of the frame in its sequence, which their draws continue
};

/// A rectangle of the image that is drawn at once; pixels, row 0 at the bottom as in a GL window.
struct Tile {
  glm::ivec2 origin{0};
  glm::ivec2 size{0};
};

/// The image in tiles of at most `edge` pixels per side, from the bottom left.
[[nodiscard]] std::vector<Tile> tiles_of(const glm::ivec2& size, int edge);

/// A part of the image in tiles.
[[nodiscard]] std::vector<Tile> tiles_in(const Tile& part, int edge);

/// Without a far plane of its own an orthographic camera sees this far.
inline constexpr float default_orthographic_far = 1e4F;

/// World to clip space of the whole image, as tile_matrix.
[[nodiscard]] glm::dmat4 clip_matrix(const View& view);

/// World to clip space for a tile. Depth is reversed, 1 at the near plane and 0 at the far one, so nearer is
/// GL_GREATER. Computed in double precision, because the tiles of a large image differ in the last digits of its
/// matrix. offset: of the samples from the pixels' centres, pixels.
[[nodiscard]] glm::mat4 tile_matrix(const View& view, const Tile& tile, const glm::dvec2& offset);

/// The rotation from world axes to camera axes: x right, y up, z towards the viewer.
[[nodiscard]] glm::mat3 world_to_camera(const Camera& camera);

[[nodiscard]] glm::vec3 camera_position(const Camera& camera);

/// The direction to an orthographic camera, equal at all points.
[[nodiscard]] glm::vec3 direction_to_camera(const Camera& camera);

}  // namespace footprint
