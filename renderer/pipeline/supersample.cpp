// Passes of samples are drawn tile by tile and added up on the GPU, block by block. The spread of the block means gives
// the standard error.
#include "renderer/pipeline/supersample.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace footprint {
namespace {

constexpr int default_tile_edge = 512;

ProgramSettings settings_of(ReferenceFilter filter, bool orthographic, EnvironmentUse environment) {
  return {.sampling = filter == ReferenceFilter::after_shading ? Sampling::texel : Sampling::point,
          .sampler_state = filter == ReferenceFilter::bilinear ? SamplerState::trilinear : SamplerState::nearest,
          .footprint = {},
          .counting = Counting::none,
          .orthographic = orthographic,
          .environment = environment};
}

// `tile` has row 0 at the bottom, the images at the top.
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

struct Pixel {
  glm::dvec3 mean{0};
  double count = 0;
};

Pixel merged(const Pixel& a, const Pixel& b) {
  const double count = a.count + b.count;
  if (count <= 0.0) return {};
  return {(a.count * a.mean + b.count * b.mean) / count, count};
}

Pixel pixel_of(const Image& mean, std::size_t i) {
  const float* const texel = &mean.texels[4 * i];
  return {{texel[0], texel[1], texel[2]}, texel[3]};
}

void set(Image& image, std::size_t i, const Pixel& pixel, float coverage) {
  for (int c = 0; c < 3; ++c) image.texels[4 * i + static_cast<std::size_t>(c)] = static_cast<float>(pixel.mean[c]);
  image.texels[4 * i + 3] = pixel.count > 0.0 ? coverage : 0.0F;
}

// The variance of the mean of blocks that are estimates of their own, B of them with weights w that sum to one:
// B / (B - 1) of the sum of w^2 (m - mean)^2.
glm::dvec3 variance_of(std::span<const Pixel> blocks, const Pixel& all) {
  glm::dvec3 sum(0);
  double filled = 0;
  for (const Pixel& block : blocks) {
    if (block.count <= 0.0) continue;
    const glm::dvec3 off = block.count / all.count * (block.mean - all.mean);
    sum += off * off;
    filled += 1.0;
  }
  return filled < 2.0 ? glm::dvec3(0) : sum * (filled / (filled - 1.0));
}

// The mean of each of the two sequences' two blocks, pixel by pixel.
class SampleBlocks {
 public:
  explicit SampleBlocks(const glm::ivec2& size) {
    for (Block& block : blocks_) block = {Image(size.x, size.y, 4), Image(size.x, size.y, 1), 0.0};
  }

  // Reads a tile of a block of `samples` samples per pixel from the sums of resolve_samples.glsl.
  void add(const gl::RenderTarget& sums, const Tile& tile, int half, int block, double samples) {
    Block& into = blocks_.at(static_cast<std::size_t>(2 * half + block));
    into.samples = samples;
    read_tile(sums, 0, tile, into.mean);
    read_tile(sums, 1, tile, into.covered);
  }

  // Weighted means over the blocks, and their spread.
  [[nodiscard]] Supersampled result(int spp) const {
    const int width = blocks_[0].mean.width, height = blocks_[0].mean.height;
    Supersampled out{
        .spp = spp, .mean = Image(width, height, 4), .standard_error = Image(width, height, 3), .halves = {}};
    Image first(width, height, 4), second(width, height, 4);
    for (std::size_t i = 0; i < out.mean.texel_count(); ++i) {
      std::array<Pixel, block_count> blocks;
      std::ranges::transform(blocks_, blocks.begin(), [&](const Block& block) { return pixel_of(block.mean, i); });
      double covered = 0;
      for (const Block& block : blocks_) covered += block.covered.texels[i];
      const auto coverage = static_cast<float>(covered / spp);
      const Pixel even = merged(blocks[0], blocks[1]), odd = merged(blocks[2], blocks[3]);
      const Pixel all = merged(even, odd);
      set(first, i, even, coverage);
      set(second, i, odd, coverage);
      set(out.mean, i, all, coverage);
      if (all.count <= 0.0) continue;
      const glm::dvec3 variance = variance_of(blocks, all);
      for (int c = 0; c < 3; ++c)
        out.standard_error.texels[3 * i + static_cast<std::size_t>(c)] = static_cast<float>(std::sqrt(variance[c]));
    }
    if (blocks_[2].samples > 0.0) out.halves.emplace(std::move(first), std::move(second));
    return out;
  }

