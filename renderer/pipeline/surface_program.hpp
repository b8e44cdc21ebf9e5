// A method on the GPU: its textures for every material of a scene, its frame build, and a program for each way of
// sampling.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/bake/baked_method.hpp"
#include "renderer/core/process.hpp"
#include "renderer/gl/context.hpp"
#include "renderer/gl/functions.hpp"
#include "renderer/pipeline/gpu_scene.hpp"
#include "renderer/pipeline/recorded_draws.hpp"
#include "renderer/pipeline/shader_source.hpp"
#include "renderer/pipeline/view.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint {

/// The arguments of FrameBuild::run: one material on the GPU.
struct FrameBuildJob {
  const GpuBatch& batch;                 ///< the material's block, and whether its triangles are double-sided
  GLuint vertex_array;                   ///< its triangles, with surface coordinates if the method has some
  const Prefiltered& baked;              ///< the result of the precompute
  std::span<const GpuTexture> textures;  ///< the textures of `baked`, in its order
  const View& view;                      ///< to be drawn
  RecordedDraws* record = nullptr;       ///< of draw_recorded and record_copy
};

/// Called with the number of a texture when it was uploaded.
using TextureUploaded = std::function<void(std::size_t texture)>;

/// A baked method's textures and values on the GPU, shared by its programs.
class GpuMethod {
 public:
  /// Uploads the materials that are baked by now. Textures of a frame build are empty until the first build. Given maps
  /// (BakedMethod::given_by) have no frame build.
  GpuMethod(const GpuScene& scene, const BakedMethod& baked);
  /// Uploads a material that was baked since.
  void upload_material(
      std::size_t material, const TextureUploaded& uploaded = [](std::size_t) {});
  [[nodiscard]] bool has_frame_build() const { return build_ != nullptr; }
  /// Whether a frame in which nothing changed reuses the last build.
  [[nodiscard]] bool reuses_build() const { return build_ && build_->valid_until_change_of(); }
  /// Whether the build depends on the view.
  [[nodiscard]] bool looks_from_view() const { return build_ && build_->looks_from_view(); }
  /// The textures of a material in the order of its bake; empty if it has no triangle.
  [[nodiscard]] std::span<const GpuTexture> textures(std::size_t material) const;
  /// Runs the frame build of every material, unless there is none or the last one is valid for this view too.
  /// Preserves framebuffers, viewport, vertex array, depth test, culling and blending.
  void build_frame(const View& view) const;
  /// Runs the frame build even if the last one is valid.
  /// record: receives its draws and copies, unless it is null.
  void rebuild(const View& view, RecordedDraws* record = nullptr) const;
  /// The draws and copies of the frame build that every frame repeats, which it runs for them. Empty without a build,
  /// and for one that frames reuse (reuses_build).
  [[nodiscard]] RecordedDraws draws_per_frame(const View& view) const;
  /// The size of a batch's largest map with the normal map's coordinates: samples of the reference separate its texels.
  /// (1, 1) without such a map.
  [[nodiscard]] glm::ivec2 texels(const GpuBatch& batch) const;
  /// Binds the shared textures of a batch, then the method's own, and its values.
  void bind(const GpuBatch& batch, GpuScene& scene, SamplerState state) const;
  /// The triangles of a batch, with this method's surface coordinates if it has some.
  [[nodiscard]] GLuint vertex_array(const GpuBatch& batch) const;
  [[nodiscard]] const BakedMethod& baked() const { return *baked_; }

 private:
  struct PerBatch {
    std::vector<GpuTexture> textures;
    gl::Buffer block, surface_coordinates;
    gl::VertexArray vertex_array;
  };
  // The inputs of the last build.
  struct Built {
    Camera camera;
    SceneContent content;
  };
  [[nodiscard]] bool is_built_for(const View& view) const;

  const BakedMethod* baked_;
  const GpuScene* scene_;
  SharedUploads uploads_;
  std::vector<PerBatch> batches_;
  std::unique_ptr<FrameBuild> build_;
  mutable std::optional<Built> built_;
};

/// The sampler state of a frame. Throws Error (machine): the samplers have no such filter.
[[nodiscard]] SamplerState frame_sampler_state(const FootprintFilter& filter, const gl::ContextInfo& context);

