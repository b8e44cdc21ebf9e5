// Where a level is drawn that is made from the next finer one of the same texture, before it is put in its place.
#pragma once

#include "renderer/gl/objects.hpp"

namespace footprint::xu_vmf {

/// A texture for drawing into, as large as the largest level so far. A level is not drawn straight into its texture:
/// OpenGL allows that while another level of it is read (4.5 core, section 9.3.1, where base and maximum level keep
/// them apart), but in Vulkan what a draw reads has another layout than what it draws into, and a driver over it that
/// keeps one layout for a whole texture breaks that rule (Mesa's zink does, which `scripts/validate_vulkan` shows).
class DrawnLevel {
 public:
  /// Makes room for `layers` of width x height texels in the format of `like`. Errors (machine): as gl::Texture.
  const gl::Texture& make_room(const gl::Texture& like, int width, int height, int layers);

  /// Copies what was drawn to layers first_layer and after of a level of `map`, whose size it has.
  void copy_to(const gl::Texture& map, int level, int first_layer, int layers) const;

 private:
  gl::Texture texture_;
  GLint format_ = 0;
  int layers_ = 0;
};

}  // namespace footprint::xu_vmf
