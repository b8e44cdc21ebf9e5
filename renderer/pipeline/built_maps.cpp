// One build for the scene's own camera, which it must not depend on, and each level of each texture read back.
#include "renderer/pipeline/built_maps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "renderer/core/error.hpp"
#include "renderer/pipeline/gpu_scene.hpp"
#include "renderer/pipeline/surface_program.hpp"
#include "renderer/pipeline/view.hpp"

namespace footprint {
namespace {

bool waits(const Prefiltered& prefiltered) {
  return std::ranges::any_of(prefiltered.textures, &PrefilteredTexture::built);
}

void take(std::span<const GpuTexture> from, Prefiltered& into) {
  if (from.empty()) into.textures.clear();
  for (std::size_t i = 0; i < into.textures.size(); ++i) {
    if (into.textures[i].built) read_texels(*from[i].texture, into.textures[i]);
  }
}

}  // namespace

bool waits_for_build(const BakedMethod& baked) { return std::ranges::any_of(baked.materials, waits); }

void take_built_maps(const gl::Context& context, const Scene& scene, const EffectSet& effects, BakedMethod& baked) {
  GpuScene gpu_scene(context.info(), scene, effects);
  const GpuMethod gpu(gpu_scene, baked);
  if (gpu.looks_from_view()) {
    throw Error(ErrorKind::usage, fmt::format("method {}", baked.spec.text),
                "builds its maps for each view, so they cannot be written to files",
                "take options whose maps serve every view (of xu_vmf space=tangent), or another method");
  }
  gpu.rebuild({.size = glm::ivec2(1), .camera = scene.camera});
  for (std::size_t i = 0; i < baked.materials.size(); ++i) take(gpu.textures(i), baked.materials[i]);
  context.check("reading what a frame build wrote");
}

}  // namespace footprint
