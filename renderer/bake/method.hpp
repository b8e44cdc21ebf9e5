// The interface of a prefiltering method, which is all that the pipeline knows of it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderer/bake/frame_build.hpp"
#include "renderer/bake/prefiltered.hpp"
#include "renderer/bake/shader_module.hpp"
#include "renderer/core/options.hpp"
#include "renderer/core/progress.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint {

struct ShaderVariant;

/// The description of a method, which `list`, --help, the reports and the docs read.
struct MethodInfo {
  std::string name;     ///< as on the command line
  std::string summary;  ///< one sentence
  std::string paper;    ///< author, year, title
  std::vector<OptionSpec> options;
  EffectSet honours;  ///< effects that it simulates; others are left out, and tables say so
  /// Whether the module receives the changes of frame and half vector to the next pixels (renderer/shaders/README.md).
  /// Other modules pay nothing for it.
  bool screen_derivatives = false;
  bool reads_finest_level = false;  ///< frames are not filtered; clear coats are read at their finest level, too
  bool draws_directions = false;    ///< the module itself integrates an environment under many samples
  bool lobes_as_given = false;      ///< its option `storage` does not round lobes (storage_range.hpp)
  bool sums_environment = false;    ///< the module sums the environment light of frames (`environmentSum`)
  bool slow_precompute = false;     ///< seconds, not milliseconds: cached on disk between runs (bake_cache.hpp)
  /// Whether the bake of a texel of a level depends only on the normal map's texels under it. Then a part of a map can
  /// be baked on its own (renderer/ndf/footprint_part.hpp).
  bool bakes_by_texel = false;
  /// Seconds per frame, not milliseconds: a bound for other methods. `all` excludes these.
  bool slow_frame = false;
  /// Whether it shows the texels of a map where they are large on screen. False for one effective BRDF of the whole
  /// material, which is right if a pixel shows the whole map.
  bool resolves_texels = true;
};

/// A prefiltering method: a pure precompute, a GLSL module and optionally a frame build (docs/adding-a-method.md).
/// Stateless.
class Method {
 public:
  Method() = default;
  Method(const Method&) = delete;
  Method& operator=(const Method&) = delete;
  virtual ~Method() = default;

  [[nodiscard]] virtual const MethodInfo& info() const = 0;

  /// Bakes one material for a scene with `effects`; makes no textures of other effects. Pure: equal arguments give
  /// equal values at any number of threads. Long work reports progress, which may throw Error{interrupted}. Names,
  /// channels and storage of textures and names of scalars depend only on options and effects, so that one program
  /// serves every material of a scene.
  [[nodiscard]] virtual Prefiltered precompute(const Material& material, const Options& options,
                                               const EffectSet& effects, const Progress& progress) const = 0;

  /// The same for a material of `scene`, if the bake depends on its triangles. Bakes are cached by the material only,
  /// so a method that overrides this must not be `slow_precompute`.
  [[nodiscard]] virtual Prefiltered precompute_on(const Scene& scene, std::size_t material, const Options& options,
                                                  const EffectSet& effects, const Progress& progress) const {
    return precompute(scene.materials.at(material), options, effects, progress);
  }

  /// The passes of each frame, for a scene whose effects (as far as the method honours them) and base BRDF `variant`
  /// has; null without any. A context is current. Errors (machine): a pass does not compile.
  [[nodiscard]] virtual std::unique_ptr<FrameBuild> frame_build(const ShaderVariant& /*variant*/,
                                                                const Options& /*options*/) const {
    return nullptr;
  }

  /// For methods that imitate engine importers: the perceptual roughness of every texel and level of a normal map's mip
  /// chain, one channel, 0 to 1, for use with the renormalised mean normal. None for other methods and for materials
  /// without a normal map. Errors (usage): a roughness map without a texel for each texel of the normal map.
  [[nodiscard]] virtual std::optional<std::vector<Image>> roughness_mips(const Material& /*material*/,
                                                                         const Options& /*options*/) const {
    return {};
  }

  /// Lobes of the effective NDF that the shader evaluates per pixel with isotropic filtering.
  [[nodiscard]] virtual int lobe_count(const Options& /*options*/) const { return 1; }

  /// The GLSL module that evaluates the effective BRDF (renderer/shaders/README.md gives its contract).
  [[nodiscard]] virtual ShaderModule shader() const = 0;
};

}  // namespace footprint
