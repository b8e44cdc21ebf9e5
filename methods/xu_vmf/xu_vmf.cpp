// `xu_vmf`: base BRDF and normal map joined into von Mises-Fisher lobes every frame, averaged by parts of the
// hemisphere. Xu, Wang, Zhao, Bao 2017, "Real-Time Linear BRDF MIP-Mapping".
#include <algorithm>
#include <array>
#include <utility>

#include "renderer/gl/objects.hpp"
#include "renderer/image/mipmap.hpp"
#include "renderer/pipeline/base_surface.hpp"
#include "renderer/pipeline/gpu_scene.hpp"
#include "renderer/pipeline/method.hpp"
#include "renderer/pipeline/normal_chain.hpp"
#include "renderer/pipeline/shader_source.hpp"

namespace footprint {

namespace embedded {
extern const std::string_view xu_vmf_glsl, xu_vmf_conversion_glsl, xu_vmf_join_glsl, xu_vmf_coarsen_glsl;
}

namespace {

constexpr GLuint material_binding = 0;
constexpr GLuint group_edge = 8;  // local size of the passes

OptionSpec threshold_option(std::string name, double value, std::string meaning) {
  return {.name = std::move(name),
          .default_value = value,
          .minimum = 0.0,
          .maximum = 1.0,
          .choices = {},
          .meaning = std::move(meaning),
          .integer = false};
}

std::vector<OptionSpec> option_table() {
  return {word_option("j", {"adaptive", "1", "4", "8"},
                      "Parts of the hemisphere, a lobe each: a fixed number, or each footprint's own by the thresholds "
                      "eps0 and eps1."),
          word_option("partition", {"azimuth", "latitude"},
                      "How the hemisphere is cut: 4 sectors, each in 2 rings, or 4 rings, each in 2 halves."),
          word_option("variant", {"corrected", "published"},
                      "Whether a lobe adds with the share of the footprint that it covers, or whole, as Algorithm 1 "
                      "prints it."),
          word_option("lobe", {"base", "vmf"},
                      "What a part reflects with: the scene's base lobe of the width that kappa says, or the paper's "
                      "von Mises-Fisher lobe."),
          threshold_option("eps0", 0.95, "j=adaptive: one lobe serves the whole footprint where its |r| is above."),
          threshold_option("eps1", 0.85, "j=adaptive: one lobe serves one of the 4 parts where its |r| is above.")};
}

int layer_count(const Options& options) {
  const std::string& j = options.word("j");
  return j == "adaptive" ? 9 : std::stoi(j);  // adaptive: the whole hemisphere, and its 8 parts
}

// Two maps can be joined texel by texel where one place on the surface is one place in both. A map that is not there is
// anywhere.
bool can_join(const Material& material) {
  if (width_map(material) == nullptr) return true;
  const TextureCoordinates normal = normal_coordinates(material);
  const TextureCoordinates roughness = roughness_coordinates(material);
  const bool same_wrap = !material.normal_map || normal.wrap == roughness.wrap;
  return normal.set == roughness.set && normal.transform == roughness.transform && same_wrap;
}

// The passes of one scene.
class InstantMap final : public FrameBuild {
 public:
  InstantMap(const ShaderVariant& variant, const Options& options)
      : layers_(static_cast<GLuint>(layer_count(options))),
        varies_{has(variant.effects, Effect::normal_variation), has(variant.effects, Effect::roughness_variation)},
        join_("xu_vmf_join.glsl",
              frame_build_shader(variant,
                                 std::string(embedded::xu_vmf_conversion_glsl).append(embedded::xu_vmf_join_glsl),
                                 "xu_vmf_join.glsl", options)),
        coarsen_("xu_vmf_coarsen.glsl",
                 frame_build_shader(variant, embedded::xu_vmf_coarsen_glsl, "xu_vmf_coarsen.glsl", options)) {}

  void run(const GpuBatch& batch, std::span<const GpuTexture> textures) const override {
    const gl::Texture& map = textures.front().texture;
    bind_inputs(batch, textures.subspan(1));
    gl::api().ClearTexImage(map.name(), 0, GL_RGBA, GL_FLOAT, nullptr);  // a texel is written to its own part alone
    dispatch(join_, map, 0, 1);
    const int levels = mip_level_count(map.width(), map.height());
    bind(0, map);
    for (int level = 1; level < levels; ++level) {
      gl::api().MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
      gl::api().ProgramUniform1i(coarsen_.name(), coarsen_.uniform("fine_level"), level - 1);
      dispatch(coarsen_, map, level, layers_);
    }
  }

