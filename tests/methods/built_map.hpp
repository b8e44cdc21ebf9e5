// Test support for `xu_vmf`: a material with its map, built by the method's own passes, and the lobes in its shader.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/bake/method.hpp"
#include "renderer/pipeline/gpu_scene.hpp"
#include "renderer/pipeline/shader_source.hpp"
#include "renderer/pipeline/view.hpp"

namespace footprint {

const Method& xu_vmf_method();

namespace testing {

using Words = std::map<std::string, std::string>;
using ProbeInputs = std::vector<std::array<glm::vec4, 3>>;

/// One lobe of the mixture over the whole map.
struct MapLobe {
  double share;
  glm::dvec3 mean;
  double kappa;
};

/// The square of tests/support/test_scenes.hpp with Blinn-Phong lobes.
[[nodiscard]] Scene blinn_phong_square(const Image& normals, float exponent);

/// The square with Blinn-Phong lobes from a roughness map.
[[nodiscard]] Scene rough_square(const Image& normals, const Image& roughness);

[[nodiscard]] glm::mat3 turn(double degrees, const glm::vec3& axis);

/// Turns a scene's meshes about the origin.
void turn_meshes(Scene& scene, const glm::mat3& by);

/// The map of a scene's first material.
class BuiltMap {
 public:
  explicit BuiltMap(const Scene& scene, const Words& words = {});

  /// Builds again for the camera of another map's scene, with its triangles and constants.
  void build_for(const BuiltMap& other) const;

  [[nodiscard]] const Prefiltered& baked() const { return baked_; }

  /// One level of a texture, its layers below each other.
  [[nodiscard]] Image level(std::string_view name, std::size_t index) const;

  /// Evaluates the GLSL statements `body` for each input; `e` is the Effective of the whole map.
  [[nodiscard]] std::vector<glm::vec4> probe(const std::string& body, const ProbeInputs& inputs) const;

  [[nodiscard]] std::vector<MapLobe> lobes() const;
  [[nodiscard]] std::vector<double> densities(const std::vector<glm::dvec3>& directions) const;
  /// The integral of the density over the upper hemisphere.
  [[nodiscard]] double energy() const;
  [[nodiscard]] double energy_over_sphere() const;

 private:
  [[nodiscard]] std::string shader_text() const;
  [[nodiscard]] double energy_over(const std::vector<glm::dvec3>& hemisphere) const;

  Scene values_;
  Options options_;
  ShaderVariant variant_;
  GpuScene scene_;
  Prefiltered baked_;
  std::unique_ptr<FrameBuild> build_;
  gl::Buffer surface_coordinates_;
  gl::VertexArray vertex_array_;
  std::vector<GpuTexture> textures_;
  mutable SamplerCache samplers_;
};

/// 1 - |r| of a von Mises-Fisher lobe of width `kappa`: the root of equation 9, by bisection in double precision.
[[nodiscard]] double shortfall_twin(double kappa);

}  // namespace testing
}  // namespace footprint
