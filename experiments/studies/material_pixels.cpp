// Lambert surfaces whose green over red is the material's number: the light and the angle cancel.
#include "experiments/studies/material_pixels.hpp"

#include <cmath>
#include <utility>

#include "experiments/studies/stage.hpp"
#include "methods/registry.hpp"
#include "renderer/bake/material_maps.hpp"

namespace footprint {
namespace {

// What is cut out by alpha stays cut out.
std::optional<TextureMap> alpha_alone(const Material& material) {
  if (!material.alpha_cutoff || !material.base_color_map) return {};
  auto white = std::make_shared<Image>(material.base_color_map->image.decoded());
  for (std::size_t i = 0; i < white->texel_count(); ++i) std::fill_n(&white->texels[4 * i], 3, 1.0F);
  TextureMap map = *material.base_color_map;
  map.image = white;
  return map;
}

Material numbered(const Material& material, std::size_t number, std::size_t count) {
  Material plain;
  plain.name = material.name;
  plain.brdf = {.distribution = NormalDistribution::ggx,
                .geometry = GeometryTerm::none,
                .fresnel = FresnelTerm::none,
                .diffuse = true};
  plain.base_color = {1.0F, static_cast<float>(number + 1) / static_cast<float>(count), 0.0F, material.base_color.a};
  plain.dielectric_specular = glm::vec3(0.0F);
  plain.metallic = 0.0F;
  plain.base_color_map = alpha_alone(material);
  plain.share = material.share;
  plain.alpha_cutoff = material.alpha_cutoff;
  plain.double_sided = material.double_sided;
  return plain;
}

Scene numbered(Scene scene) {
  for (std::size_t i = 0; i < scene.materials.size(); ++i)
    scene.materials[i] = numbered(scene.materials[i], i, scene.materials.size());
  scene.environment.reset();
  scene.shadows.cast = false;
  scene.lights = {PointLight{}};
  return scene;
}

}  // namespace

MaterialFinder::MaterialFinder(const gl::ContextInfo& context, const Scene& scene, const glm::ivec2& size, int tile)
    : scene_(numbered(scene)) {
  const EffectSet effects = effects_on(derive_effects(scene_));
  gpu_scene_ = std::make_unique<GpuScene>(context, scene_, effects);
  const MethodSpec direct{.text = "direct", .name = "direct", .options = {}};
  baked_ = std::make_unique<BakedMethod>(bake(find_method("direct"), direct, scene_, effects, no_progress));
  gpu_ = std::make_unique<GpuMethod>(*gpu_scene_, *baked_);
  frames_ = std::make_unique<FrameRenderer>(context, *gpu_scene_, *gpu_, size, frame_program(scene_, {}), tile);
}

std::vector<Image> MaterialFinder::masks(const View& view, const Image& interior) {
  scene_.lights.front() =
      PointLight{.position = camera_position(view.camera), .intensity = glm::vec3(1.0F), .range = {}};
  gpu_scene_->update(scene_);
  const Image picture = frames_->render(view);
  const std::size_t count = scene_.materials.size();
  std::vector<Image> masks(count, Image(picture.width, picture.height, 1));
  for (std::size_t i = 0; i < picture.texel_count(); ++i) {
    const float red = picture.texels[4 * i], green = picture.texels[4 * i + 1];
    if (!(interior.texels[i] > 0.0F && red > 0.0F)) continue;
    const float number = green / red * static_cast<float>(count) - 1.0F;
    const float nearest = std::round(number);
    if (std::abs(number - nearest) < 0.01F && nearest >= 0.0F && nearest < static_cast<float>(count))
      masks[static_cast<std::size_t>(nearest)].texels[i] = 1.0F;
  }
  return masks;
}

}  // namespace footprint
