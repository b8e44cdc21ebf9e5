// The passes that build the map of `xu_vmf`: join lobes at the finest level, split them into parts, and average.
#pragma once

#include <optional>

#include "renderer/bake/method.hpp"
#include "renderer/gl/objects.hpp"
#include "renderer/pipeline/gpu_scene.hpp"
#include "renderer/pipeline/shader_source.hpp"

namespace footprint::xu_vmf {

/// Texture names in the shaders.
inline constexpr std::string_view whole_name = "xu_vmf_whole", parts_name = "xu_vmf_parts";
inline constexpr std::string_view whole_guard_name = "xu_vmf_whole_guard", parts_guard_name = "xu_vmf_parts_guard";
inline constexpr std::string_view normals_name = "xu_vmf_normals", variances_name = "xu_vmf_variances";
inline constexpr std::string_view table_name = "xu_vmf_shortfalls", colours_name = "xu_vmf_colours";

/// The scalar that says whether a material's map is in camera space: 1 or 0.
inline constexpr std::string_view camera_space_name = "xu_vmf_in_camera_space";

/// How |r| is computed from kappa: by Newton's steps, or from one of two tables.
enum class Conversion { newton, table, published };

/// The options that the bake and the passes read.
struct Settings {
  bool adaptive;   ///< each footprint chooses its own number of parts
  int most_lobes;  ///< of a pixel, for one lobe of its facets: 1, 4 or 8 parts
  bool camera_space;
  Conversion conversion;
  bool joint;         ///< facets weigh by the luminance of their specular colour
  bool always_built;  ///< for every frame, otherwise only when an input has changed
  Storage storage;

  /// Layers of the parts' texture for one lobe of the facets: 0, 4 or 8 parts, or the tree of `adaptive`: the whole
  /// hemisphere, 4 parts and their 8 cells, in the order of xu_vmf_cells.glsl.
  [[nodiscard]] int part_layers() const { return adaptive ? 13 : most_lobes == 1 ? 0 : most_lobes; }

  /// Whether textures of guards accompany those of r. Half floats need them if 1 - |r| differs between texels.
  [[nodiscard]] bool has_guards(const EffectSet& effects) const {
    return storage == Storage::fp16 && has(effects, Effect::roughness_variation);
  }
};

[[nodiscard]] Settings settings_of(const Options& options);

/// The passes of one scene.
class InstantMap final : public FrameBuild {
 public:
  /// Compiles the passes for the options of the method, which become constants of the shaders.
  InstantMap(const ShaderVariant& variant, const Options& options);

  void run(const FrameBuildJob& job) const override;
  [[nodiscard]] bool looks_from_view() const override { return join_surface_.has_value(); }
  [[nodiscard]] std::optional<BuildInputs> valid_until_change_of() const override;

 private:
  // A framebuffer of `layers` attachments, and the program that draws a level of as many layers from the finer one.
  struct Stage {
    gl::Framebuffer framebuffer;
    gl::Program coarsen;
    GLuint layers = 0;
    GLuint averaged = 0;  // of the layers; each of the others is a sum of two of these
  };
  // A draw of a level of `size` into the finest level of a texture.
  struct LevelDraw {
    const gl::Program& program;
    double lookups;  // per pixel
    const gl::Texture& target;
    glm::ivec2 size;
    int first_layer;
  };

  void join(const FrameBuildJob& job) const;
  void prepare_join(const FrameBuildJob& job, const gl::Program& program, bool camera) const;
  void split(const FrameBuildJob& job, const gl::Program& program, std::string_view from, std::string_view to) const;
  void coarsen(const FrameBuildJob& job, std::string_view name) const;
  void draw_into(const FrameBuildJob& job, const Stage& stage, const LevelDraw& draw) const;
  const gl::Texture& room_for(const gl::Texture& like, const glm::ivec2& size, int layers) const;

  Settings settings_;
  EffectSet effects_;
  int parts_;      // layers for each lobe of the facets
  int first_cut_;  // the first of them that is a part of the hemisphere
  bool guards_;
  gl::ScreenTriangle triangle_;
  gl::Framebuffer joined_;
  gl::Program join_flat_;
  std::optional<gl::Program> join_surface_, split_, split_guard_;
  Stage whole_, split_stage_;
  mutable SamplerCache samplers_;
  mutable gl::Texture drawn_;  // a level while it is drawn, as large as the largest so far
  mutable GLint drawn_format_ = 0;
  mutable int drawn_layers_ = 0;
};

}  // namespace footprint::xu_vmf
