// Supersamples the scene with a method that reflects nothing, under no light.
#include "renderer/pipeline/emitted_light.hpp"

#include <algorithm>

namespace footprint {

extern const EmbeddedTexts shared_glsl;

namespace {

constexpr int samples_per_pixel = 64;

BakedMethod nothing_baked(const GpuScene& scene) {
  std::size_t materials = 0;
  for (const GpuBatch& batch : scene.batches()) materials = std::max(materials, batch.material + 1);
  BakedMethod baked = make_bake(emitted_surface(), {.text = "emitted light", .name = "emitted light", .options = {}});
  baked.materials.resize(materials);
  return baked;
}

}  // namespace

const Method& emitted_surface() {
  static const Method method{
      .info = {.name = "emitted light", .summary = {}, .paper = {}, .options = {}, .honours = {}},
      .precompute = [](const Material&, const Options&, const EffectSet&, const Progress&) { return Prefiltered(); },
      .shader = module_of(shared_glsl, "emitted_module.glsl")};
  return method;
}

EmittedLight::EmittedLight(GpuScene& scene) : scene_(&scene), baked_(nothing_baked(scene)), method_(scene, baked_) {}

const Image& EmittedLight::light_in(const View& view) {
  const bool known = drawn_ && drawn_->camera == view.camera && drawn_->content == scene_->content() &&
                     drawn_->light.width == view.size.x && drawn_->light.height == view.size.y;
  if (known) return drawn_->light;
  if (orthographic_ != view.camera.orthographic) {
    orthographic_ = view.camera.orthographic;
    sampler_.emplace(scene_->context(), *scene_, method_, Sampling::bilinear, *orthographic_);
  }
  constexpr std::uint64_t seed = 0;
  drawn_ = Drawn{view.camera, scene_->content(), sampler_->render_mean(view, samples_per_pixel, seed, no_progress)};
  return drawn_->light;
}

void EmittedLight::add_to(Image& picture, const View& view) {
  const Image& light = light_in(view);
  for (std::size_t i = 0; i < picture.texels.size(); i += 4) {
    if (picture.texels[i + 3] <= 0.0F) continue;
    for (std::size_t c = 0; c < 3; ++c) picture.texels[i + c] += light.texels[i + c];
  }
}

}  // namespace footprint
