// Passes of samples are drawn tile by tile and added up on the GPU, block by block. The spread of the block means gives
// the standard error.
#include "renderer/pipeline/supersample.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <span>

#include "renderer/pipeline/emitted_light.hpp"

namespace footprint {
namespace {

constexpr int default_tile_edge = 512;
constexpr std::array<GLenum, 1> sample_format{GL_RGBA32F};
constexpr std::array<GLenum, 2> sum_formats{GL_RGBA32F, GL_R32F};  // mean and count, number of covered samples
constexpr GLint sum_count = sum_formats.size();

// `tile` has row 0 at the bottom, the images at the top.
void copy_tile(const Image& from, const Tile& tile, Image& to) {
  for (int y = 0; y < tile.size.y; ++y) {
    const int row = to.height - 1 - (tile.origin.y + y);
    std::ranges::copy_n(from.at(tile.origin.x, row).begin(), std::ptrdiff_t{tile.size.x} * to.channels,
                        to.at(tile.origin.x, row).begin());
  }
}

using Pixel = glm::dvec4;  // a mean radiance, and of how many samples

Pixel merged(const Pixel& a, const Pixel& b) {
  const double count = a.w + b.w;
  if (count <= 0.0) return Pixel(0.0);
  return {(a.w * glm::dvec3(a) + b.w * glm::dvec3(b)) / count, count};
}

void set(Image& image, std::size_t i, const Pixel& pixel, float coverage) {
  const glm::vec4 texel(glm::vec3(pixel), pixel.w > 0.0 ? coverage : 0.0F);
  std::ranges::copy_n(glm::value_ptr(texel), 4, &image.texels[4 * i]);
}

// The variance of the mean of blocks that are estimates of their own, B of them with weights w that sum to one:
// B / (B - 1) of the sum of w^2 (m - mean)^2.
glm::dvec3 variance_of(std::span<const Pixel> blocks, const Pixel& all) {
  glm::dvec3 sum(0);
  double filled = 0;
  for (const Pixel& block : blocks) {
    if (block.w <= 0.0) continue;
    const glm::dvec3 off = block.w / all.w * glm::dvec3(block - all);
    sum += off * off;
    filled += 1.0;
  }
  return filled < 2.0 ? glm::dvec3(0) : sum * (filled / (filled - 1.0));
}

// The mean of each of the two sequences' two blocks, pixel by pixel.
class SampleBlocks {
 public:
  explicit SampleBlocks(const glm::ivec2& size) {
    for (Block& block : blocks_) block = {Image(size.x, size.y, 4), Image(size.x, size.y, 1)};
  }

  // Reads a tile of the block of `pass` from the sums of resolve_samples.glsl.
  void add(const gl::RenderTarget& sums, const Tile& tile, const SamplePass& pass) {
    Block& into = blocks_.at(std::size_t{2} * pass.half + pass.block);
    read_tile(sums, 0, tile, into.mean);
    read_tile(sums, 1, tile, into.covered);
  }

  // Weighted means over the blocks, and their spread.
  // has_halves: whether the second sequence has samples.
  [[nodiscard]] Supersampled result(int spp, bool has_halves) const {
    const int width = blocks_[0].mean.width, height = blocks_[0].mean.height;
    Supersampled out{
        .spp = spp, .mean = Image(width, height, 4), .standard_error = Image(width, height, 3), .halves = {}};
    Image first(width, height, 4), second(width, height, 4);
    for (std::size_t i = 0; i < out.mean.texel_count(); ++i) {
      std::array<Pixel, block_count> blocks;
      std::ranges::transform(blocks_, blocks.begin(),
                             [&](const Block& block) { return Pixel(glm::make_vec4(&block.mean.texels[4 * i])); });
      double covered = 0;
      for (const Block& block : blocks_) covered += block.covered.texels[i];
      const auto coverage = static_cast<float>(covered / spp);
      const Pixel even = merged(blocks[0], blocks[1]), odd = merged(blocks[2], blocks[3]);
      const Pixel all = merged(even, odd);
      set(first, i, even, coverage);
      set(second, i, odd, coverage);
      set(out.mean, i, all, coverage);
      if (all.w <= 0.0) continue;
      const glm::vec3 deviation(glm::sqrt(variance_of(blocks, all)));
      std::ranges::copy_n(glm::value_ptr(deviation), 3, &out.standard_error.texels[3 * i]);
    }
    if (has_halves) out.halves.emplace(std::move(first), std::move(second));
    return out;
  }

