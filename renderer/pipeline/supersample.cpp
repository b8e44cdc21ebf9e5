// Passes of samples drawn tile by tile and added up on the GPU, block by block; sample_blocks.hpp has their means.
#include "renderer/pipeline/supersample.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "renderer/pipeline/sample_blocks.hpp"

namespace footprint {
namespace {

constexpr int default_tile_edge = 512;

ProgramSettings settings_of(ReferenceFilter filter, bool orthographic, EnvironmentUse environment) {
  return {.sampling = filter == ReferenceFilter::after_shading ? Sampling::texel : Sampling::point,
          .lookup = filter == ReferenceFilter::bilinear ? Lookup::trilinear : Lookup::nearest,
          .footprint = {},
          .counting = false,
          .orthographic = orthographic,
          .environment = environment};
}

// `tile` has row 0 at the bottom, the pictures at the top.
void copy_tile(const Image& from, const Tile& tile, Image& to) {
  for (int y = 0; y < tile.size.y; ++y) {
    const int row = to.height - 1 - (tile.origin.y + y);
    const std::size_t first =
        (static_cast<std::size_t>(row) * static_cast<std::size_t>(to.width) + static_cast<std::size_t>(tile.origin.x)) *
        static_cast<std::size_t>(to.channels);
    std::copy_n(from.texels.begin() + static_cast<std::ptrdiff_t>(first), tile.size.x * to.channels,
                to.texels.begin() + static_cast<std::ptrdiff_t>(first));
  }
}

}  // namespace

// What a tile's samples are drawn into and added up in. Sums are read from one target and written to the other.
class Supersampler::Accumulator {
 public:
  Accumulator(const glm::ivec2& tile, int grid)
      : tile_(tile),
        grid_(grid),
        samples_(tile.x * grid, tile.y * grid, sample_format, true),
        sums_{sums_of(tile), sums_of(tile)} {
    GLuint name = 0;
    gl::api().CreateVertexArrays(1, &name);
    no_vertices_ = gl::VertexArray(name);
  }

  [[nodiscard]] bool fits(const glm::ivec2& tile, int grid) const { return tile_ == tile && grid_ == grid; }
  [[nodiscard]] const gl::RenderTarget& samples() const { return samples_; }
  [[nodiscard]] const gl::RenderTarget& sums() const { return sums_[newest_]; }

  void clear() {
    constexpr std::array<float, 4> nothing{};
    gl::api().BindFramebuffer(GL_FRAMEBUFFER, sums().framebuffer());
    for (GLint i = 0; i < sum_count; ++i) gl::api().ClearBufferfv(GL_COLOR, i, nothing.data());
  }

  // Adds the samples that have been drawn to the sums of the tile's pixels.
  void add(const gl::Program& resolve, const Tile& tile) {
    gl::api().UseProgram(resolve.name());
    gl::api().Uniform1i(resolve.uniform("grid"), grid_);
    bind(0, samples_.color(0));
    for (GLuint i = 0; i < sum_count; ++i) bind(i + 1, sums().color(i));
    newest_ = 1 - newest_;
    gl::api().BindFramebuffer(GL_FRAMEBUFFER, sums().framebuffer());
    gl::api().Viewport(0, 0, tile.size.x, tile.size.y);
    gl::api().Disable(GL_DEPTH_TEST);
    gl::api().Disable(GL_CULL_FACE);
    gl::api().BindVertexArray(no_vertices_.name());
    gl::api().DrawArrays(GL_TRIANGLES, 0, 3);
  }

 private:
  static constexpr GLint sum_count = 2;  // mean and count, number of covered samples
  static constexpr std::array<GLenum, 1> sample_format{GL_RGBA32F};
  static constexpr std::array<GLenum, 2> sum_formats{GL_RGBA32F, GL_R32F};

  static gl::RenderTarget sums_of(const glm::ivec2& tile) { return {tile.x, tile.y, sum_formats, false}; }

  static void bind(GLuint unit, const gl::Texture& texture) {
    gl::api().BindTextureUnit(unit, texture.name());
    gl::api().BindSampler(unit, 0);
  }

