// `tan_gmm`: a mixture of Gaussians over the normals of every texel of every level. Neighbours align their components,
// so that the texture filter can blend them. Tan, Lin, Quan, Guo, Shum 2005, "Multiresolution Reflectance Filtering".
#include <utility>

#include "methods/tan_gmm/mixture_chain.hpp"
#include "renderer/bake/material_maps.hpp"
#include "renderer/bake/method.hpp"
#include "renderer/bake/normal_chain.hpp"
#include "renderer/core/error.hpp"
#include "renderer/image/mipmap.hpp"

namespace footprint {

extern const EmbeddedTexts tan_gmm_glsl;

namespace {

std::vector<OptionSpec> option_table() {
  return {
      whole_option("n", 4, 1, tan_gmm::most_components, "Gaussians of a mixture."),
      word_option("align", {"on", "off"},
                  "Whether EM draws the means to those of the neighbouring texels, so that components correspond; off "
                  "fits each texel on its own."),
      word_option("m_step", {"exact", "published"},
                  "The mean's update: the maximum of the posterior, or the paper's approximation, which weighs the "
                  "neighbours by c instead of 2 sigma^2 c and can lower the posterior."),
      word_option("variance", {"exact", "published", "published_share"},
                  "The variance's update: the mean square over the component's samples; as the paper prints it, over "
                  "the number of samples again; or with that instead of the component's own number."),
      word_option(
          "moment", {"corrected", "published"},
          "The stored second moment: alpha (2 sigma^2 + |mu|^2), or the paper's alpha (sigma^2 + |mu|^2), which "
          "counts the spread of the means twice."),
      word_option("init", {"inherit", "dense_seed", "kmeans"},
                  "Where EM starts: from the coarser texel's mixture (the coarsest, and texels fitted on their own, as "
                  "dense_seed); from the best of clusters, a narrow component on the densest spot and the coarser "
                  "texel's mixture; from clusters alone, as in the paper."),
      number_option("c", 1.0, 0.0, 1e6, "Weight of the prior that aligns the means, in samples; the paper's is 1."),
      word_option("storage", {"fp32", "fp16"}, "How the mixtures are stored: 32-bit or 16-bit floats."),
      roughness_mean_option(),
      word_option("lobe", {"base", "gaussian"},
                  "What a component reflects with: the scene's base lobe, widened by the component's spread, or the "
                  "paper's Gaussian over the disc, which the base lobe enters by its variance alone."),
      word_option("foreshorten", {"on", "off"},
                  "lobe=gaussian: whether the base lobe's variance over the disc shrinks with the cosine of the "
                  "component's tilt."),
      word_option("covariance", {"isotropic", "full"},
                  "One variance for each component, as in the paper, or a whole covariance, by EM from there on; the "
                  "base lobe is then stretched, and `lobe`, `moment`, `m_step` and `variance` are as by default."),
      word_option(
          "specular", {"separate", "joint"},
          "Whether the map of specular colours is filtered on its own, or texels also weigh by the luminance of "
          "theirs in the fit of the lobes: the lobes are then those of the light that is reflected."),
      word_option("rim", {"normalized", "cut"},
                  "lobe=gaussian: what becomes of a Gaussian that reaches beyond the disc: scaled so that no energy is "
                  "lost, or cut off there, as in the paper.")};
}

tan_gmm::Start start_of(const std::string& init) {
  if (init == "dense_seed") return tan_gmm::Start::dense_seed;
  return init == "kmeans" ? tan_gmm::Start::clusters : tan_gmm::Start::inherit;
}

tan_gmm::VarianceStep variance_of(const std::string& variance) {
  if (variance == "exact") return tan_gmm::VarianceStep::exact;
  return variance == "published" ? tan_gmm::VarianceStep::published : tan_gmm::VarianceStep::published_share;
}

tan_gmm::FitSettings fit_settings(const Options& options) {
  return {.components = static_cast<std::size_t>(options.number("n")),
          .align = options.word("align") == "on",
          .m_step = options.word("m_step") == "exact" ? tan_gmm::MStep::exact : tan_gmm::MStep::published,
          .variance = variance_of(options.word("variance")),
          .start = start_of(options.word("init")),
          .full_covariance = options.word("covariance") == "full",
          .prior_weight = options.number("c")};
}

// The specular weight of each texel of a map; 1, with a note, where the colours lie elsewhere.
Image weights_over(const Image& map, const TextureCoordinates& coordinates, const Material& material,
                   Prefiltered& out) {
  const std::optional<Image> colours = specular_over(material, {map.width, map.height}, coordinates);
  if (colours) return specular_weights(*colours);
  if (out.notes.empty()) out.notes.emplace_back(specular_elsewhere_note);
  return {map.width, map.height, 1, 1.0F};
}

Image normals_of(const Material& material, bool coloured, Prefiltered& out) {
  Image normals = normal_map_of(material);
  if (!coloured) return normals;
  const Image weights = weights_over(normals, normal_coordinates(material), material, out);
  for (std::size_t i = 0; i < weights.texels.size(); ++i) normals.texels[4 * i + 3] *= weights.texels[i];
  return normals;
}

// The texture of lobe_variance.glsl with weights by colour: w v and w, because their quotient does not filter linearly.
void add_weighed_variance(const Material& material, Storage storage, RoughnessMean mean, Prefiltered& out) {
  const Image variances = lobe_variance_map(material);
  const Image weights = weights_over(variances, roughness_coordinates(material), material, out);
  Image weighed(variances.width, variances.height, 2);
  for (std::size_t i = 0; i < weights.texels.size(); ++i) {
    weighed.texels[2 * i] = weights.texels[i] * stored_roughness(variances.texels[i], mean);
    weighed.texels[2 * i + 1] = weights.texels[i];
  }
  out.textures.push_back(
      make_texture(stored_lobe_name(mean), mip_chain(std::move(weighed)), storage, roughness_coordinates(material)));
}

Prefiltered precompute(const Material& material, const Options& options, const EffectSet& effects,
                       const Progress& progress) {
  const tan_gmm::FitSettings fit = fit_settings(options);
  const Storage storage = parse_storage(options.word("storage"));
  const bool coloured = options.word("specular") == "joint" && has(effects, Effect::specular_variation);
  if (fit.full_covariance && has(effects, Effect::multi_lobe)) {
    throw Error(ErrorKind::usage, "tan_gmm:covariance=full", "the scene's facets have several lobes each",
                "use covariance=isotropic");
  }
  Prefiltered out;
  if (has(effects, Effect::normal_variation)) {
    const tan_gmm::NormalField normals(normals_of(material, coloured, out));  // and the decoded map is freed
    const auto moment = options.word("moment") == "corrected" ? tan_gmm::Moment::corrected : tan_gmm::Moment::published;
    tan_gmm::MixtureChain chain = tan_gmm::mixture_chain(normals, fit, moment, progress);
    const char* const name = fit.full_covariance ? "tan_gmm_moments" : "tan_gmm_mixture";
    out.textures.push_back(make_array_texture(name, std::move(chain), storage, normal_coordinates(material)));
  }
  if (!coloured) {
    append(out.textures, bake_lobe_variance(material, storage, effects, roughness_mean(options)).textures);
    return out;
  }
  if (has(effects, Effect::normal_variation) && has(effects, Effect::diffuse))  // weighed by area
    out.textures.push_back(
        make_texture("tan_gmm_normal", mean_normal_chain(material), storage, normal_coordinates(material)));
  if (has(effects, Effect::roughness_variation)) add_weighed_variance(material, storage, roughness_mean(options), out);
  return out;
}

}  // namespace

const Method& tan_gmm_method() {
  static const Method method{
      .info = {.name = "tan_gmm",
               .summary = "A mixture of Gaussians over the normals, its components aligned between texels so that "
                          "the texture filter blends them.",
               .paper = "Tan et al. 2005, Multiresolution Reflectance Filtering, Eurographics Symposium on Rendering",
               .options = option_table(),
               .honours = map_effects_but({Effect::anisotropic_lobe, Effect::normal_layers}),
               .slow_precompute = true},
      .precompute = precompute,
      .shader = module_of(tan_gmm_glsl, "tan_gmm.glsl"),
      .lobe_count = [](const Options& options) { return static_cast<int>(fit_settings(options).components); }};
  return method;
}

}  // namespace footprint
