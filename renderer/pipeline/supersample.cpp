// See supersample.hpp.
#include "renderer/pipeline/supersample.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/core/error.hpp"
#include "renderer/core/suggest.hpp"

namespace footprint {
namespace {

constexpr int default_tile_edge = 512;
constexpr GLuint resolve_group = 8;  // local_size of resolve_samples.glsl
constexpr std::array<std::pair<ReferenceFilter, std::string_view>, 3> filters{{
    {ReferenceFilter::after_shading, "after_shading"},
    {ReferenceFilter::nearest, "nearest"},
    {ReferenceFilter::bilinear, "bilinear"},
}};

ProgramSettings settings_of(ReferenceFilter filter, bool orthographic) {
  return {.sampling = filter == ReferenceFilter::after_shading ? Sampling::texel : Sampling::point,
          .lookup = filter == ReferenceFilter::bilinear ? Lookup::trilinear : Lookup::nearest,
          .max_probes = 1,
          .orthographic = orthographic};
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

// Turns numbers of samples in alpha into coverage.
void scale_alpha(Image& image, double samples) {
  for (std::size_t i = 3; i < image.texels.size(); i += 4) {
    image.texels[i] = static_cast<float>(image.texels[i] / samples);
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

std::string_view filter_name(ReferenceFilter filter) {
  return std::ranges::find(filters, filter, &std::pair<ReferenceFilter, std::string_view>::first)->second;
}

ReferenceFilter parse_filter(const std::string& word) {
  std::vector<std::string> names;
  for (const auto& [filter, name] : filters) {
    if (name == word) return filter;
    names.emplace_back(name);
  }
  throw Error(ErrorKind::usage, "--filter", fmt::format("unknown filter `{}`", word), suggestion(word, names));
}

// What a tile's samples are drawn into and added up in.
struct Supersampler::Accumulator {
  static constexpr std::array<GLenum, 1> sample_format{GL_RGBA32F};
  static constexpr std::array<GLenum, 3> sum_formats{GL_RGBA32F, GL_RGBA32F, GL_RGBA32F};

  Accumulator(const glm::ivec2& tile, int cells)
      : tile_size(tile),
        grid(cells),
        samples(tile.x * cells, tile.y * cells, sample_format, true),
        sums(tile.x, tile.y, sum_formats, false) {}

  void clear() const {
    constexpr std::array<float, 4> nothing{};
    gl::api().BindFramebuffer(GL_FRAMEBUFFER, sums.framebuffer());
    for (GLint i = 0; i < static_cast<GLint>(sum_formats.size()); ++i)
      gl::api().ClearBufferfv(GL_COLOR, i, nothing.data());
  }

  glm::ivec2 tile_size;
  int grid;
  gl::RenderTarget samples;
  gl::RenderTarget sums;  // mean and count, squares, mean and count of the even passes
};

Supersampler::Supersampler(const gl::ContextInfo& context, GpuScene& scene, const GpuMethod& method,
                           ReferenceFilter filter, bool orthographic, int tile_edge)
    : scene_(&scene),
      method_(&method),
      tile_edge_(std::min(tile_edge > 0 ? tile_edge : default_tile_edge, context.max_framebuffer_size / 4)),
      program_(scene, method.baked(), settings_of(filter, orthographic)),
      resolve_("resolve samples", resolve_shader()) {}

Supersampler::Supersampler(Supersampler&&) noexcept = default;
Supersampler::~Supersampler() = default;

const Supersampler::Accumulator& Supersampler::accumulator(const glm::ivec2& tile_size, int grid) const {
  if (!accumulator_ || accumulator_->tile_size != tile_size || accumulator_->grid != grid) {
    accumulator_ = std::make_unique<Accumulator>(tile_size, grid);
  }
  return *accumulator_;
}

void Supersampler::accumulate(const View& view, const Tile& tile, const SampleGrid& samples, std::uint64_t seed,
                              std::size_t pass) const {
  const Accumulator& sums = *accumulator_;
  const glm::ivec2 size = tile.size * samples.grid;
  gl::api().BindFramebuffer(GL_FRAMEBUFFER, sums.samples.framebuffer());
  gl::api().Viewport(0, 0, size.x, size.y);
  clear_target();
  program_.set_sample(tile.origin * samples.grid, static_cast<std::uint32_t>(seed ^ (seed >> 32U)),
                      static_cast<std::uint32_t>(pass));
  program_.draw(*scene_, *method_, view,
                tile_matrix(view, tile, samples.offsets[pass] / static_cast<double>(samples.grid)));

  gl::api().UseProgram(resolve_.name());
  gl::api().Uniform1i(resolve_.uniform("grid"), samples.grid);
  gl::api().Uniform2i(resolve_.uniform("pixels"), tile.size.x, tile.size.y);
  gl::api().Uniform1i(resolve_.uniform("even_pass"), pass % 2 == 0 ? 1 : 0);
  for (GLuint i = 0; i < Accumulator::sum_formats.size(); ++i) {
    gl::api().BindImageTexture(i, sums.sums.color(i).name(), 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
  }
  gl::api().BindTextureUnit(0, sums.samples.color(0).name());
  gl::api().BindSampler(0, 0);
  gl::api().MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  const auto groups = [](int pixels) { return (static_cast<GLuint>(pixels) + resolve_group - 1) / resolve_group; };
  gl::api().DispatchCompute(groups(tile.size.x), groups(tile.size.y), 1);
  gl::api().MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
}

void Supersampler::draw(const View& view, int spp, std::uint64_t seed) const {
  const SampleGrid samples = sample_grid(spp, seed);
  for (const Tile& tile : tiles_of(view.size, tile_edge_)) {
    accumulator(glm::min(view.size, glm::ivec2(tile_edge_)), samples.grid).clear();
    for (std::size_t pass = 0; pass < samples.offsets.size(); ++pass) accumulate(view, tile, samples, seed, pass);
  }
}

Supersampled Supersampler::render(const View& view, int spp, std::uint64_t seed, const Progress& progress) const {
  const SampleGrid samples = sample_grid(spp, seed);
  const std::vector<Tile> tiles = tiles_of(view.size, tile_edge_);
  const auto steps = static_cast<double>(tiles.size() * samples.offsets.size());
  Image mean(view.size.x, view.size.y, 4);
  Image squares(view.size.x, view.size.y, 4);
  Image half(view.size.x, view.size.y, 4);
  double done = 0;
  for (const Tile& tile : tiles) {
    const Accumulator& sums = accumulator(glm::min(view.size, glm::ivec2(tile_edge_)), samples.grid);
    sums.clear();
    for (std::size_t pass = 0; pass < samples.offsets.size(); ++pass) {
      progress(fmt::format("{} samples a pixel", spp), done++ / steps);
      accumulate(view, tile, samples, seed, pass);
    }
    read_tile(sums.sums, 0, tile, mean);
    read_tile(sums.sums, 1, tile, squares);
    read_tile(sums.sums, 2, tile, half);
  }
  Supersampled out{.spp = spp, .mean = {}, .standard_error = standard_error_of(squares, mean), .halves = {}};
  if (samples.offsets.size() >= 2) {
    Image other = complement(mean, half);
    const std::size_t even_passes = (samples.offsets.size() + 1) / 2;
    const double even_samples = static_cast<double>(even_passes) * samples.grid * samples.grid;
    scale_alpha(half, even_samples);
    scale_alpha(other, spp - even_samples);
    out.halves.emplace(std::move(half), std::move(other));
  }
  scale_alpha(mean, spp);
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
