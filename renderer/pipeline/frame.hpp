// One image by one method: one sample per pixel over the pixel's footprint, in tiles if the GL's limits require them.
#pragma once

#include <span>
#include <vector>

#include "renderer/pipeline/surface_program.hpp"

namespace footprint {

/// Draws frames of one size by one method.
class FrameRenderer {
 public:
  /// tile_edge: largest tile drawn at once, pixels; 0: as large as the GL supports, at most 4096.
  FrameRenderer(const gl::ContextInfo& context, GpuScene& scene, const GpuMethod& method, const glm::ivec2& size,
                const ShaderVariant& wanted, int tile_edge = 0);

  /// Runs the method's frame build if one is due, and draws a view; the pixels stay on the GPU. The cost of a frame is
  /// the time of this call up to glFinish.
  /// offset: of the samples from the pixels' centres, pixels.
  void draw(const View& view, const glm::dvec2& offset = {0.0, 0.0}) const;

  /// The target that `draw` leaves a frame in; null if frames have several tiles.
  [[nodiscard]] const gl::RenderTarget* whole_frame() const { return tiles_.size() == 1 ? &target_ : nullptr; }

  /// Draws and reads back: RGBA, linear radiance and coverage, row 0 at the top. Light that surfaces emit is added.
  [[nodiscard]] Image render(const View& view, const glm::dvec2& offset = {0.0, 0.0}) const;

  /// Only some rectangles of that image, each no larger than a tile; 0 elsewhere.
  [[nodiscard]] Image render(const View& view, std::span<const Tile> parts,
                             const glm::dvec2& offset = {0.0, 0.0}) const;

  /// Draws `method` from now on: another bake of the same method with the same options.
  void exchange(const GpuMethod& method) { method_ = &method; }

  /// Adds the light that surfaces emit to an image of the view, unless the program counts.
  void add_emitted(Image& picture, const View& view) const;

  [[nodiscard]] const SurfaceProgram& program() const { return program_; }

 private:
  void draw_tile(const View& view, const Tile& tile, const glm::dvec2& offset) const;

  GpuScene* scene_;
  const GpuMethod* method_;
  FootprintFilter footprint_;
  bool counts_;  // pixels are no radiance
  SurfaceProgram program_;
  std::vector<Tile> tiles_;
  gl::RenderTarget target_;
};

/// Reads a tile of `target`'s attachment into its place in `picture`, whose row 0 is at the top. Reads as many channels
/// as `picture` has.
void read_tile(const gl::RenderTarget& target, std::size_t attachment, const Tile& tile, Image& picture);

/// Allocates `target` again unless it has this size.
void fit(gl::RenderTarget& target, const glm::ivec2& size, std::span<const GLenum> color_formats, bool depth);

/// Clears the bound framebuffer to no radiance, no coverage, and the far plane.
void clear_target();

/// Counted work per pixel: means over the pixels that the object covers wholly. All materials of a surface count.
struct PixelWork {
  double lookups = 0.0;  ///< texture lookups, including shared textures and the environment's
  double lobes = 0.0;    ///< lobe evaluations, over all lights
  double pixels = 0.0;   ///< number of those pixels
  /// The area of each of them on a map whose finest level is read whatever the footprint; the whole map has 1. Empty if
  /// no such map is read.
  std::vector<float> finest_areas{};
};

/// Counts one frame of a program that counts work. All are 0 if no pixel is covered.
[[nodiscard]] PixelWork pixel_work(const FrameRenderer& counting, const View& view);

/// Mean rounds per loop over those pixels; 0 if a program has no such loop.
struct PixelTrips {
  double probes = 0.0;  ///< probes of a footprint, or parts of a `shaded` one
  double lobes = 0.0;   ///< lobes of a method whose number depends on the pixel
  double rounds = 0.0;  ///< other rounds of such methods
};

/// Counts one frame of a program that counts trips.
[[nodiscard]] PixelTrips pixel_trips(const FrameRenderer& counting, const View& view);

}  // namespace footprint
