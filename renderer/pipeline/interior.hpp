// Interior pixels: those in which every sample of the reference sees one smooth piece of one surface. What a method
// that filters normal maps can be held to; in all others it is edges of the geometry that alias.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "renderer/core/progress.hpp"
#include "renderer/gl/objects.hpp"
#include "renderer/image/image.hpp"
#include "renderer/pipeline/bindings.hpp"
#include "renderer/pipeline/gpu_scene.hpp"
#include "renderer/pipeline/sample_grid.hpp"
#include "renderer/pipeline/view.hpp"

namespace footprint {

/// What the samples of a pixel have to agree in. Each is compared with the pixel's first one. Everything counts in a
/// run; tests leave one out to see that it is what tells an edge.
///
/// - coverage: all of them lie on the surface, none beside it.
/// - materials, charts: the same material, and UV island (charts.hpp).
/// - cuts: none within an island: texture coordinates change at most twice as fast as over the surface at either
/// sample.
/// - normals: those of the triangles and those of the vertices lie within 10 degrees of the first sample's. Normals
///   spread evenly over 10 degrees have a slope variance of 0.0025, that of a lobe of roughness 0.27: far below what
///   normal maps that are worth filtering have, and below what a method could be blamed for.
/// - depth: the step between the samples' positions lies within 10 degrees of the triangle's plane, as curvature of
///   that much allows, and is no longer than twice what the pixel spans in that plane.
/// - shadows: where the scene casts any, the share of each light that reaches the surface (its shadow map is filtered,
///   and a light below the horizon does not reach it) differs by at most a sixteenth: within a soft edge that is wider
///   than 16 pixels a pixel's centre stands for the pixel.
struct InteriorCriteria {
  bool coverage = true, materials = true, charts = true, cuts = true, normals = true, depth = true, shadows = true;
};

/// What is known of the geometry under each pixel. One channel, the view's size, row 0 at the top.
struct Interior {
  Image mask;    ///< 1 where the pixel is interior, else 0
  Image texels;  ///< the longer edge of the pixel's footprint in texels of the normal map; 0 without one, or beside it
};

/// A scene ready to be looked at. Needs the context that made it to be current, also when destroyed.
class InteriorFinder {
 public:
  /// `values` is what `scene` was made from. `tile_edge` bounds the pixels drawn at once; 0: 256. The result does not
  /// depend on it but for rounding.
  InteriorFinder(GpuScene& scene, const Scene& values, int tile_edge = 0, const InteriorCriteria& criteria = {});

  /// Draws the samples of a reference of so many samples a pixel and that seed, the first 256 of them where there are
  /// more: an edge that hides in less than 1/256 of a pixel is no error to speak of. Only `part` of the picture is
  /// looked at, no pixel beside it is interior. Errors as Supersampler::render.
  [[nodiscard]] Interior render(const View& view, const Tile& part, int spp, std::uint64_t seed,
                                const Progress& progress) const;

 private:
  // The triangles of a batch with the numbers of their charts.
  struct Part {
    const GpuBatch* batch;
    gl::Buffer charts;
    gl::VertexArray vertex_array;
    glm::vec2 map_size;
  };
  // One kind of look at the samples: at pieces of surface, or at the shares of four lights.
  struct Look {
    bool shadows = false;
    gl::Program draw, compare;
    TextureUnits units{{}, {}};
    gl::RenderTarget first, other;  // the first pass of samples, and the one that is compared with it
  };
  void add_parts(const Scene& values);
  [[nodiscard]] Look look(bool shadows) const;
  void fit(Look& look, const glm::ivec2& size) const;
  void draw(const Look& look, const gl::RenderTarget& target, const View& view, const Tile& tile,
            const SampleGrid& samples, std::size_t pass) const;
  void compare(const Look& look, const gl::RenderTarget& drawn, const View& view, const Tile& tile, int grid) const;
  void look_at(const Look& look, const View& view, const Tile& tile, const SampleGrid& samples) const;

  GpuScene* scene_;
  InteriorCriteria criteria_;
  int tile_edge_;
  bool orthographic_;
  float far_corner_;  // of the bounds, from the world's origin
  std::vector<Part> parts_;
  gl::VertexArray no_vertices_;
  mutable Look pieces_;
  mutable std::optional<Look> shadows_;  // where shadows are cast and count
  mutable gl::RenderTarget result_;
};

}  // namespace footprint