 private:
  static constexpr std::size_t block_count = 4;
  struct Block {
    Image mean;      // and the number of samples with a radiance
    Image covered;   // the number of samples that the surface covers, one channel
    double samples;  // per pixel; 0: the block is empty
  };
  std::array<Block, block_count> blocks_;
};

bool is_unresolved(std::span<const float> mean, std::span<const float> error, float exposure,
                   const UnresolvedLimits& limits) {
  for (std::size_t c = 0; c < 3; ++c) {
    if (error[c] > limits.relative * mean[c] && exposure * error[c] > limits.displayed) return true;
  }
  return false;
}

}  // namespace

// The target of a tile's samples, and their sums, which are read from one target and written to the other.
class Supersampler::Accumulator {
 public:
  Accumulator(const glm::ivec2& tile, int grid)
      : tile_(tile),
        grid_(grid),
        samples_(tile.x * grid, tile.y * grid, sample_format, true),
        sums_{sums_of(tile), sums_of(tile)} {}

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
    gl::bind_texture(0, samples_.color(0));
    for (GLuint i = 0; i < sum_count; ++i) gl::bind_texture(i + 1, sums().color(i));
    newest_ = 1 - newest_;
    triangle_.draw_into(sums(), tile.size.x, tile.size.y);
  }

 private:
  static constexpr GLint sum_count = 2;  // mean and count, number of covered samples
  static constexpr std::array<GLenum, 1> sample_format{GL_RGBA32F};
  static constexpr std::array<GLenum, 2> sum_formats{GL_RGBA32F, GL_R32F};

  static gl::RenderTarget sums_of(const glm::ivec2& tile) { return {tile.x, tile.y, sum_formats, false}; }

  glm::ivec2 tile_;
  int grid_;
  gl::RenderTarget samples_;
  std::array<gl::RenderTarget, 2> sums_;
  std::size_t newest_ = 0;
  gl::ScreenTriangle triangle_;
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

// The parameters of all passes of an image.
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
  program_.draw(*scene_, *method_, *sampling.view,
                tile_matrix(*sampling.view, tile, pass.offset / static_cast<double>(grid)),
                {.origin = tile.origin * grid,
                 .grid = grid,
                 .seed = half_seed(sampling.seed, pass.half),
                 .first = pass.number * static_cast<std::uint32_t>(grid * grid),
                 .texels = sampling.texels});
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

Image unresolved(const Supersampled& reference, float exposure, const UnresolvedLimits& limits) {
  const Image& mean = reference.mean;
  Image mask(mean.width, mean.height, 1);
  std::size_t object = 0;
  for (int y = 0; y < mean.height; ++y) {
    for (int x = 0; x < mean.width; ++x) {
      if (mean.at(x, y)[3] <= 0.0F) continue;
      ++object;
      if (is_unresolved(mean.at(x, y), reference.standard_error.at(x, y), exposure, limits)) mask.at(x, y)[0] = 1.0F;
    }
  }
  // If the whole reference is noisy, excluding pixels would only leave dark ones.
  const bool is_noise = static_cast<double>(pixel_count(mask)) > limits.most * static_cast<double>(object);
  return is_noise ? Image(mean.width, mean.height, 1) : mask;
}

void uncover(Image& picture, const Image& mask) {
  for (std::size_t i = 0; i < mask.texels.size(); ++i) {
    if (mask.texels[i] > 0.0F) picture.texels[4 * i + 3] = 0.0F;
  }
}

void leave_out(Supersampled& reference, const Image& mask) {
  uncover(reference.mean, mask);
  if (!reference.halves) return;
  uncover(reference.halves->first, mask);
  uncover(reference.halves->second, mask);
}

std::size_t pixel_count(const Image& mask) {
  return static_cast<std::size_t>(std::ranges::count_if(mask.texels, [](float value) { return value > 0.0F; }));
}

}  // namespace footprint
