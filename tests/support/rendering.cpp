// One EGL context for all tests of a program, and one bake and program for all images of a method and scene.
#include "tests/support/rendering.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/image/metrics.hpp"
#include "renderer/pipeline/base_surface.hpp"
#include "renderer/scene/assembly/load_scene.hpp"

namespace footprint::testing {

const gl::Context& shared_context() {
  static const gl::Context context({.backend = gl::Backend::egl, .device = 0});
  context.make_current();
  return context;
}

// A method on the GPU, and the programs of its frames.
struct TestRenderer::Prepared {
  struct Key {
    FootprintFilter filter;
    int tile;
    EnvironmentUse environment;

    friend bool operator==(const Key&, const Key&) = default;
  };

  Prepared(const GpuScene& scene, BakedMethod bake_result) : baked(std::move(bake_result)), gpu(scene, baked) {}

  BakedMethod baked;
  GpuMethod gpu;
  std::vector<std::pair<Key, std::unique_ptr<FrameRenderer>>> frames;
};

TestRenderer::TestRenderer(const Scene& scene, const glm::ivec2& size, std::optional<EffectSet> effects,
                           const gl::Context& context)
    : context_(&context),
      size_(size),
      effects_(effects.value_or(effects_on(derive_effects(scene)))),
      scene_(refined_for_visibility(scene, effects_)),
      gpu_scene_(context.info(), scene_, effects_) {}

BakedMethod TestRenderer::baked(const Method& method, const std::string& text) const {
  const MethodSpec spec = parse_methods(text.empty() ? method.info.name : text).front();
  return bake(method, spec, scene_, effects_, no_progress);
}

TestRenderer::Prepared& TestRenderer::prepared(const Method& method, const std::string& text) {
  std::shared_ptr<Prepared>& found = prepared_[{&method, text}];
  if (!found) found = std::make_shared<Prepared>(gpu_scene_, baked(method, text));
  return *found;
}

const FrameRenderer& TestRenderer::frames(const Method& method, const std::string& text, const FootprintFilter& filter,
                                          int tile, EnvironmentUse environment) {
  Prepared& drawn = prepared(method, text);
  const Prepared::Key key{filter, tile, environment};
  auto found = std::ranges::find(drawn.frames, key, [](const auto& frames) { return frames.first; });
  if (found == drawn.frames.end()) {
    const ShaderVariant wanted{
        .footprint = filter, .orthographic = scene_.camera.orthographic, .environment = environment};
    drawn.frames.emplace_back(
        key, std::make_unique<FrameRenderer>(context_->info(), gpu_scene_, drawn.gpu, size_, wanted, tile));
    found = std::prev(drawn.frames.end());
  }
  return *found->second;
}

Image TestRenderer::frame(const Method& method, const std::string& text, const FootprintFilter& filter, int tile,
                          double distance, EnvironmentUse environment) {
  Image picture = frames(method, text, filter, tile, environment)
                      .render({.size = size_, .camera = camera_at_distance(scene_, distance)});
  context_->check("drawing a test frame");
  return picture;
}

Image TestRenderer::mean_frame(const Method& method, const std::string& text, const FootprintFilter& filter,
                               std::uint32_t count, std::uint64_t seed, int tile) {
  const FrameRenderer& drawn = frames(method, text, filter, tile, EnvironmentUse::sampled);
  Image picture(size_.x, size_.y, 4);
  std::vector<double> sums(picture.texels.size(), 0.0);
  for (std::uint32_t i = 0; i < count; ++i) {
    const Image frame = drawn.render({.size = size_, .camera = scene_.camera, .seed = seed, .frame = i});
    std::ranges::transform(frame.texels, sums, sums.begin(), [](float value, double sum) { return sum + value; });
  }
  context_->check("drawing a sequence of test frames");
  std::ranges::transform(sums, picture.texels.begin(), [&](double sum) { return static_cast<float>(sum / count); });
  return picture;
}

PixelWork TestRenderer::work(const Method& method, const std::string& text, const FootprintFilter& filter) {
  const GpuMethod& gpu = prepared(method, text).gpu;
  const FrameRenderer counting(
      context_->info(), gpu_scene_, gpu, size_,
      {.footprint = filter, .counting = Counting::work, .orthographic = scene_.camera.orthographic});
  return pixel_work(counting, {.size = size_, .camera = scene_.camera});
}

Supersampled TestRenderer::supersampled(const Method& method, int spp, std::uint64_t seed, Sampling filter, int tile,
                                        EnvironmentUse environment, TexelUse texels) {
  const Supersampler sampler(context_->info(), gpu_scene_, prepared(method, {}).gpu, filter, scene_.camera.orthographic,
                             tile, environment);
  Supersampled picture = sampler.render({.size = size_, .camera = scene_.camera}, spp, seed, no_progress, texels);
  context_->check("supersampling a test image");
  return picture;
}

Supersampled TestRenderer::reference(int spp, std::uint64_t seed, Sampling filter, int tile, EnvironmentUse environment,
                                     TexelUse texels) {
  return supersampled(base_surface(), spp, seed, filter, tile, environment, texels);
}

std::string TestRenderer::fragment_text(const Method& method) {
  return SurfaceProgram(gpu_scene_, baked(method, {}), {}).fragment_text();
}

void TestRenderer::update(const Scene& scene) {
  prepared_.clear();
  gpu_scene_.update(scene);
  scene_ = scene;
}

TestRenderer& shared_renderer(const std::string& key, const std::function<Scene()>& scene, const glm::ivec2& size) {
  (void)shared_context();  // outlives the renderers
  static std::map<std::string, std::unique_ptr<TestRenderer>> renderers;
  std::unique_ptr<TestRenderer>& found = renderers[key];
  if (!found) found = std::make_unique<TestRenderer>(scene(), size);
  return *found;
}

double largest_difference(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height || a.channels != b.channels)
    return std::numeric_limits<double>::infinity();
  double largest = 0;
  for (std::size_t i = 0; i < a.texels.size(); ++i) {
    const double difference = std::abs(static_cast<double>(a.texels[i]) - b.texels[i]);
    if (std::isnan(difference)) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, difference);
  }
  return largest;
}

double error_of(const Image& picture, const Image& reference) {
  return compare_images(picture, reference, 1.0F).value().relative_rmse;
}

FootprintFilter filter_of(const std::string& text) { return parse_footprint_filter(text, ""); }

double covered_mean(const Image& picture) {
  double sum = 0;
  double count = 0;
  for (std::size_t i = 0; i < picture.texels.size(); i += 4) {
    if (picture.texels[i + 3] < 1.0F) continue;
    sum += (picture.texels[i] + picture.texels[i + 1] + picture.texels[i + 2]) / 3.0;
    count += 1.0;
  }
  return sum / count;
}

}  // namespace footprint::testing
