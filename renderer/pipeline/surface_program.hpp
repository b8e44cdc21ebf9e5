// A method on the GPU: its textures for every material of a scene, and one program for one way of sampling.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/bake/baked_method.hpp"
#include "renderer/pipeline/bindings.hpp"
#include "renderer/pipeline/gpu_scene.hpp"
#include "renderer/pipeline/shader_source.hpp"
#include "renderer/pipeline/view.hpp"

namespace footprint {

/// Told the number of a texture that was uploaded.
using TextureUploaded = std::function<void(std::size_t texture)>;

/// A baked method's textures and scalars on the GPU, shared by its programs.
class GpuMethod {
 public:
  /// Uploads what was baked by now. What a frame build fills is empty until the first one.
  GpuMethod(const GpuScene& scene, const BakedMethod& baked);
  /// Uploads what was baked for one material since, and tells of each of its textures when that lies on the GPU.
  void upload_material(
      std::size_t material, const TextureUploaded& uploaded = [](std::size_t) {});
  /// Whether the method has a frame build, and whether a frame in which nothing moved keeps what was built before.
  [[nodiscard]] bool has_frame_build() const { return build_ != nullptr; }
  [[nodiscard]] bool keeps_builds() const { return build_ && build_->kept_until_change_of(); }
  /// Whether what is built depends on where the scene is seen from.
  [[nodiscard]] bool looks_from_view() const { return build_ && build_->looks_from_view(); }
  /// The textures of a material, in the order of what was baked; none where it has no triangle.
  [[nodiscard]] std::span<const GpuTexture> textures(std::size_t material) const;
  /// Runs the frame build of every material for a view, if there is one and what was last built does not serve it too.
  /// Leaves framebuffers, viewport, vertex array, depth test, culling and blending as they are.
  void build_frame(const View& view) const;
  /// Runs it whatever was built before.
  void rebuild(const View& view) const;
  /// The size of the largest map of a batch that is looked up as the normal map is: whose texels a sample tells apart.
  /// (1, 1) where there is none.
  [[nodiscard]] glm::ivec2 texels(const GpuBatch& batch) const;
  /// Binds textures (after the shared ones) and scalars of a batch.
  void bind(const GpuBatch& batch, GpuScene& scene, Lookup lookup) const;
  /// The triangles of a batch, with this method's surface coordinates where it has some.
  [[nodiscard]] GLuint vertex_array(const GpuBatch& batch) const;
  [[nodiscard]] const BakedMethod& baked() const { return *baked_; }

 private:
  struct PerBatch {
    std::vector<GpuTexture> textures;
    gl::Buffer scalars, surface_coordinates;
    gl::VertexArray vertex_array;
  };
  // What the last build was for.
  struct Built {
    Camera camera;
    SceneContent content;
  };
  [[nodiscard]] const PerBatch& part_of(const GpuBatch& batch) const;
  [[nodiscard]] bool is_built_for(const View& view) const;

  const BakedMethod* baked_;
  const GpuScene* scene_;
  SharedUploads uploads_;
  std::vector<PerBatch> batches_;
  std::unique_ptr<FrameBuild> build_;
  mutable std::optional<Built> built_;
};

/// How the samplers of a frame look up. Errors (machine): they have no such filter.
[[nodiscard]] Lookup frame_lookup(const FootprintFilter& filter, const gl::ContextInfo& context);

/// What one sample of a texel shades where a filter blends four.
enum class TexelUse {
  drawn,     ///< one of them, drawn with the filter's weights
  filtered,  ///< all four, their radiances weighed; one where texels are cut out or hold facets of their own
};

/// The samples that one draw takes.
struct SampleDraw {
  glm::ivec2 origin{0};     ///< of the tile in the whole picture's sample grid
  int grid = 1;             ///< samples a pixel each way, 1 to 4
  std::uint32_t seed = 0;   ///< of the sequence, for this picture
  std::uint32_t first = 0;  ///< the number in it of a pixel's first sample
  TexelUse texels = TexelUse::drawn;
};

/// How a program samples, and what the scene's camera asks of it.
struct ProgramSettings {
  Sampling sampling = Sampling::frame;
  Lookup lookup = Lookup::trilinear;  ///< of samples; that of a frame follows from its footprint filter
  FootprintFilter footprint{};        ///< of a frame
  bool counting = false;              ///< writes texture lookups and lobe evaluations a pixel, in place of radiance
  bool orthographic = false;
  EnvironmentUse environment = EnvironmentUse::sampled;  ///< dense for all; sampled: of a module that draws directions
};

/// One compiled forward pass.
class SurfaceProgram {
 public:
  /// Makes what the scene's environment lacks for it. Errors (machine): the module does not compile (the log names its
  /// lines); those of TextureUnits.
  SurfaceProgram(GpuScene& scene, const BakedMethod& baked, const ProgramSettings& settings);

  /// Draws the scene into the bound framebuffer, whose viewport is the tile's (times the sample grid). Other programs
  /// than Sampling::frame's draw the samples that `set_samples` was told last.
  void draw(GpuScene& scene, const GpuMethod& method, const View& view, const glm::mat4& world_to_clip) const;

  /// Sets what samples draw from. Not for Sampling::frame.
  void set_samples(const SampleDraw& samples);

  [[nodiscard]] const std::string& fragment_text() const { return fragment_.text(); }

 private:
  void set_directions(const SampleDraw& samples) const;
  void set_digits(const char* directions, const char* choices, std::span<const std::uint32_t> indices) const;
  [[nodiscard]] glm::vec3 drawn_texels(const GpuMethod& method, const GpuBatch& batch) const;

  ProgramSettings settings_;
  bool environment_light_;
  EnvironmentUse environment_;
  EffectSet effects_;  // of the scene
  TexelUse texels_ = TexelUse::drawn;
  TextureUnits units_;
  ShaderText fragment_;
  gl::Program program_;
};

}  // namespace footprint