 private:
  static void bind(GLuint unit, const gl::Texture& texture) {
    gl::api().BindTextureUnit(unit, texture.name());
    gl::api().BindSampler(unit, 0);
  }

  // Unit 0 has the normals and unit 1 the lobe's variance, those of them that vary.
  void bind_inputs(const GpuBatch& batch, std::span<const GpuTexture> inputs) const {
    gl::api().BindBufferBase(GL_UNIFORM_BUFFER, material_binding, batch.material_block.name());
    std::size_t next = 0;
    for (GLuint unit = 0; unit < varies_.size(); ++unit) {
      if (varies_.at(unit)) bind(unit, inputs[next++].texture);
    }
  }

  // One invocation a texel of the level that is written.
  static void dispatch(const gl::Program& pass, const gl::Texture& map, int level, GLuint depth) {
    const auto groups = [&](int size) {
      return (static_cast<GLuint>(std::max(size >> level, 1)) + group_edge - 1) / group_edge;
    };
    gl::api().BindImageTexture(0, map.name(), level, GL_TRUE, 0, GL_WRITE_ONLY, GL_RGBA32F);
    gl::api().UseProgram(pass.name());
    gl::api().DispatchCompute(groups(map.width()), groups(map.height()), depth);
  }

  GLuint layers_;
  std::array<bool, 2> varies_;
  gl::Program join_, coarsen_;
};

class XuVmf final : public Method {
 public:
  /// The frame build does the filtering: what is baked are its inputs, and the place of its map.
  [[nodiscard]] Prefiltered precompute(const Material& material, const Options& options, const EffectSet& effects,
                                       const Progress& /*progress*/) const override {
    const bool normals_vary = has(effects, Effect::normal_variation);
    const bool roughness_varies = has(effects, Effect::roughness_variation);
    Prefiltered out;
    if (!normals_vary && !roughness_varies) return out;
    const Image normals = normals_vary ? normal_map_of(material) : Image(1, 1, 4);
    Image variances = roughness_varies ? lobe_variance_map(material) : Image(1, 1, 1);
    if (normals_vary && roughness_varies && !can_join(material)) {
      variances = mip_chain(std::move(variances)).back();
      out.notes.emplace_back(
          "the roughness map has other texture coordinates than the normal map and cannot be joined with it; its mean "
          "variance stands in");
    }
    const TextureCoordinates place =
        normals_vary && material.normal_map ? normal_coordinates(material) : roughness_coordinates(material);
    out.textures.push_back(make_built_texture("xu_vmf_map", std::max(normals.width, variances.width),
                                              std::max(normals.height, variances.height), layer_count(options),
                                              Storage::fp32, place));
    if (normals_vary) out.textures.push_back(make_texture("xu_vmf_normals", {normals}, Storage::fp32, place));
    if (roughness_varies) out.textures.push_back(make_texture("xu_vmf_variances", {variances}, Storage::fp32, place));
    return out;
  }

  [[nodiscard]] const MethodInfo& info() const override { return info_; }

  [[nodiscard]] std::unique_ptr<FrameBuild> frame_build(const ShaderVariant& variant,
                                                        const Options& options) const override {
    const bool anything =
        has(variant.effects, Effect::normal_variation) || has(variant.effects, Effect::roughness_variation);
    return anything ? std::make_unique<InstantMap>(variant, options) : nullptr;
  }

  [[nodiscard]] int lobe_count(const Options& options) const override { return std::min(layer_count(options), 8); }

  [[nodiscard]] std::string_view shader() const override { return shader_; }

 private:
  MethodInfo info_{.name = "xu_vmf",
                   .summary =
                       "Lobes of base BRDF and normal map together, joined each frame and averaged by parts of "
                       "the hemisphere; in the tangent frame.",
                   .paper = "Xu et al. 2017, Real-Time Linear BRDF MIP-Mapping, Computer Graphics Forum 36(4)",
                   .options = option_table(),
                   .honours = EffectSet{}
                                  .set()
                                  .reset(static_cast<std::size_t>(Effect::multi_lobe))
                                  .reset(static_cast<std::size_t>(Effect::environment_light))};
  std::string shader_ = std::string(embedded::xu_vmf_glsl).append(embedded::xu_vmf_conversion_glsl);
};

}  // namespace

const Method& xu_vmf_method() {
  static const XuVmf method;
  return method;
}

}  // namespace footprint
