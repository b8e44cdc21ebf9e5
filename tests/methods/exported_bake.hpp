// A scene baked by a method, ready to be written to files.
#pragma once

#include <string>

#include "methods/registry.hpp"
#include "renderer/baked_files/baked_files.hpp"
#include "renderer/pipeline/surface_program.hpp"
#include "tests/support/rendering.hpp"

namespace footprint::testing {

/// The footprint filter of the modules that tests write.
inline constexpr FootprintFilter exported_filter{FootprintFilterKind::anisotropic, 8};

struct ExportedBake {
  /// text: the method with its options.
  ExportedBake(const Scene& of, const std::string& text)
      : scene(of),
        effects(effects_on(derive_effects(scene))),
        spec(parse_methods(text).front()),
        baked(bake(find_method(spec), spec, scene, effects, no_progress)) {
    if (waits_for_build(baked)) take_built_maps(shared_context(), scene, effects, baked);
  }

  [[nodiscard]] BakeToFiles files() const {
    return {.scene = scene, .baked = baked, .effects = effects, .footprint = exported_filter, .version = "0"};
  }

  Scene scene;
  EffectSet effects;
  MethodSpec spec;
  BakedMethod baked;
};

}  // namespace footprint::testing
