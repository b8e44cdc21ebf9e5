// `atanasov_bins`: a bin map of the normals and its inverse, by which the density of normals under a pixel is a count
// of texels. Atanasov, Křivánek, Koylazov and Wilkie 2020, "Efficient Multiscale Rendering of Specular Microstructure".
#include <algorithm>
#include <cmath>

#include "methods/atanasov_bins/inverse_map.hpp"
#include "renderer/bake/facets.hpp"
#include "renderer/bake/material_maps.hpp"
#include "renderer/bake/method.hpp"
#include "renderer/bake/normal_chain.hpp"
#include "renderer/image/mipmap.hpp"

namespace footprint {

extern const EmbeddedTexts atanasov_bins_glsl;

namespace {

using namespace atanasov_bins;

constexpr int bins_as_published = 127;

// If texels reflect by lobes, the least width of a bin in standard deviations of a lobe.
constexpr double bin_width = 1.5;

struct Settings {
  const Options& options;
  int m = static_cast<int>(options.number("m"));
  int most_across = m > 0 ? m : most_bins_across;      // bins along an edge
  int across_as_bins = m > 0 ? m : bins_as_published;  // the same with roughness=bin
  bool lobe = options.word("roughness") == "lobe";
  bool bin = options.word("roughness") == "bin";
  bool microfacets = options.word("surface") == "microfacets";
  Storage storage = parse_storage(options.word("storage"));
};

// Texels whose lobes differ by more are in separate lists, so that the mean width of a list is close to that of each.
constexpr double class_ratio = 4.0;  // of slope variances
constexpr int most_classes = 4;

// The variance that nine tenths of the texels exceed.
double low_variance(std::vector<float> variances) {
  const auto tenth = variances.begin() + static_cast<std::ptrdiff_t>(variances.size() / 10);
  std::ranges::nth_element(variances, tenth);
  return *tenth;
}

// The variance of the narrowest lobe or, if the roughness varies, the one that nine tenths of the map exceed.
double narrow_variance(const Material& material) {
  if (width_map(material) != nullptr) return low_variance(lobe_variance_map(material).texels);
  if (material.lobes.empty()) return mean_lobe_variance(material);
  double narrowest = 1.0;
  for (const FacetLobe& lobe : material.lobes)
    narrowest = std::min<double>(narrowest, lobe_variance({material.brdf.distribution, lobe.parameter}));
  return narrowest;
}

int bins_across(const Material& material, const Settings& settings) {
  if (settings.bin) return settings.across_as_bins;
  const double alpha = settings.options.number("alpha");  // of a flake
  return bins_across_for(settings.lobe ? narrow_variance(material) : 0.5 * alpha * alpha, bin_width,
                         settings.most_across);
}

// Mean normals of 4 x 4 texels and coarser; for fewer texels the shader reads the texels themselves.
PrefilteredTexture mean_normal_texture(const Material& material, Storage storage) {
  std::vector<Image> chain = mean_normal_chain(material);
  chain.erase(chain.begin(), chain.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(chain.size() - 1, 2)));
  return make_texture("bins_mean_normal", chain, storage, normal_coordinates(material));
}

// Whether every texel of the normal map has a width of its own: both maps have the same coordinates.
bool knows_widths(const Material& material) {
  return width_map(material) != nullptr && roughness_coordinates(material) == normal_coordinates(material);
}

// The slope variance of the lobe at every texel of a map of `size`: the twin of varianceAt in GLSL.
Image widths_of_texels(const Material& material, const glm::ivec2& size) {
  const std::vector<Image> chain = lobe_variance_chain(material);
  const double finer = std::max(std::log2(static_cast<double>(chain.front().width) / size.x), 0.0);
  const Image& level = chain[std::min(static_cast<std::size_t>(finer + 0.5), chain.size() - 1)];
  return nearest_texels(level, size.x, size.y);
}

// The slope variance of normals that fill a bin evenly, doubled because they may be at its corners.
double spread_in_bin(int across) { return bin_solid_angle(across) / 6.0; }

// A class of texels with lobes of similar width: bins along an edge, the largest slope variance of a list's lobe in
// addition to that of the base lobe, and the least variance of its texels.
struct WidthClass {
  int across = 1;
  double widest = 0.0;
  double from = 0.0;
};

// Classes in equal steps of the logarithm of the variance, narrow ones first. The first has all narrower texels.
std::vector<WidthClass> classes_of(const Image& widths, int most_across) {
  const double low = low_variance(widths.texels), high = *std::ranges::max_element(widths.texels);
  const double range = std::log(high / low);
  const int count = std::clamp(static_cast<int>(std::ceil(range / std::log(class_ratio))), 1, most_classes);
  std::vector<WidthClass> classes;
  for (int i = 0; i < count; ++i) {
    const double from = low * std::exp(range * i / count), to = low * std::exp(range * (i + 1) / count);
    const int across = bins_across_for(from, bin_width, most_across);
    classes.push_back({.across = across, .widest = to + spread_in_bin(across), .from = i == 0 ? 0.0 : from});
  }
  return classes;
}

TexelClasses texels_of(std::span<const WidthClass> classes, const Image& widths) {
  TexelClasses out;
  for (const WidthClass& one : classes) out.across.push_back(one.across);
  for (const float width : widths.texels) {
    const auto next = std::ranges::upper_bound(classes, static_cast<double>(width), {}, &WidthClass::from);
    out.of_texel.push_back(static_cast<std::uint8_t>(next - classes.begin() - 1));
  }
  return out;
}

// The least power of two whose square is at least the count: 2^28 integers fit 16384 x 16384.
int columns_for(std::size_t count) {
  int columns = 1;
  while (static_cast<std::size_t>(columns) * static_cast<std::size_t>(columns) < count) columns *= 2;
  return columns;
}

void add_words(std::string name, std::span<const std::uint32_t> words, Prefiltered& out) {
  out.textures.push_back(make_word_texture(std::move(name), columns_for(words.size()), words));
}

void add_table(std::string name, Image image, Prefiltered& out) {
  out.textures.push_back(make_texture(std::move(name), {std::move(image)}, Storage::fp32, {}));
  out.textures.back().filter = TextureFilter::nearest;
}

// `bins_texels`, `bins_forest`, `bins_lists`, `bins_hash` and their scalars.
void add_inverse_map(const InverseMap& map, Prefiltered& out) {
  std::vector<std::uint32_t> lists;
  for (const TexelList& list : map.lists) lists.insert(lists.end(), {list.first, list.root});
  lists.push_back(static_cast<std::uint32_t>(map.texels.size()));
  const std::vector<std::uint32_t> hash = hashed_lists(map);
  add_words("bins_texels", map.texels, out);
  add_words("bins_forest", map.forest, out);
  add_words("bins_lists", lists, out);
  add_words("bins_hash", hash, out);
  out.scalars["bins_hash_slots"] = static_cast<float>(hash.size() / 2);  // of two integers each
  out.scalars["bins_invalid_list"] = map.has_invalid() ? static_cast<float>(map.lists.size() - 1) : -1.0F;
}

// A texture of `channels` values for each list, list by list.
void add_list_values(std::string name, std::span<const float> values, int channels, Prefiltered& out) {
  const std::size_t lists = values.size() / static_cast<std::size_t>(channels);
  const auto columns = static_cast<std::size_t>(columns_for(lists));
  const std::size_t rows = (std::max<std::size_t>(lists, 1) + columns - 1) / columns;
  Image image(static_cast<int>(columns), static_cast<int>(rows), channels);
  std::ranges::copy(values, image.texels.begin());
  add_table(std::move(name), std::move(image), out);
}

// `bins_classes`: across, widest, from.
void add_classes(std::span<const WidthClass> classes, Prefiltered& out) {
  Image image(static_cast<int>(classes.size()), 1, 3);
  for (std::size_t i = 0; i < classes.size(); ++i) {
    const glm::vec3 values(classes[i].across, classes[i].widest, classes[i].from);
    std::copy_n(&values.x, 3, &image.texels[3 * i]);
  }
  add_table("bins_classes", std::move(image), out);
  out.scalars["bins_class_count"] = static_cast<float>(classes.size());
}

Prefiltered precompute(const Material& material, const Options& options, const EffectSet& effects,
                       const Progress& progress) {
  Prefiltered out;
  const Settings settings{options};
  const int across = bins_across(material, settings);
  out.scalars["bins_across"] = static_cast<float>(across);
  // Flakes have a lobe of their own, and mirrors that face h need none.
  if (settings.lobe || (settings.bin && settings.microfacets)) {
    append(out.textures, bake_lobe_variance(material, Storage::fp32, effects).textures);
  }
  if (!has(effects, Effect::normal_variation)) return out;
  if (has(effects, Effect::diffuse)) out.textures.push_back(mean_normal_texture(material, settings.storage));
  const bool by_width = settings.lobe && has(effects, Effect::roughness_variation);
  if (by_width) out.scalars["bins_own_roughness"] = knows_widths(material) ? 1.0F : 0.0F;
  const Image normals = normal_map_of(material);
  const BinMap bins = bin_map(normals, across, progress);
  out.textures.push_back(make_word_texture("bins_map", bins.width, bins.normals));
  out.textures.back().coordinates = normal_coordinates(material);
  std::vector<WidthClass> classes{{.across = across, .widest = spread_in_bin(across), .from = 0.0}};
  TexelClasses texels;
  Image widths(normals.width, normals.height, 1);
  if (by_width && knows_widths(material)) {
    widths = widths_of_texels(material, {normals.width, normals.height});
    classes = classes_of(widths, settings.most_across);
    texels = texels_of(classes, widths);
  }
  const InverseMap inverse = invert_map(bins, progress, texels);
  add_inverse_map(inverse, out);
  if (by_width) add_list_values("bins_widths", list_means(inverse, widths), 1, out);
  if (!settings.bin) {
    const std::vector<glm::vec2> roundings = list_roundings(inverse, bins, normals);
    add_list_values("bins_roundings", {&roundings.front().x, 2 * roundings.size()}, 2, out);
    out.scalars["bins_list_count"] = static_cast<float>(inverse.lists.size());
    add_classes(classes, out);
    add_words("bins_moments", node_moments(inverse, bins, texels), out);
  }
  out.scalars["bins_wrap_u"] = wrap_number(normal_coordinates(material).wrap[0]);
  out.scalars["bins_wrap_v"] = wrap_number(normal_coordinates(material).wrap[1]);
  return out;
}

}  // namespace