  glm::ivec2 tile_;
  int grid_;
  gl::RenderTarget samples_;
  std::array<gl::RenderTarget, 2> sums_;
  std::size_t newest_ = 0;
  gl::VertexArray no_vertices_;
};

Supersampler::Supersampler(const gl::ContextInfo& context, GpuScene& scene, const GpuMethod& method,
                           ReferenceFilter filter, bool orthographic, int tile_edge, EnvironmentUse environment)
    : scene_(&scene),
      method_(&method),
      tile_edge_(std::min(tile_edge > 0 ? tile_edge : default_tile_edge, context.max_framebuffer_size / 4)),
      program_(scene, method.baked(), settings_of(filter, orthographic, environment)),
      resolve_("resolve samples", screen_vertex_shader(), resolve_shader()) {}

Supersampler::Supersampler(Supersampler&&) noexcept = default;
Supersampler::~Supersampler() = default;

Supersampler::Accumulator& Supersampler::accumulator(const glm::ivec2& tile, int grid) const {
  if (!accumulator_ || !accumulator_->fits(tile, grid)) accumulator_ = std::make_unique<Accumulator>(tile, grid);
  accumulator_->clear();
  return *accumulator_;
}

// What is the same for all passes of a picture.
struct Supersampler::Sampling {
  const View* view;
  int grid;
  std::uint64_t seed;
  TexelUse texels;
};

void Supersampler::accumulate(Accumulator& sums, const Sampling& sampling, const Tile& tile,
                              const SamplePass& pass) const {
  const int grid = sampling.grid;
  const glm::ivec2 size = tile.size * grid;
  gl::api().BindFramebuffer(GL_FRAMEBUFFER, sums.samples().framebuffer());
  gl::api().Viewport(0, 0, size.x, size.y);
  clear_target();
  program_.set_samples({.origin = tile.origin * grid,
                        .grid = grid,
                        .seed = half_seed(sampling.seed, pass.half),
                        .first = pass.number * static_cast<std::uint32_t>(grid * grid),
                        .texels = sampling.texels});
  program_.draw(*scene_, *method_, *sampling.view,
                tile_matrix(*sampling.view, tile, pass.offset / static_cast<double>(grid)));
  sums.add(resolve_, tile);
}

void Supersampler::draw(const View& view, int spp, std::uint64_t seed) const {
  const SampleGrid samples = sample_grid(spp, seed);
  method_->build_frame(view);
  const std::vector<Tile> tiles = tiles_of(view.size, tile_edge_);
  for (const Tile& tile : tiles) {
    Accumulator& sums = accumulator(tiles.front().size, samples.grid);
    for (const SamplePass& pass : samples.passes) {
      accumulate(sums, {.view = &view, .grid = samples.grid, .seed = seed, .texels = TexelUse::drawn}, tile, pass);
    }
  }
}

Supersampled Supersampler::render_tiles(const Sampling& sampling, const SampleGrid& samples,
                                        std::span<const Tile> tiles, int spp, const Progress& progress) const {
  method_->build_frame(*sampling.view);
  const auto steps = static_cast<double>(tiles.size() * samples.passes.size());
  glm::ivec2 largest(1);
  for (const Tile& tile : tiles) largest = glm::max(largest, tile.size);
  SampleBlocks blocks(sampling.view->size);
  double done = 0;
  for (const Tile& tile : tiles) {
    for (std::size_t first = 0, last = 0; first < samples.passes.size(); first = last) {
      const SamplePass& begin = samples.passes[first];
      Accumulator& sums = accumulator(largest, samples.grid);
      for (; last < samples.passes.size() && samples.passes[last].half == begin.half &&
             samples.passes[last].block == begin.block;
           ++last) {
        progress(fmt::format("{} samples per pixel", spp), done++ / steps);
        accumulate(sums, sampling, tile, samples.passes[last]);
      }
      const auto samples_taken = static_cast<double>(last - first) * samples.grid * samples.grid;
      blocks.add(sums.sums(), tile, begin.half, begin.block, samples_taken);
    }
  }
  return blocks.result(spp);
}

Supersampled Supersampler::render(const View& view, int spp, std::uint64_t seed, const Progress& progress,
                                  TexelUse texels) const {
  const SampleGrid samples = sample_grid(spp, seed);
  return render_tiles({.view = &view, .grid = samples.grid, .seed = seed, .texels = texels}, samples,
                      tiles_of(view.size, tile_edge_), spp, progress);
}

Image Supersampler::render_mean(const View& view, int spp, std::uint64_t seed, const Progress& progress) const {
  const SampleGrid samples = sample_grid(spp, seed, 1);
  return render_tiles({.view = &view, .grid = samples.grid, .seed = seed, .texels = TexelUse::filtered}, samples,
                      tiles_of(view.size, tile_edge_), spp, progress)
      .mean;
}

void Supersampler::refine(Supersampled& picture, const View& view, std::span<const Tile> tiles, int spp,
                          std::uint64_t seed, const Progress& progress) const {
  const SampleGrid samples = sample_grid(spp, seed);
  const Supersampled finer = render_tiles(
      {.view = &view, .grid = samples.grid, .seed = seed, .texels = TexelUse::filtered}, samples, tiles, spp, progress);
  for (const Tile& tile : tiles) {
    copy_tile(finer.mean, tile, picture.mean);
    copy_tile(finer.standard_error, tile, picture.standard_error);
    if (!picture.halves || !finer.halves) continue;
    copy_tile(finer.halves->first, tile, picture.halves->first);
    copy_tile(finer.halves->second, tile, picture.halves->second);
  }
}

std::optional<double> relative_standard_error(const Supersampled& reference) {
  if (reference.spp < 2) return {};
  double squares = 0;
  double radiance = 0;
  std::size_t values = 0;
  for (std::size_t i = 0; i < reference.mean.texel_count(); ++i) {
    if (reference.mean.texels[4 * i + 3] < 1.0F) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      squares += std::pow(static_cast<double>(reference.standard_error.texels[3 * i + c]), 2);
      radiance += reference.mean.texels[4 * i + c];
    }
    values += 3;
  }
  if (values == 0 || radiance <= 0.0) return {};
  const auto n = static_cast<double>(values);
  return std::sqrt(squares / n) / (radiance / n);
}

}  // namespace footprint
