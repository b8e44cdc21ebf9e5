// How a prefiltering method plugs in. The pipeline knows nothing more of a method than this interface.
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

/// What a method says of itself: one table that feeds `list`, --help, the reports and the docs.
struct MethodInfo {
  std::string name;     ///< as on the command line
  std::string summary;  ///< one sentence
  std::string paper;    ///< author, year, title
  std::vector<OptionSpec> options;
  EffectSet honours;  ///< effects that it can simulate; others are left out, and the table says so
  /// The module is told how frame and half vector change to the next pixels (renderer/shaders/README.md). Others pay
  /// nothing for it.
  bool screen_derivatives = false;
  bool reads_finest_level = false;  ///< a frame filters nothing: clear coats are read at their finest level, too
  bool draws_directions = false;    ///< the module integrates an environment itself where many samples are taken
  bool lobes_as_given = false;      ///< its option `storage` rounds nothing that lobes are made of (storage_range.hpp)
  bool sums_environment = false;    ///< a frame's environment light is summed by the module (`environmentSum`)
  bool slow_precompute = false;     ///< seconds, not milliseconds: kept on disk between runs (bake_cache.hpp)
  /// What is baked into a texel of a level depends, of the normal map, on the texels under it alone: of a map of which
  /// one part is looked at, that part may be baked for itself (renderer/ndf/footprint_part.hpp).
  bool bakes_by_texel = false;
  /// Seconds a frame, not milliseconds: a bound to hold others against. `all` methods are all but these.
  bool slow_frame = false;
  /// Whether it shows a map's texels where they are large on screen. Not so: one effective BRDF for the whole material,
  /// which is right where the whole map lies in a pixel.
  bool resolves_texels = true;
};

/// A prefiltering method: a pure precompute, a GLSL module and, where it has one, a frame build
/// (docs/adding-a-method.md). Stateless.
class Method {
 public:
  Method() = default;
  Method(const Method&) = delete;
  Method& operator=(const Method&) = delete;
  virtual ~Method() = default;

  [[nodiscard]] virtual const MethodInfo& info() const = 0;

  /// Bakes one material, for a scene with `effects`: textures of effects that are off are not made. Pure: equal
  /// arguments give equal values, at any number of threads. Long work reports progress (which may throw
  /// Error{interrupted}). The textures' names, channels and storage and the scalars' names depend on options and
  /// effects alone, so that one program serves every material of a scene.
  [[nodiscard]] virtual Prefiltered precompute(const Material& material, const Options& options,
                                               const EffectSet& effects, const Progress& progress) const = 0;

  /// As `precompute`, for a material of `scene`: what depends on the triangles that it lies on. What is baked is kept
  /// on disk by the material alone: a method that overrides this must not be `slow_precompute`.
  [[nodiscard]] virtual Prefiltered precompute_on(const Scene& scene, std::size_t material, const Options& options,
                                                  const EffectSet& effects, const Progress& progress) const {
    return precompute(scene.materials.at(material), options, effects, progress);
  }

  /// The passes that are repeated each frame, for a scene whose effects (those that the method honours) and base BRDF
  /// `variant` has; null: there are none. A context is current. Errors (machine): a pass does not compile.
  [[nodiscard]] virtual std::unique_ptr<FrameBuild> frame_build(const ShaderVariant& /*variant*/,
                                                                const Options& /*options*/) const {
    return nullptr;
  }

  /// For a method that stands for what engines import: the perceptual roughness of every texel and level of a normal
  /// map's mip chain, one channel, 0 to 1, which goes beside the mean normal, renormalised. None of other methods, and
  /// of a material without a normal map. Errors (usage): a roughness map that has no texel for each of the normal
  /// map's.
  [[nodiscard]] virtual std::optional<std::vector<Image>> roughness_mips(const Material& /*material*/,
                                                                         const Options& /*options*/) const {
    return {};
  }

  /// Lobes of the effective NDF that the shader evaluates for a pixel, with isotropic filtering.
  [[nodiscard]] virtual int lobe_count(const Options& /*options*/) const { return 1; }

  /// The GLSL module that evaluates the effective BRDF (renderer/shaders/README.md gives its contract).
  [[nodiscard]] virtual ShaderModule shader() const = 0;
};

}  // namespace footprint
