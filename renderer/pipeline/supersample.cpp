// Passes of samples drawn tile by tile and added up on the GPU; means and errors of the sums.
#include "renderer/pipeline/supersample.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/core/error.hpp"

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

// Fills `other` with the mean of the samples of `mean` that are not in `half`; alpha of both is a number of samples.
Image complement(const Image& mean, const Image& half) {
  Image other(mean.width, mean.height, 4);
  for (std::size_t i = 0; i < mean.texels.size(); i += 4) {
    const float count = mean.texels[i + 3] - half.texels[i + 3];
    other.texels[i + 3] = count;
    if (count <= 0.0F) continue;
    for (std::size_t c = i; c < i + 3; ++c) {
      other.texels[c] = (mean.texels[c] * mean.texels[i + 3] - half.texels[c] * half.texels[i + 3]) / count;
    }
  }
  return other;
}

// Turns the numbers of samples with radiance in alpha into the share of the pixel that the surface covers. A pixel all
// of whose samples fell on invalid texels shows nothing: 0.
void set_coverage(Image& image, const Image& squares, double samples) {
  for (std::size_t i = 3; i < image.texels.size(); i += 4) {
    if (image.texels[i] > 0.0F) image.texels[i] = static_cast<float>(squares.texels[i] / samples);
  }
}

// Turns sums of squared deviations into the standard error of the mean.
Image standard_error_of(const Image& squares, const Image& mean_count) {
  Image out(squares.width, squares.height, 3);
  for (std::size_t i = 0; i < squares.texel_count(); ++i) {
    const float n = mean_count.texels[4 * i + 3];
    if (n < 2.0F) continue;
    for (std::size_t c = 0; c < 3; ++c) out.texels[3 * i + c] = std::sqrt(squares.texels[4 * i + c] / (n - 1.0F) / n);
  }
  return out;
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
  void add(const gl::Program& resolve, const Tile& tile, bool even_pass) {
    gl::api().UseProgram(resolve.name());
    gl::api().Uniform1i(resolve.uniform("grid"), grid_);
    gl::api().Uniform1i(resolve.uniform("even_pass"), even_pass ? 1 : 0);
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
  static constexpr GLint sum_count = 3;  // mean and count, squares and covered, mean and count of the even passes
  static constexpr std::array<GLenum, 1> sample_format{GL_RGBA32F};
  static constexpr std::array<GLenum, 3> sum_formats{GL_RGBA32F, GL_RGBA32F, GL_RGBA32F};

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

Supersampler::Accumulator& Supersampler::accumulator(const glm::ivec2& picture, int grid) const {
  const glm::ivec2 tile = glm::min(picture, glm::ivec2(tile_edge_));
  if (!accumulator_ || !accumulator_->fits(tile, grid)) accumulator_ = std::make_unique<Accumulator>(tile, grid);
  accumulator_->clear();
  return *accumulator_;
}

void Supersampler::accumulate(Accumulator& sums, const View& view, const Tile& tile, const SampleGrid& samples,
                              std::uint64_t seed, std::size_t pass) const {
  const glm::ivec2 size = tile.size * samples.grid;
  gl::api().BindFramebuffer(GL_FRAMEBUFFER, sums.samples().framebuffer());
  gl::api().Viewport(0, 0, size.x, size.y);
  clear_target();
  program_.set_sample(tile.origin * samples.grid, static_cast<std::uint32_t>(seed ^ (seed >> 32U)),
                      static_cast<std::uint32_t>(pass));
  const glm::dvec2 offset = samples.offsets[pass] / static_cast<double>(samples.grid);
  program_.draw(*scene_, *method_, view, tile_matrix(view, tile, offset));
  sums.add(resolve_, tile, pass % 2 == 0);
}

void Supersampler::draw(const View& view, int spp, std::uint64_t seed) const {
  const SampleGrid samples = sample_grid(spp, seed);
  method_->build_frame(view);
  for (const Tile& tile : tiles_of(view.size, tile_edge_)) {
    Accumulator& sums = accumulator(view.size, samples.grid);
    for (std::size_t pass = 0; pass < samples.offsets.size(); ++pass) accumulate(sums, view, tile, samples, seed, pass);
  }
}

Supersampled Supersampler::render(const View& view, int spp, std::uint64_t seed, const Progress& progress) const {
  const SampleGrid samples = sample_grid(spp, seed);
  method_->build_frame(view);
  const std::vector<Tile> tiles = tiles_of(view.size, tile_edge_);
  const auto steps = static_cast<double>(tiles.size() * samples.offsets.size());
  Image mean(view.size.x, view.size.y, 4);
  Image squares(view.size.x, view.size.y, 4);
  Image half(view.size.x, view.size.y, 4);
  double done = 0;
  for (const Tile& tile : tiles) {
    Accumulator& sums = accumulator(view.size, samples.grid);
    for (std::size_t pass = 0; pass < samples.offsets.size(); ++pass) {
      progress(fmt::format("{} samples a pixel", spp), done++ / steps);
      accumulate(sums, view, tile, samples, seed, pass);
    }
    read_tile(sums.sums(), 0, tile, mean);
    read_tile(sums.sums(), 1, tile, squares);
    read_tile(sums.sums(), 2, tile, half);
  }
  Supersampled out{.spp = spp, .mean = {}, .standard_error = standard_error_of(squares, mean), .halves = {}};
  if (samples.offsets.size() >= 2) {
    Image other = complement(mean, half);
    set_coverage(half, squares, spp);
    set_coverage(other, squares, spp);
    out.halves.emplace(std::move(half), std::move(other));
  }
  set_coverage(mean, squares, spp);
  out.mean = std::move(mean);
  return out;
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
