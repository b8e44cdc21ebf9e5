// `yan_gaussians`: position-normal distributions after Yan et al. 2016, with one 4D Gaussian per texel and a hierarchy
// over positions and normals. A reference for prefiltering on surfaces where every glint is visible.
#include <algorithm>
#include <array>

#include "methods/yan_gaussians/elements.hpp"
#include "renderer/bake/material_maps.hpp"
#include "renderer/bake/method.hpp"
#include "renderer/bake/normal_chain.hpp"

namespace footprint {

extern const EmbeddedTexts yan_gaussians_glsl;

namespace {

// Widths of the textures that store lists; yan_sum.glsl has the same numbers.
constexpr int order_width = 4096, nodes_width = 2048;

ElementTree tree_over(const Elements& elements, double cutoff) {
  const Image& normals = elements.normals;
  std::vector<TreePoint> points;
  std::vector<float> reach;
  points.reserve(normals.texel_count());
  reach.reserve(normals.texel_count());
  for (int y = 0; y < normals.height; ++y) {
    for (int x = 0; x < normals.width; ++x) {
      const auto normal = normals.at(x, y);
      reach.push_back(static_cast<float>(cutoff) * normal_reach(elements, points.size()));
      points.push_back({(static_cast<float>(x) + 0.5F) / static_cast<float>(normals.width),
                        (static_cast<float>(y) + 0.5F) / static_cast<float>(normals.height), normal[0], normal[1]});
    }
  }
  return build_element_tree(points, reach);
}

// The bounds of each node: the lower ones in the first layer, the upper ones in the second.
PrefilteredTexture nodes_texture(const ElementTree& tree) {
  const auto rows = static_cast<int>((tree.nodes.size() + nodes_width - 1) / nodes_width);
  std::vector<std::vector<Image>> layers(2);
  for (std::size_t layer = 0; layer < 2; ++layer) {
    Image& image = layers[layer].emplace_back(nodes_width, rows, 4);
    for (std::size_t i = 0; i < tree.nodes.size(); ++i)
      std::ranges::copy(layer == 0 ? tree.nodes[i].low : tree.nodes[i].high,
                        image.texels.begin() + 4 * static_cast<std::ptrdiff_t>(i));
  }
  return make_array_texture("yan_nodes", std::move(layers), Storage::fp32, {}, TextureFilter::nearest);
}

Prefiltered precompute(const Material& material, const Options& options, const EffectSet& effects,
                       const Progress& progress) {
  Prefiltered out;
  out.scalars["yan_lobe"] = static_cast<float>(mean_lobe(material).parameter);
  if (!has(effects, Effect::normal_variation)) return out;
  const std::array<Wrap, 2> wrap = normal_coordinates(material).wrap;
  const auto share = [](Wrap along) { return along == Wrap::repeat ? 1.0F : 0.5F; };
  const auto clamped = [](Wrap along) { return along == Wrap::clamp_to_edge ? 1.0F : 0.0F; };
  out.vectors["yan_wrap"] = {{share(wrap[0]), share(wrap[1])}, {clamped(wrap[0]), clamped(wrap[1])}};
  progress("elements", 0.0);
  Elements elements = make_elements(material, options.word("jacobian") == "central");
  progress("hierarchy over positions and normals", 0.1);
  const ElementTree tree = tree_over(elements, options.number("cutoff"));
  progress("textures", 0.8);
  out.scalars["yan_depth"] = static_cast<float>(tree.depth);
  TextureCoordinates repeating = normal_coordinates(material);
  repeating.wrap = {Wrap::repeat, Wrap::repeat};
  out.textures.push_back(make_texture("mean_normal", mean_normal_chain(elements.normals), Storage::fp32, repeating));
  if (!elements.jacobians.empty())
    out.textures.push_back(make_texture("yan_jacobian", {std::move(elements.jacobians)}, Storage::fp32, {}));
  out.textures.push_back(make_word_texture("yan_order", order_width, tree.order));  // texel indices
  out.textures.push_back(nodes_texture(tree));
  return out;
}

}  // namespace

const Method& yan_gaussians_method() {
  static const Method method{
      .info =
          {.name = "yan_gaussians",
           .summary = "A 4D Gaussian of position and normal for every texel, summed by a hierarchy under each pixel.",
           .paper = "Yan, Hasan, Marschner, Ramamoorthi 2016, Position-Normal Distributions for Efficient Rendering of "
                    "Specular Microstructure",
           .options = {word_option(
                           "roughness", {"lobe", "intrinsic"},
                           "What an element's normals reflect with: the base lobe; or, as in the paper, a Gaussian "
                           "of deviation sigma_r on the disc and nothing of the base lobe."),
                       number_option("sigma_r", 0.005, 1e-4, 1.0,
                                     "The intrinsic roughness: standard deviation along each axis of the disc, with "
                                     "roughness=intrinsic."),
                       word_option(
                           "jacobian", {"central", "none"},
                           "How normals change across an element: by central differences of its neighbours, as in "
                           "the paper; or not at all, as a map of steps has it."),
                       number_option("cutoff", 5.0, 2.0, 8.0,
                                     "Standard deviations beyond which footprint, elements and lobes are cut off.")},
           .honours = map_effects_but({Effect::anisotropic_lobe, Effect::normal_layers, Effect::roughness_variation,
                                       Effect::environment_light}),
           .slow_precompute = true,
           .slow_frame = true},
      .precompute = precompute,
      .shader = module_of(yan_gaussians_glsl, "yan_gaussians.glsl")};
  return method;
}

}  // namespace footprint
