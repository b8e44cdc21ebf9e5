// The passes that build `xu_vmf`'s map: joined at the finest level, split into the parts of the hemisphere, averaged.
#pragma once

#include <array>
#include <optional>

#include "methods/xu_vmf/drawn_level.hpp"
#include "renderer/bake/method.hpp"
#include "renderer/gl/objects.hpp"
#include "renderer/pipeline/gpu_scene.hpp"
#include "renderer/pipeline/shader_source.hpp"

namespace footprint::xu_vmf {

/// Names of the textures, as the shader has them.
inline constexpr std::string_view whole_name = "xu_vmf_whole", parts_name = "xu_vmf_parts";
inline constexpr std::string_view whole_guard_name = "xu_vmf_whole_guard", parts_guard_name = "xu_vmf_parts_guard";
inline constexpr std::string_view normals_name = "xu_vmf_normals", variances_name = "xu_vmf_variances";
inline constexpr std::string_view table_name = "xu_vmf_shortfalls";
/// Layers of the whole hemisphere's texture: facets with one lobe have one; of others it has one for each of their
/// lobes, and one of normals alone.
[[nodiscard]] int whole_layers(const Material& material);

/// The scalar that tells whether a material's map has the camera's axes.
inline constexpr std::string_view camera_space_name = "xu_vmf_in_camera_space";

/// Lobes that a pixel can have of one of its facets': the whole hemisphere's, or one of each of 4 or 8 parts.
[[nodiscard]] int most_lobes(const Options& options);

/// Layers of the parts' texture for one of the facets' lobes: none, 4 or 8 parts, or the tree of `adaptive`: the whole
/// hemisphere, 4 parts and their 8 cells, as xu_vmf_cells.glsl numbers them.
[[nodiscard]] int part_count(const Options& options);

/// Whether a guard is kept beside r: in half floats, where 1 - |r| of the texels is not one for all.
[[nodiscard]] bool keeps_guard(const Options& options, const EffectSet& effects);

/// The passes of one scene.
class InstantMap final : public FrameBuild {
 public:
  InstantMap(const ShaderVariant& variant, const Options& options);

  void run(const FrameBuildJob& job) const override;
  [[nodiscard]] bool looks_from_view() const override { return join_surface_.has_value(); }
  [[nodiscard]] std::optional<BuildInputs> kept_until_change_of() const override;

 private:
  // A framebuffer with so many colour attachments, and what draws one level of as many layers from the finer one.
  struct Stage {
    gl::Framebuffer framebuffer;
    gl::Program coarsen;
    GLuint layers = 0;
  };

  void join(const FrameBuildJob& job) const;
  void prepare_join(const FrameBuildJob& job, const gl::Program& program, bool camera) const;
  void split(const FrameBuildJob& job) const;
  void split(const FrameBuildJob& job, const gl::Program& program, std::string_view from, std::string_view to) const;
  void coarsen(const FrameBuildJob& job, std::string_view name) const;
  void draw_into(const Stage& stage, const gl::Texture& target, const glm::ivec2& size, int first_layer) const;

  Options options_;
  EffectSet effects_;
  int parts_;  // layers of each of the facets' lobes, and the first of them that is a cut of the hemisphere
  int first_cut_;
  bool guards_;
  gl::VertexArray no_vertices_;
  gl::Framebuffer joined_;
  gl::Program join_flat_;
  std::optional<gl::Program> join_surface_, split_, split_guard_;
  Stage whole_, split_stage_;
  mutable SamplerCache samplers_;
  mutable DrawnLevel drawn_;
};

}  // namespace footprint::xu_vmf
