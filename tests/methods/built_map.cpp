// Builds maps with the passes of `xu_vmf` for that method's tests.
#include "tests/methods/built_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "renderer/pipeline/surface_program.hpp"
#include "tests/support/method_probe.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/shader_probe.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {

namespace {

constexpr BaseBrdf blinn_phong{NormalDistribution::blinn_phong, GeometryTerm::none, FresnelTerm::none, false};

// Also for a constant map, which a scene would not call for.
EffectSet effects_of_map(const Material& material) {
  EffectSet set;
  set.set(static_cast<std::size_t>(Effect::normal_variation));
  set.set(static_cast<std::size_t>(Effect::roughness_variation), width_map(material) != nullptr);
  set.set(static_cast<std::size_t>(Effect::specular_variation), material.specular_map.has_value());
  set.set(static_cast<std::size_t>(Effect::multi_lobe), !material.lobes.empty());
  set.set(static_cast<std::size_t>(Effect::masking_shadowing), material.brdf.geometry != GeometryTerm::none);
  return set;
}

// The remains of an earlier frame in a texture that the build fills.
void spoil(const GpuTexture& texture, const PrefilteredTexture& declared) {
  constexpr std::array<float, 4> anything{0.1F, -0.2F, 0.3F, 0.4F};
  for (std::size_t level = 0; level < declared.levels.size(); ++level) {
    gl::api().ClearTexImage(texture.texture->name(), static_cast<GLint>(level),
                            declared.channels == 4 ? GL_RGBA : GL_RED, GL_FLOAT, anything.data());
  }
}

}  // namespace

Scene blinn_phong_square(const Image& normals, float exponent) {
  Scene scene = square_scene(normals, {.brdf = blinn_phong});
  scene.materials[0].lobe_parameter = exponent;
  return scene;
}

Scene rough_square(const Image& normals, const Image& roughness) {
  Scene scene = square_scene(normals, {.brdf = blinn_phong});
  Image map(roughness.width, roughness.height, 2, 0.0F);  // roughness, metallic
  for (std::size_t i = 0; i < roughness.texels.size(); ++i) map.texels[2 * i] = roughness.texels[i];
  scene.materials[0].metallic_roughness_map = TextureMap{"roughness", std::make_shared<const Image>(map), {}};
  return scene;
}

glm::mat3 turn(double degrees, const glm::vec3& axis) {
  return glm::mat3(glm::rotate(glm::mat4(1.0F), static_cast<float>(glm::radians(degrees)), axis));
}

void turn_meshes(Scene& scene, const glm::mat3& by) {
  for (Mesh& mesh : scene.meshes) {
    for (Vertex& vertex : mesh.vertices) {
      vertex.position = by * vertex.position;
      vertex.normal = by * vertex.normal;
      vertex.tangent = glm::vec4(by * glm::vec3(vertex.tangent), vertex.tangent.w);
    }
  }
}

BuiltMap::BuiltMap(const Scene& scene, const Words& words)
    : values_(scene),
      options_(xu_vmf_method().info.options, words, "xu_vmf"),
      variant_{.effects = effects_of_map(scene.materials[0]), .brdf = scene.materials[0].brdf},
      scene_(shared_context().info(), scene, variant_.effects),
      baked_(xu_vmf_method().precompute_on(scene, 0, options_, variant_.effects, no_progress)),
      build_(xu_vmf_method().frame_build(variant_, options_)) {
  for (const PrefilteredTexture& texture : baked_.textures) {
    textures_.push_back(upload(texture));
    if (texture.built) spoil(textures_.back(), texture);
  }
  variant_.surface_coordinates = baked_.surface_coordinates.has_value();
  if (baked_.surface_coordinates)
    surface_coordinates_ = gl::Buffer(std::as_bytes(std::span(*baked_.surface_coordinates)));
  const GpuBatch& batch = scene_.batches().front();
  vertex_array_ = vertex_array(batch.vertices, batch.indices, &surface_coordinates_);
  build_for(*this);
}

void BuiltMap::build_for(const BuiltMap& other) const {
  constexpr GLbitfield all = GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT;
  const View view{.size = {8, 8}, .camera = other.values_.camera};
  gl::api().MemoryBarrier(all);
  build_->run({.batch = other.scene_.batches().front(),
               .vertex_array = other.vertex_array_.name(),
               .baked = baked_,
               .textures = textures_,
               .view = view});
  gl::api().MemoryBarrier(all | GL_TEXTURE_FETCH_BARRIER_BIT);
  shared_context().check("building a map");
}

