// The reference accumulator: many samples a pixel, their mean, and how far that mean can be trusted.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "renderer/pipeline/frame.hpp"
#include "renderer/pipeline/reference_filter.hpp"
#include "renderer/pipeline/sample_grid.hpp"

namespace footprint {

/// A supersampled picture. All images have the view's size, row 0 at the top.
struct Supersampled {
  int spp = 0;
  /// RGBA: mean radiance over the samples that have one, and the share 0..1 that the surface covers. Samples of invalid
  /// texels (docs/base-brdf.md) are covered and enter no mean; a pixel that has no other has coverage 0.
  Image mean;
  /// RGB: what the mean is off by, root mean square, from how far the means of the sequences' blocks lie apart
  /// (docs/metrics.md). 0 with one block.
  Image standard_error;
  /// RGBA means of the two sequences, which share no random number, with the coverage of both; none with fewer than two
  /// passes. Their difference tells the noise.
  std::optional<std::pair<Image, Image>> halves;
};

/// A method (or the base surface) ready to be supersampled at its finest level.
class Supersampler {
 public:
  /// `tile_edge` bounds the pixels accumulated at once; 0: 512. The result does not depend on it but for rounding.
  /// `environment` is for the base surface alone: `sampled` or `dense`.
  Supersampler(const gl::ContextInfo& context, GpuScene& scene, const GpuMethod& method, ReferenceFilter filter,
               bool orthographic, int tile_edge = 0, EnvironmentUse environment = EnvironmentUse::sampled);
  Supersampler(Supersampler&&) noexcept;
  ~Supersampler();

  /// Deterministic for a seed. Plain supersampling takes texels as `drawn`. Errors (usage): spp outside 1 to 4096;
  /// (interrupted) by `progress`.
  [[nodiscard]] Supersampled render(const View& view, int spp, std::uint64_t seed, const Progress& progress,
                                    TexelUse texels = TexelUse::filtered) const;

  /// The mean alone, which nothing tells the noise of: samples of one sequence in as few draws as they fit in, quicker
  /// than `render`, and not the samples that it takes. Errors: likewise.
  [[nodiscard]] Image render_mean(const View& view, int spp, std::uint64_t seed, const Progress& progress) const;

  /// Takes `tiles` of a picture of the same view and seed anew, with `spp` samples a pixel.
  void refine(Supersampled& picture, const View& view, std::span<const Tile> tiles, int spp, std::uint64_t seed,
              const Progress& progress) const;

  /// Draws and accumulates without reading back: what plain supersampling costs is the time of this call up to
  /// glFinish.
  void draw(const View& view, int spp, std::uint64_t seed) const;

 private:
  class Accumulator;
  struct Sampling;
  /// The sums of a tile, cleared; made anew where the size changes.
  Accumulator& accumulator(const glm::ivec2& tile, int grid) const;
  [[nodiscard]] Supersampled render_tiles(const Sampling& sampling, const SampleGrid& samples,
                                          std::span<const Tile> tiles, int spp, const Progress& progress) const;
  void accumulate(Accumulator& sums, const Sampling& sampling, const Tile& tile, const SamplePass& pass) const;

  GpuScene* scene_;
  const GpuMethod* method_;
  int tile_edge_;
  mutable SurfaceProgram program_;
  gl::Program resolve_;
  mutable std::unique_ptr<Accumulator> accumulator_;  // kept from picture to picture: its memory is what it costs
};

/// Root mean square of the standard error over object pixels and channels, over the mean radiance; docs/metrics.md.
/// None where the object covers no whole pixel, or spp is 1.
[[nodiscard]] std::optional<double> relative_standard_error(const Supersampled& reference);

}  // namespace footprint
