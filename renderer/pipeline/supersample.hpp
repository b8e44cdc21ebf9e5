// The reference: many samples per pixel, their mean, how far that mean can be trusted, and pixels where it cannot.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <utility>

#include "renderer/gl/objects.hpp"
#include "renderer/pipeline/frame.hpp"
#include "renderer/pipeline/sample_sequence.hpp"
#include "renderer/pipeline/shader_flags.hpp"

namespace footprint {

/// A supersampled image, light that surfaces emit included. All images have the view's size, row 0 at the top.
struct Supersampled {
  int spp = 0;
  /// RGBA: mean radiance over the samples that have one, and the share 0..1 of samples that the surface covers. Samples
  /// of invalid texels (base-brdf.md) cover but enter no mean; a pixel with no other samples has coverage 0.
  Image mean;
  /// RGB: standard error of the mean, from the spread of the sequences' block means (metrics.md); 0 with one
  /// block.
  Image standard_error;
  /// RGBA: means of the two sequences, which share no random number, with the coverage of both. Their difference
  /// estimates the noise. None with fewer than two passes.
  std::optional<std::pair<Image, Image>> halves;
};

/// Supersamples a method, or the base surface, at its finest level.
class Supersampler {
 public:
  /// tile_edge: largest tile accumulated at once, pixels; 0: 512. It changes the result by rounding only.
  /// environment: `sampled` or `dense`; for the base surface only.
  Supersampler(const gl::ContextInfo& context, GpuScene& scene, const GpuMethod& method, Sampling filter,
               bool orthographic, int tile_edge = 0, EnvironmentUse environment = EnvironmentUse::sampled);

  /// Deterministic for a seed.
  /// spp: samples per pixel, 1 to 4096; otherwise throws Error (usage).
  /// texels: plain supersampling takes them as `drawn`.
  /// progress: may throw Error (interrupted).
  [[nodiscard]] Supersampled render(const View& view, int spp, std::uint64_t seed, const Progress& progress,
                                    TexelUse texels = TexelUse::filtered) const;

  /// The mean only, without a noise estimate: samples of one sequence in as few draws as possible. Faster than
  /// `render`, with different samples. Throws as `render`.
  [[nodiscard]] Image render_mean(const View& view, int spp, std::uint64_t seed, const Progress& progress) const;

  /// Renders `tiles` of an image of the same view and seed again, with `spp` samples per pixel.
  void refine(Supersampled& picture, const View& view, std::span<const Tile> tiles, int spp, std::uint64_t seed,
              const Progress& progress) const;

  /// Draws and accumulates without reading back. The cost of plain supersampling is the time of this call up to
  /// glFinish.
  void draw(const View& view, int spp, std::uint64_t seed) const;

 private:
  [[nodiscard]] const gl::RenderTarget& sums() const { return sums_[newest_]; }
  // Makes room for the samples and sums of a tile, and clears the sums.
  void begin(const glm::ivec2& tile, int grid) const;
  [[nodiscard]] Supersampled render_tiles(const View& view, const SampleGrid& samples, std::span<const Tile> tiles,
                                          TexelUse texels, const Progress& progress) const;
  // To all images of a result, unless this draws that light itself.
  void add_emitted(Supersampled& picture, const View& view) const;
  // Draws a pass and adds it to the sums.
  void accumulate(const View& view, const Tile& tile, int grid, const SamplePass& pass, TexelUse texels) const;

  GpuScene* scene_;
  const GpuMethod* method_;
  int tile_edge_;
  SurfaceProgram program_;
  gl::Program resolve_;
  gl::ScreenTriangle triangle_;
  // Reused between images, because allocating them is expensive. Sums are read from one target and written to the
  // other.
  mutable gl::RenderTarget samples_;
  mutable std::array<gl::RenderTarget, 2> sums_;
  mutable std::size_t newest_ = 0;
};

/// Root mean square of the standard error over object pixels and channels, relative to the mean radiance
/// (metrics.md). None if the object covers no whole pixel, or spp is 1.
[[nodiscard]] std::optional<double> relative_standard_error(const Supersampled& reference);

/// A pixel is unresolved if, in any channel, its standard error is above `relative` of its mean and, once exposed,
/// above `displayed`, so that it is visible.
struct UnresolvedLimits {
  double relative = 0.5;    ///< 1 if one block of four has all of the light, 0.58 if two have
  double displayed = 0.01;  ///< of a display's peak of 1
  double most = 0.05;       ///< of the object's pixels; with more of them the reference is noisy, and none counts
};

/// A mask, one channel: 1 in the object's unresolved pixels, else 0. There a few samples, which another seed would not
/// have, carry nearly all of the light, as in highlights of punctual lights on a mirror.
[[nodiscard]] Image unresolved(const Supersampled& reference, float exposure, const UnresolvedLimits& limits = {});

/// Excludes the pixels of `mask` from all figures: sets their coverage to 0 in the reference's mean and halves.
void leave_out(Supersampled& reference, const Image& mask);

/// Sets the coverage of the pixels of `mask` to 0 in one image.
void uncover(Image& picture, const Image& mask);

/// The number of pixels in which a mask is above 0.
[[nodiscard]] std::size_t pixel_count(const Image& mask);

}  // namespace footprint