/// Which texels one sample shades if a filter blends four.
enum class TexelUse {
  drawn,     ///< one, drawn with the filter's weights
  filtered,  ///< all four, then the weighted mean of their radiance; one if texels are cut out or have facets
};

/// The samples of one draw.
struct SampleDraw {
  glm::ivec2 origin{0};     ///< of the tile in the whole image's sample grid
  int grid = 1;             ///< samples along a pixel's edge, 1 to 4
  std::uint32_t seed = 0;   ///< of the sequence, for this image
  std::uint32_t first = 0;  ///< the number in the sequence of a pixel's first sample
  int draws = 1;            ///< per sample, of a stochastic footprint
  TexelUse texels = TexelUse::drawn;
};

/// The texts of a forward pass, not compiled yet.
struct ForwardProgram {
  ShaderVariant variant;
  TextureUnits units;
  ForwardShaders shaders;
};

/// The forward pass of a method over a scene.
/// wanted: sampling, footprint, counting, fixed trips, kind of camera, and environment (`sampled` only for modules that
/// draw directions). The other members follow from scene and method.
/// Throws Error (machine): as TextureUnits::require_room.
[[nodiscard]] ForwardProgram forward_program(const GpuScene& scene, const BakedMethod& baked, ShaderVariant wanted);

/// The longest that a method from a file may take to compile, and to draw its first 2^20 samples.
inline constexpr std::chrono::seconds file_method_limit{60};

/// Ends the program if a method from a file takes too long for `work`, or all memory. None for other methods.
/// factor: on file_method_limit.
[[nodiscard]] std::optional<DriverWatch> watch_over(const BakedMethod& baked, std::string_view work, int factor = 1);

/// A program around a method's module. Throws Error: it does not compile (machine), with the compiler's log and the
/// lines that it names; of a method from a file (usage), in the place FILE:LINE; with given maps (usage), in the place
/// of their folder.
[[nodiscard]] gl::Program method_program(const BakedMethod& baked, std::string_view name, std::string_view vertex,
                                         const ShaderText& fragment);

/// One compiled forward pass.
class SurfaceProgram {
 public:
  /// Prepares the scene's environment for this program.
  /// wanted: as for forward_program.
  /// Throws Error (machine): the module does not compile (the log names its lines); as TextureUnits.
  SurfaceProgram(GpuScene& scene, const BakedMethod& baked, const ShaderVariant& wanted);

  /// Draws the scene into the bound framebuffer. The viewport is the tile's, times the sample grid.
  /// samples: ignored with Sampling::frame, unless its footprint is stochastic.
  void draw(GpuScene& scene, const GpuMethod& method, const View& view, const glm::mat4& world_to_clip,
            const SampleDraw& samples = {}) const;

  [[nodiscard]] const std::string& fragment_text() const { return forward_.shaders.fragment.text(); }
  /// The textures that the last draw of this program bound, of the last material, by unit. No other
  /// program may have drawn since.
  [[nodiscard]] std::map<int, ReadTexture> bound_textures() const;

 private:
  void draw_batches(GpuScene& scene, const GpuMethod& method, const View& view, const glm::mat4& world_to_clip,
                    const SampleDraw& samples) const;
  void set_samples(const SampleDraw& samples) const;
  void set_directions(std::vector<std::uint32_t> points) const;
  void set_digits(const char* directions, const char* choices, std::span<const std::uint32_t> indices) const;
  [[nodiscard]] glm::vec3 drawn_texels(const GpuMethod& method, const GpuBatch& batch, TexelUse texels) const;

  ForwardProgram forward_;
  SamplerState sampler_state_;
  EffectSet scene_effects_;
  gl::Program program_;
  mutable bool has_drawn_ = false;
};

/// Whether textures of `baked` wait for a frame build.
[[nodiscard]] bool waits_for_build(const BakedMethod& baked);

/// Runs the frame build of `baked` and reads the result back into its textures, so that none is `built` afterwards. A
/// material without triangles loses its textures.
/// scene, effects: those that `baked` is for.
/// Throws Error (usage): the build depends on the view; as GpuScene.
void take_built_maps(const gl::Context& context, const Scene& scene, const EffectSet& effects, BakedMethod& baked);

}  // namespace footprint