const Method& atanasov_bins_method() {
  static const Method method{
      .info =
          {.name = "atanasov_bins",
           .summary = "Normals sorted into bins of the half vector; trees count each bin's texels under the footprint.",
           .paper =
               "Atanasov, Krivanek, Koylazov, Wilkie 2020, Efficient Multiscale Rendering of Specular Microstructure",
           .options =
               {whole_option("m", 0, 0, most_bins_across,
                             "Bins along an edge: the hemisphere has m x m of equal solid angle. 0: 127 with "
                             "roughness=bin; with the "
                             "others bins 1.5 of the lobes' deviations wide, and at most m if it is given."),
                word_option(
                    "roughness", {"lobe", "bin", "flakes"},
                    "What spreads a texel's normal: the base lobe about it, bins around the half vector included; "
                    "the bin that it is in, as published; a Beckmann lobe of `alpha` of every flake's own."),
                number_option("alpha", 0.01, 0.0025, 0.04, "With roughness=flakes: Beckmann's width of a flake."),
                word_option(
                    "footprint", {"parallelogram", "box", "filter"},
                    "Which texels count: those under the pixel's parallelogram; those in the box about it along the "
                    "map's axes; those that the footprint filter would blend."),
                word_option(
                    "border", {"nodes", "texels"},
                    "How texels count at the footprint's border: by samples of the nodes of the trees narrower than a "
                    "quarter "
                    "of it, so that a pixel's cost does not grow with its footprint; or one by one as far as the steps "
                    "of a "
                    "pixel allow."),
                word_option(
                    "surface", {"facets", "microfacets"},
                    "What the density is of: texels that each reflect about their own normal, as the reference has "
                    "them; microfacets of a surface about its own normal, as published, D over the cosine."),
                whole_option(
                    "draws", 16, 1, 1024,
                    "Under an environment: so many normals are drawn from under a pixel (section 2.1), each a lobe "
                    "of its own; of fewer texels all are taken."),
                word_option("storage", {"fp16", "fp32"},
                            "Format of the means of normals over 4 x 4 texels and more, about which diffuse light is "
                            "reflected over wide footprints. All other numbers are integers, or one per bin.")},
           .honours = map_effects_but({Effect::anisotropic_lobe, Effect::normal_layers}),
           .lobes_as_given = true,
           .slow_precompute = true,
           .slow_frame = true},
      .precompute = precompute,
      .shader = module_of(atanasov_bins_glsl, "atanasov_bins.glsl")};
  return method;
}

}  // namespace footprint
