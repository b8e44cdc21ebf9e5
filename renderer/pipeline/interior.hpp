// Interior pixels: all samples of the reference see one smooth piece of one surface. Only there can a method that
// filters normal maps be right; in all others, edges of the geometry alias.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "renderer/core/progress.hpp"
#include "renderer/gl/objects.hpp"
#include "renderer/image/image.hpp"
#include "renderer/pipeline/gpu_scene.hpp"
#include "renderer/pipeline/sample_sequence.hpp"
#include "renderer/pipeline/shader_source.hpp"
#include "renderer/pipeline/view.hpp"

namespace footprint {

/// The criteria of an interior pixel. Each compares all samples with the pixel's first one. Runs use all criteria;
/// tests leave one out to check that it detects its kind of edge.
///
/// - coverage: all samples are on the surface.
/// - materials, charts: same material, and same UV island (charts.hpp).
/// - cuts: no cut within an island, so texture coordinates change at most twice as fast as over the surface at either
///   sample.
/// - normals: the triangles' and the vertices' normals are within 10 degrees of the first sample's. Normals spread
///   evenly over 10 degrees have a slope variance of 0.0025, like a lobe of roughness 0.27. That is far below the
///   variance of normal maps that need filtering.
/// - depth: the step between positions is within 10 degrees of the triangle's plane, and at most twice as long as the
///   pixel's extent in that plane.
/// - shadows: the unshadowed share of each light differs by at most 1/16. Shadow maps are filtered, and a light below
///   the horizon has share 0. Soft edges wider than 16 pixels are therefore interior.
struct InteriorCriteria {
  bool coverage = true, materials = true, charts = true, cuts = true, normals = true, depth = true, shadows = true;
};

/// The geometry under each pixel. All images have one channel and the view's size, row 0 at the top.
struct Interior {
  Image mask;    ///< 1 where the pixel is interior, else 0
  Image texels;  ///< longer edge of the footprint in texels of the normal map; 0 without a map or a surface
  /// The number, from 1, of the only material that the pixel's first sample shows. 0 without a surface, if several
  /// materials share it by a map of indices, or if the vertices' normal faces away from the camera.
  Image materials{};
};

/// A mask per material, one channel: the pixels of the mask `pixels` that show it.
/// materials: Interior::materials.
[[nodiscard]] std::vector<Image> material_masks(const Image& materials, const Image& pixels, std::size_t count);

/// Finds the interior pixels of a scene. The context that created it must be current, also at destruction.
class InteriorFinder {
 public:
  /// values: the scene that `scene` was created from.
  /// tile_edge: largest tile drawn at once, pixels; 0: 256. It changes the result by rounding only.
  InteriorFinder(GpuScene& scene, const Scene& values, int tile_edge = 0, const InteriorCriteria& criteria = {});

  /// Draws the samples of the reference of `spp` samples per pixel and `seed`, at most the first 256: an edge in less
  /// than 1/256 of a pixel is a negligible error.
  /// part: pixels outside of it are not interior.
  /// Throws as Supersampler::render.
  [[nodiscard]] Interior render(const View& view, const Tile& part, int spp, std::uint64_t seed,
                                const Progress& progress) const;

 private:
  // The triangles of a batch with the numbers of their charts and material.
  struct Part {
    const GpuBatch* batch;
    gl::Buffer charts;
    gl::VertexArray vertex_array;
    glm::vec2 map_size;
  };
  // One kind of pass over the samples: their geometry, or the unshadowed shares of four lights.
  struct SamplePasses {
    bool shadows = false;
    std::span<const GLenum> formats;  // of a pass
    gl::Program draw, compare;
    TextureUnits units{{}, {}};
    gl::RenderTarget first, other;  // the first pass, and the one that is compared with it
  };
  void add_parts(const Scene& values);
  [[nodiscard]] SamplePasses make_passes(bool shadows) const;
  void draw(const SamplePasses& passes, const gl::RenderTarget& target, const View& view, const Tile& tile,
            const SampleGrid& samples, std::size_t pass) const;
  void compare(const SamplePasses& passes, const gl::RenderTarget& drawn, const View& view, const Tile& tile,
               int grid) const;
  void draw_passes(const SamplePasses& passes, const View& view, const Tile& tile, const SampleGrid& samples) const;

  GpuScene* scene_;
  InteriorCriteria criteria_;
  int tile_edge_;
  bool orthographic_;
  float far_corner_;  // of the bounds, from the world's origin
  std::vector<Part> parts_;
  gl::ScreenTriangle triangle_;
  mutable SamplePasses geometry_;
  mutable std::optional<SamplePasses> shadows_;  // if shadows are cast and are a criterion
  mutable gl::RenderTarget result_;
};

}  // namespace footprint