Image BuiltMap::level(std::string_view name, std::size_t index) const {
  const auto found = std::ranges::find(baked_.textures, name, &PrefilteredTexture::name);
  if (found == baked_.textures.end()) return {};
  Image out(found->levels.at(index).width, found->levels.at(index).height * found->layers, found->channels);
  gl::api().GetTextureImage(textures_.at(static_cast<std::size_t>(found - baked_.textures.begin())).texture->name(),
                            static_cast<GLint>(index), found->channels == 4 ? GL_RGBA : GL_RED, GL_FLOAT,
                            static_cast<GLsizei>(out.texels.size() * sizeof(float)), out.texels.data());
  shared_context().check("reading a map");
  return out;
}

std::string BuiltMap::shader_text() const {
  std::string text;
  for (std::size_t unit = 0; unit < textures_.size(); ++unit) {
    const PrefilteredTexture& texture = baked_.textures[unit];
    text += fmt::format("layout(binding = {}) uniform sampler2D{} {};\n", unit, texture.layers > 0 ? "Array" : "",
                        texture.name);
  }
  for (const auto& [name, value] : baked_.scalars) text += fmt::format("const float {} = {:e};\n", name, value);
  text += fmt::format(
      "const vec4 lobe_cutoff = vec4({:e});\nconst float option_eps0 = {:e};\nconst float option_eps1 = {:e};\n",
      lobe_of(values_.materials[0]).parameter, options_.number("eps0"), options_.number("eps1"));
  return text + shared_functions(shader_flags(variant_, options_, baked_), xu_vmf_method().shader);
}

std::vector<glm::vec4> BuiltMap::probe(const std::string& body, const ProbeInputs& inputs) const {
  for (GLuint unit = 0; unit < textures_.size(); ++unit) {
    gl::api().BindTextureUnit(unit, textures_[unit].texture->name());
    gl::api().BindSampler(unit, samplers_.sampler(textures_[unit].coordinates, SamplerState::trilinear));
  }
  std::string setting =
      "Footprint whole_map = Footprint(vec2(0.5), vec2(1.0, 0.0), vec2(0.0, 1.0));\n"
      "Footprints footprints;\nfootprints.normal = whole_map;\nfootprints.roughness = whole_map;\n";
  if (variant_.surface_coordinates) setting += "footprints.surface = whole_map;\ntangent_to_camera = mat3(1.0);\n";
  std::vector<glm::vec4> out =
      evaluate_glsl(shader_text(), setting + "Effective e = effective(footprints);\n" + body, inputs);
  shared_context().check("probing a map");
  return out;
}

std::vector<MapLobe> BuiltMap::lobes() const {
  ProbeInputs inputs;
  for (int i = 0; i < 13; ++i) {
    for (const float what : {0.0F, 1.0F}) inputs.push_back({glm::vec4(static_cast<float>(i)), glm::vec4(what), {}});
  }
  const auto got = probe(
      "int i = int(a.x);\nif (i >= e.count) return vec4(0.0);\n"
      "Lobe lobe = lobeOf(lobes[i], weights[i]);\n"
      "return b.x == 0.0 ? vec4(lobe.mean, lobe.amount / amountsOf(e.covered)) : vec4(kappaOfLobe(lobe.base));",
      inputs);
  std::vector<MapLobe> lobes;
  for (std::size_t i = 0; i < got.size(); i += 2) {
    if (got[i].w > 0.0F) lobes.push_back({got[i].w, glm::dvec3(glm::vec3(got[i])), got[i + 1].x});
  }
  return lobes;
}

std::vector<double> BuiltMap::densities(const std::vector<glm::dvec3>& directions) const {
  ProbeInputs inputs;
  for (const glm::dvec3& h : directions) inputs.push_back({glm::vec4(glm::vec3(h), 0), glm::vec4(0), glm::vec4(0)});
  std::vector<double> out;
  for (const glm::vec4& value : probe("return vec4(ndf(e, a.xyz));", inputs)) out.push_back(value.x);
  return out;
}

double BuiltMap::energy() const { return energy_over(hemisphere_grid(128, 256)); }

double BuiltMap::energy_over_sphere() const {
  std::vector<glm::dvec3> below = hemisphere_grid(128, 256);
  for (glm::dvec3& h : below) h.z = -h.z;
  return energy() + energy_over(below);
}

double BuiltMap::energy_over(const std::vector<glm::dvec3>& hemisphere) const {
  double sum = 0;
  for (const double d : densities(hemisphere)) sum += d;
  return sum * 2.0 * std::numbers::pi / static_cast<double>(hemisphere.size());
}

double shortfall_twin(double kappa) {
  double low = 0;
  double high = 1;
  for (int i = 0; i < 200; ++i) {
    const double q = 0.5 * (low + high);
    (q * q * q + (kappa - 3.0) * q * q - 2.0 * kappa * q + 2.0 > 0.0 ? low : high) = q;
  }
  return low;
}

}  // namespace footprint::testing