 private:
  static constexpr std::size_t block_count = 4;
  struct Block {
    Image mean;     // and the number of samples with a radiance
    Image covered;  // the number of samples that the surface covers, one channel
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

Supersampler::Supersampler(const gl::ContextInfo& context, GpuScene& scene, const GpuMethod& method, Sampling filter,
                           bool orthographic, int tile_edge, EnvironmentUse environment)
    : scene_(&scene),
      method_(&method),
      tile_edge_(std::min(tile_edge > 0 ? tile_edge : default_tile_edge, context.max_framebuffer_size / 4)),
      program_(scene, method.baked(), {.sampling = filter, .orthographic = orthographic, .environment = environment}),
      resolve_("resolve samples", screen_vertex_shader(), shared_stage("resolve_samples.glsl")) {}

void Supersampler::begin(const glm::ivec2& tile, int grid) const {
  constexpr std::array<float, 4> nothing{};
  fit(samples_, tile * grid, sample_format, true);
  for (gl::RenderTarget& target : sums_) fit(target, tile, sum_formats, false);
  gl::api().BindFramebuffer(GL_FRAMEBUFFER, sums().framebuffer());
  for (GLint i = 0; i < sum_count; ++i) gl::api().ClearBufferfv(GL_COLOR, i, nothing.data());
}

void Supersampler::accumulate(const View& view, const Tile& tile, int grid, const SamplePass& pass,
                              TexelUse texels) const {
  gl::api().BindFramebuffer(GL_FRAMEBUFFER, samples_.framebuffer());
  gl::api().Viewport(0, 0, tile.size.x * grid, tile.size.y * grid);
  clear_target();
  program_.draw(*scene_, *method_, view, tile_matrix(view, tile, pass.offset / static_cast<double>(grid)),
                {.origin = tile.origin * grid,
                 .grid = grid,
                 .seed = pass.seed,
                 .first = pass.number * static_cast<std::uint32_t>(grid * grid),
                 .texels = texels});
  gl::api().UseProgram(resolve_.name());
  gl::api().Uniform1i(resolve_.uniform("grid"), grid);
  gl::bind_texture(0, samples_.color(0));
  for (GLuint i = 0; i < sum_count; ++i) gl::bind_texture(i + 1, sums().color(i));
  newest_ = 1 - newest_;
  triangle_.draw_into(sums(), tile.size.x, tile.size.y);
}

void Supersampler::draw(const View& view, int spp, std::uint64_t seed) const {
  const SampleGrid samples = sample_grid(spp, seed);
  method_->build_frame(view);
  const std::vector<Tile> tiles = tiles_of(view.size, tile_edge_);
  for (const Tile& tile : tiles) {
    begin(tiles.front().size, samples.grid);
    for (const SamplePass& pass : samples.passes) accumulate(view, tile, samples.grid, pass, TexelUse::drawn);
  }
}

Supersampled Supersampler::render_tiles(const View& view, const SampleGrid& samples, std::span<const Tile> tiles,
                                        TexelUse texels, const Progress& progress) const {
  method_->build_frame(view);
  const int spp = static_cast<int>(samples.passes.size()) * samples.grid * samples.grid;
  const auto steps = static_cast<double>(tiles.size() * samples.passes.size());
  glm::ivec2 largest(1);
  for (const Tile& tile : tiles) largest = glm::max(largest, tile.size);
  SampleBlocks blocks(view.size);
  double done = 0;
  for (const Tile& tile : tiles) {
    for (std::size_t first = 0, last = 0; first < samples.passes.size(); first = last) {
      const SamplePass& start = samples.passes[first];
      begin(largest, samples.grid);
      for (; last < samples.passes.size() && samples.passes[last].half == start.half &&
             samples.passes[last].block == start.block;
           ++last) {
        progress(fmt::format("{} samples per pixel", spp), done++ / steps);
        accumulate(view, tile, samples.grid, samples.passes[last], texels);
      }
      blocks.add(sums(), tile, start);
    }
  }
  Supersampled out = blocks.result(spp, samples.passes.back().half > 0);
  add_emitted(out, view);
  return out;
}

void Supersampler::add_emitted(Supersampled& picture, const View& view) const {
  if (method_->baked().method == &emitted_surface()) return;
  scene_->add_emitted(picture.mean, view);
  if (!picture.halves) return;
  scene_->add_emitted(picture.halves->first, view);
  scene_->add_emitted(picture.halves->second, view);
}

Supersampled Supersampler::render(const View& view, int spp, std::uint64_t seed, const Progress& progress,
                                  TexelUse texels) const {
  return render_tiles(view, sample_grid(spp, seed), tiles_of(view.size, tile_edge_), texels, progress);
}

Image Supersampler::render_mean(const View& view, int spp, std::uint64_t seed, const Progress& progress) const {
  return render_tiles(view, sample_grid(spp, seed, 1), tiles_of(view.size, tile_edge_), TexelUse::filtered, progress)
      .mean;
}

void Supersampler::refine(Supersampled& picture, const View& view, std::span<const Tile> tiles, int spp,
                          std::uint64_t seed, const Progress& progress) const {
  const Supersampled finer = render_tiles(view, sample_grid(spp, seed), tiles, TexelUse::filtered, progress);
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
