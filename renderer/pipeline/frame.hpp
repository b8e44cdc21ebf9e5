// One picture by one method: one sample a pixel over the pixel's footprint, in tiles where GL's limit asks for them.
#pragma once

#include <span>

#include "renderer/pipeline/surface_program.hpp"

namespace footprint {

/// A method ready to draw frames of one size.
class FrameRenderer {
 public:
  /// `tile_edge` bounds the pixels drawn at once; 0: as many as the GL takes, 4096 at most.
  FrameRenderer(const gl::ContextInfo& context, GpuScene& scene, const GpuMethod& method, const glm::ivec2& size,
                const ProgramSettings& settings, int tile_edge = 0);

  /// Runs the method's frame build, where one is due, and draws a view; the pixels stay on the GPU. What a frame costs
  /// is the time of this call up to glFinish.
  void draw(const View& view, const glm::dvec2& offset = {0.0, 0.0}) const;

  /// Builds, draws and reads: RGBA, linear radiance and coverage, row 0 at the top. `offset` moves the samples from the
  /// pixels' centres, in pixels.
  [[nodiscard]] Image render(const View& view, const glm::dvec2& offset = {0.0, 0.0}) const;

  /// Some rectangles of that picture alone, each no larger than a tile; 0 elsewhere.
  [[nodiscard]] Image render(const View& view, std::span<const Tile> parts) const;

  /// Draws `method` from here on: another bake of the same method with the same options.
  void exchange(const GpuMethod& method) { method_ = &method; }

  [[nodiscard]] const SurfaceProgram& program() const { return program_; }

 private:
  void draw_tile(const View& view, const Tile& tile, const glm::dvec2& offset) const;
  [[nodiscard]] Image render(const View& view, std::span<const Tile> parts, const glm::dvec2& offset) const;

  GpuScene* scene_;
  const GpuMethod* method_;
  SurfaceProgram program_;
  std::vector<Tile> tiles_;
  gl::RenderTarget target_;
};

/// Reads a tile of `target`'s attachment, as many channels as `picture` has, into its part of that, whose row 0 is the
/// top one.
void read_tile(const gl::RenderTarget& target, std::size_t attachment, const Tile& tile, Image& picture);

/// Clears the bound framebuffer to no radiance, no coverage, and the far plane.
void clear_target();

}  // namespace footprint
