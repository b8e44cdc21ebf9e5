// The interface of a prefiltering method. The pipeline knows nothing else of a method.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "renderer/bake/prefiltered.hpp"
#include "renderer/core/embedded_texts.hpp"
#include "renderer/core/options.hpp"
#include "renderer/core/progress.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint {

/// All known flags of shader texts, and whether each is on.
using ShaderFlags = std::map<std::string, bool, std::less<>>;

/// A text with directives (renderer/shaders/README.md): a method's module, or a pass of its frame build.
struct ShaderModule {
  std::string_view file;  ///< messages name it
  std::string_view text;
  EmbeddedTexts folder{};  ///< texts that it may include, next to the shared ones
  ShaderFlags flags{};     ///< further flags, next to those of scene, sampling and options
};

/// The module in a file of a folder. Throws std::logic_error if the folder has no such file.
[[nodiscard]] inline ShaderModule module_of(EmbeddedTexts folder, std::string_view file, ShaderFlags flags = {}) {
  const EmbeddedText* const found = find_text(folder, file);
  if (found == nullptr) throw std::logic_error("no text `" + std::string(file) + "` is embedded");
  return {found->file, found->text, folder, std::move(flags)};
}

struct FrameBuildJob;  // in renderer/pipeline/surface_program.hpp, because it names GL objects

/// The inputs of a frame build.
struct BuildInputs {
  bool camera = false, geometry = false, materials = false, lights = false;
};

/// The passes of a method's frame build, compiled for one scene. They draw or compute the textures that the precompute
/// declared with make_built_texture. A pass may change bindings (program, framebuffer, vertex array, texture and image
/// units, uniform blocks), viewport, depth test, culling and blending; GpuMethod restores these as far as needed. It
/// must not change other GL state.
class FrameBuild {
 public:
  FrameBuild() = default;
  FrameBuild(const FrameBuild&) = delete;
  FrameBuild& operator=(const FrameBuild&) = delete;
  virtual ~FrameBuild() = default;

  /// Issues the passes for one material, each draw by draw_recorded. The caller adds memory barriers before and after.
  virtual void run(const FrameBuildJob& job) const = 0;

  /// Whether the result depends on the view, so that it cannot be exported as a map of the material.
  [[nodiscard]] virtual bool looks_from_view() const { return true; }

  /// The inputs whose change invalidates a build. None: it runs for every frame.
  [[nodiscard]] virtual std::optional<BuildInputs> valid_until_change_of() const { return {}; }
};

struct ShaderVariant;

/// The description of a method, for `list`, --help, reports and documents.
struct MethodInfo {
  std::string name;     ///< as on the command line
  std::string summary;  ///< one sentence
  std::string paper;    ///< author, year, title
  std::vector<OptionSpec> options;
  EffectSet honours;  ///< effects that it can simulate; others are left out, and the table reports them
  /// The module receives screen-space differences of frame and half vector (renderer/shaders/README.md). They cost
  /// other methods nothing.
  bool screen_derivatives = false;
  bool reads_finest_level = false;  ///< a frame filters nothing: coats and stretches are of the finest level, too
  bool draws_directions = false;    ///< the module integrates an environment itself when it is supersampled
  bool lobes_as_given = false;      ///< its option `storage` does not round lobes (storage_range_note)
  bool sums_environment = false;    ///< the module sums a frame's environment light (`environmentSum`)
  bool slow_precompute = false;     ///< takes seconds, so bakes are cached on disk (baked_method.hpp)
  /// A baked texel depends only on the texels of the normal map under it, so that a part of a map may be baked alone
  /// (renderer/ndf/footprint_texels.hpp).
  bool bakes_by_texel = false;
  /// A frame takes seconds: an accuracy bound for other methods. `all` methods exclude it.
  bool slow_frame = false;
  /// Whether magnified texels are visible. If not, one effective BRDF represents the whole material, which is correct
  /// only if a pixel covers the whole map.
  bool resolves_texels = true;
};

/// A prefiltering method: a pure precompute, a GLSL module and an optional frame build (adding-a-method.md).
/// Its functions have no state. Each method exists once and is known by its address.
struct Method {
  MethodInfo info;

  /// Bakes one material. Pure: equal arguments give equal values, at any number of threads. The textures' names,
  /// channels and storage, and the names of values, depend only on options and effects, so that one program can draw
  /// all materials of a scene.
  /// effects: of the scene; textures of effects that are off are not created.
  /// progress: called during long work; may throw Error (interrupted).
  std::function<Prefiltered(const Material& material, const Options& options, const EffectSet& effects,
                            const Progress& progress)>
      precompute;

  /// The GLSL module that evaluates the effective BRDF (renderer/shaders/README.md).
  ShaderModule shader;

  /// Replaces `precompute` for bakes that depend on the material's triangles, unless it is empty. The disk cache uses
  /// only the material as its key, so a method that has it must not be `slow_precompute`.
  std::function<Prefiltered(const Scene& scene, std::size_t material, const Options& options, const EffectSet& effects,
                            const Progress& progress)>
      precompute_on = {};

  /// Bakes a material again after its base BRDF changed: its parameters or its table, not its maps. The result is that
  /// of `precompute`, which is used if it is empty. before: the bake with the BRDF before, of equal options and
  /// effects.
  std::function<Prefiltered(const Prefiltered& before, const Material& material, const Options& options,
                            const EffectSet& effects)>
      precompute_brdf = {};

  /// The passes that are repeated each frame; null if there are none. A context is current.
  /// variant: effects that the method honours, and base BRDF, of the scene.
  /// Throws Error (machine): a pass does not compile.
  std::function<std::unique_ptr<FrameBuild>(const ShaderVariant& variant, const Options& options)> frame_build =
      [](const ShaderVariant& /*variant*/, const Options& /*options*/) { return std::unique_ptr<FrameBuild>(); };

  /// For methods that model how engines import maps: the perceptual roughness for each level of the renormalised normal
  /// map, 0 to 1. One channel, or four with KHR_materials_anisotropy's direction (d + 1) / 2 and strength in front of
  /// it. None for other methods, and without a normal map. Throws Error (usage): one map cannot store it.
  std::function<std::optional<std::vector<Image>>(const Material& material, const Options& options)> roughness_mips =
      [](const Material& /*material*/, const Options& /*options*/) { return std::optional<std::vector<Image>>(); };

  /// The hash of a method's file and of the file's images, for keys of caches. Empty: a method of the program.
  std::string file_content = {};

  /// Lobes of the effective NDF that the shader evaluates per pixel, with isotropic filtering.
  std::function<int(const Options& options)> lobe_count = [](const Options& /*options*/) { return 1; };
};

}  // namespace footprint
