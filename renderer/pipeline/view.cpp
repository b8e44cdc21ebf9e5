// Projections of both kinds of camera, cut to a tile.
#include "renderer/pipeline/view.hpp"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

namespace footprint {
namespace {

// Reversed depth, 1 at the near plane and 0 at the far one or at infinity. Then 32-bit floats resolve all distances
// equally well, however near the near plane is.
glm::dmat4 reversed_depth(glm::dmat4 projection, double scale, double offset) {
  projection[2][2] = scale;
  projection[3][2] = offset;
  return projection;
}

glm::dmat4 projection(const View& view) {
  const double aspect = static_cast<double>(view.size.x) / static_cast<double>(view.size.y);
  const Camera& camera = view.camera;
  const double near = camera.znear;
  if (camera.orthographic) {
    const double half_height = camera.ymag;
    const double half_width = half_height * aspect;
    const double far = camera.zfar.value_or(default_orthographic_far);
    return reversed_depth(glm::ortho(-half_width, half_width, -half_height, half_height, near, far), 1.0 / (far - near),
                          far / (far - near));
  }
  const glm::dmat4 infinite = glm::infinitePerspective(static_cast<double>(camera.yfov), aspect, near);
  if (!camera.zfar) return reversed_depth(infinite, 0.0, near);
  const double far = *camera.zfar;
  return reversed_depth(infinite, near / (far - near), near * far / (far - near));
}

// Maps a tile, whose samples are `offset` from the pixel centres, to the whole clip space.
glm::dmat4 tile_in_clip(const View& view, const Tile& tile, const glm::dvec2& offset) {
  const glm::dvec2 whole(view.size);
  const glm::dvec2 part(tile.size);
  const glm::dvec2 scale = whole / part;
  const glm::dvec2 centre = (glm::dvec2(tile.origin) + 0.5 * part + offset) / whole * 2.0 - 1.0;
  glm::dmat4 matrix(1.0);
  matrix[0][0] = scale.x;
  matrix[1][1] = scale.y;
  matrix[3][0] = -centre.x * scale.x;
  matrix[3][1] = -centre.y * scale.y;
  return matrix;
}

}  // namespace

std::vector<Tile> tiles_of(const glm::ivec2& size, int edge) {
  return tiles_in(Tile{.origin = {0, 0}, .size = size}, edge);
}

std::vector<Tile> tiles_in(const Tile& part, int edge) {
  std::vector<Tile> tiles;
  for (int y = 0; y < part.size.y; y += edge) {
    for (int x = 0; x < part.size.x; x += edge) {
      tiles.push_back(
          {part.origin + glm::ivec2(x, y), {std::min(edge, part.size.x - x), std::min(edge, part.size.y - y)}});
    }
  }
  return tiles;
}

glm::dmat4 clip_matrix(const View& view) { return projection(view) * glm::inverse(glm::dmat4(view.camera.world)); }

glm::mat4 tile_matrix(const View& view, const Tile& tile, const glm::dvec2& offset) {
  const glm::dmat4 world_to_camera = glm::inverse(glm::dmat4(view.camera.world));
  return glm::mat4(tile_in_clip(view, tile, offset) * projection(view) * world_to_camera);
}

glm::mat3 world_to_camera(const Camera& camera) { return glm::transpose(glm::mat3(camera.world)); }

glm::vec3 camera_position(const Camera& camera) { return glm::vec3(camera.world[3]); }

glm::vec3 direction_to_camera(const Camera& camera) { return glm::normalize(glm::vec3(camera.world[2])); }

}  // namespace footprint
