// Keeps the texture until a larger one, or one of another format, is needed.
#include "methods/xu_vmf/drawn_level.hpp"

#include <algorithm>

#include "renderer/gl/functions.hpp"

namespace footprint::xu_vmf {

const gl::Texture& DrawnLevel::make_room(const gl::Texture& like, int width, int height, int layers) {
  GLint format = 0;
  gl::api().GetTextureLevelParameteriv(like.name(), 0, GL_TEXTURE_INTERNAL_FORMAT, &format);
  const bool fits = format == format_ && width <= texture_.width() && height <= texture_.height() && layers <= layers_;
  if (fits) return texture_;
  texture_ = gl::Texture();  // before the next one takes its memory
  texture_ = gl::Texture(static_cast<GLenum>(format), width, height, 1, layers);
  format_ = format;
  layers_ = layers;
  return texture_;
}

void DrawnLevel::copy_to(const gl::Texture& map, int level, int first_layer, int layers) const {
  const int width = std::max(map.width() >> level, 1), height = std::max(map.height() >> level, 1);
  gl::api().CopyImageSubData(texture_.name(), GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, map.name(), GL_TEXTURE_2D_ARRAY, level,
                             0, 0, first_layer, width, height, layers);
}

}  // namespace footprint::xu_vmf
