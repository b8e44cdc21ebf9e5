// Uploads the components as layers and their weights as vertex attributes.
#include "renderer/pipeline/gpu_visibility.hpp"

#include <array>

#include "renderer/pipeline/gpu_scene.hpp"
#include "renderer/visibility/subdivide.hpp"

namespace footprint {
namespace {

constexpr std::size_t vectors_a_vertex = 5;

}  // namespace

bool hides_environment(const EffectSet& effects) {
  return has(effects, Effect::environment_light) && has(effects, Effect::cast_shadow);
}

Scene refined_for_visibility(Scene scene, const EffectSet& effects) {
  const float longest = scene.bounds.radius() / visibility_edges_in_radius;
  if (!hides_environment(effects) || !(longest > 0.0F)) return scene;
  for (Mesh& mesh : scene.meshes) mesh = subdivided(mesh, longest);
  return scene;
}

GpuVisibility::GpuVisibility(const Scene& scene, const Environment& environment, const Progress& progress,
                             const DiskCache* cache)
    : field_(kept_visibility_field(scene, environment, cache, progress)),
      sampler_(gl::trilinear_sampler(GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE)) {
  std::vector<std::vector<Image>> chains;
  for (const Image& layer : field_.layers) chains.push_back({layer});
  const PrefilteredTexture maps = make_array_texture("visibility_maps", std::move(chains), Storage::fp32, {});
  maps_ = upload_texels(maps);
  for (const Mesh& mesh : scene.meshes) vertex_count_ += mesh.vertices.size();
  bytes_ = byte_count(maps) + vertex_count_ * vectors_a_vertex * sizeof(glm::vec4);
}

std::vector<glm::vec4> GpuVisibility::attributes(const Scene& scene, std::size_t material) const {
  std::vector<glm::vec4> values;
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    if (static_cast<std::size_t>(scene.meshes[i].material) != material) continue;
    for (const VertexVisibility& vertex : field_.meshes[i]) {
      const auto& w = vertex.weights;
      values.insert(values.end(), {{1.0F, w[0], w[1], w[2]},
                                   {w[3], w[4], w[5], w[6]},
                                   {w[7], w[8], w[9], w[10]},
                                   {w[11], w[12], w[13], w[14]},
                                   glm::vec4(vertex.diffuse_share, vertex.hidden)});
    }
  }
  return values;
}

void GpuVisibility::bind(GLuint unit) const {
  gl::api().BindTextureUnit(unit, maps_.name());
  gl::api().BindSampler(unit, sampler_.name());
}

}  // namespace footprint
