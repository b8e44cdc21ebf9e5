// Draws tiles into one target and reads them back into the image.
#include "renderer/pipeline/frame.hpp"

#include <algorithm>
#include <array>

#include "renderer/pipeline/sample_sequence.hpp"

namespace footprint {
namespace {

constexpr int largest_tile = 4096;  // 256 MiB of radiance: more at once gains nothing
constexpr std::array<GLenum, 1> radiance_format{GL_RGBA32F};

int edge_of(const gl::ContextInfo& context, int wanted) {
  const int most = std::min(largest_tile, context.max_framebuffer_size);
  return wanted > 0 ? std::min(wanted, most) : most;
}

// The means of a counting frame over the pixels that the object covers wholly, and their number; 0 without one.
glm::dvec4 mean_counts(const Image& counts) {
  glm::dvec3 sum(0.0);
  double pixels = 0;
  for (std::size_t i = 0; i < counts.texels.size(); i += 4) {
    if (counts.texels[i + 3] < 1.0F) continue;
    sum += glm::dvec3(counts.texels[i], counts.texels[i + 1], counts.texels[i + 2]);
    ++pixels;
  }
  return {pixels > 0 ? sum / pixels : sum, pixels};
}

}  // namespace

FrameRenderer::FrameRenderer(const gl::ContextInfo& context, GpuScene& scene, const GpuMethod& method,
                             const glm::ivec2& size, const ShaderVariant& wanted, int tile_edge)
    : scene_(&scene),
      method_(&method),
      footprint_(wanted.footprint),
      counts_(wanted.counting != Counting::none),
      program_(scene, method.baked(), wanted),
      tiles_(tiles_of(size, edge_of(context, tile_edge))),
      target_(tiles_.front().size.x, tiles_.front().size.y, radiance_format, true) {}

void FrameRenderer::draw_tile(const View& view, const Tile& tile, const glm::dvec2& offset) const {
  gl::api().BindFramebuffer(GL_FRAMEBUFFER, target_.framebuffer());
  gl::api().Viewport(0, 0, tile.size.x, tile.size.y);
  clear_target();
  program_.draw(*scene_, *method_, view, tile_matrix(view, tile, offset),
                {.origin = tile.origin,
                 .seed = half_seed(view.seed, 0),
                 .first = view.frame * static_cast<std::uint32_t>(footprint_.count),
                 .draws = is_stochastic(footprint_) ? footprint_.count : 1});
}

void FrameRenderer::draw(const View& view, const glm::dvec2& offset) const {
  method_->build_frame(view);
  for (const Tile& tile : tiles_) draw_tile(view, tile, offset);
}

Image FrameRenderer::render(const View& view, const glm::dvec2& offset) const { return render(view, tiles_, offset); }

Image FrameRenderer::render(const View& view, std::span<const Tile> parts, const glm::dvec2& offset) const {
  method_->build_frame(view);
  Image picture(view.size.x, view.size.y, 4);
  for (const Tile& tile : parts) {
    draw_tile(view, tile, offset);
    read_tile(target_, 0, tile, picture);
  }
  add_emitted(picture, view);
  return picture;
}

void FrameRenderer::add_emitted(Image& picture, const View& view) const {
  if (!counts_) scene_->add_emitted(picture, view);
}

void read_tile(const gl::RenderTarget& target, std::size_t attachment, const Tile& tile, Image& picture) {
  const int channels = picture.channels;
  std::vector<float> texels(static_cast<std::size_t>(target.width()) * static_cast<std::size_t>(target.height()) *
                            static_cast<std::size_t>(channels));
  target.read(attachment, channels, texels);
  for (int y = 0; y < tile.size.y; ++y) {
    const auto row = texels.begin() + static_cast<std::ptrdiff_t>(y) * target.width() * channels;
    const int picture_y = picture.height - 1 - (tile.origin.y + y);
    std::copy_n(row, tile.size.x * channels, picture.at(tile.origin.x, picture_y).begin());
  }
}

void fit(gl::RenderTarget& target, const glm::ivec2& size, std::span<const GLenum> color_formats, bool depth) {
  if (target.width() != size.x || target.height() != size.y)
    target = gl::RenderTarget(size.x, size.y, color_formats, depth);
}

void clear_target() {
  constexpr std::array<float, 4> nothing{};
  constexpr float far_plane = 0.0F;  // reversed depth: tile_matrix
  gl::api().ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl::api().DepthMask(GL_TRUE);
  gl::api().ClearBufferfv(GL_COLOR, 0, nothing.data());
  gl::api().ClearBufferfv(GL_DEPTH, 0, &far_plane);
}

PixelWork pixel_work(const FrameRenderer& counting, const View& view) {
  const Image counts = counting.render(view);
  const glm::dvec4 means = mean_counts(counts);
  PixelWork work{.lookups = means.x, .lobes = means.y, .pixels = means.w};
  for (std::size_t i = 0; means.z > 0 && i < counts.texels.size(); i += 4) {
    if (counts.texels[i + 3] >= 1.0F) work.finest_areas.push_back(counts.texels[i + 2]);
  }
  return work;
}

PixelTrips pixel_trips(const FrameRenderer& counting, const View& view) {
  const glm::dvec4 means = mean_counts(counting.render(view));
  return {.probes = means.x, .lobes = means.y, .rounds = means.z};
}

}  // namespace footprint
