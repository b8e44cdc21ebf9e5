// The table of options, and what a material adds to them.
#include "methods/iwasaki_sg/settings.hpp"

#include "renderer/bake/facets.hpp"
#include "renderer/microgeometry/microgeometry.hpp"

namespace footprint::iwasaki_sg {

std::vector<OptionSpec> option_table() {
  return {whole_option("j", 7, 1, most_lobes,
                       "Most spherical Gaussians of the normal distribution; 3 and 7 fill texels of four with the "
                       "diffuse term."),
          whole_option("directions", 12, 2, 32, "Side of the grid of incident and outgoing directions."),
          whole_option("facets", 65536, 64, 1 << 24, "Samples of the patch."),
          word_option("lobe", {"base", "sg"},
                      "What a lobe of normals reflects with: the scene's base lobe, widened by that of the normals, or "
                      "the paper's spherical Gaussians, one or several fitted to the base lobe."),
          word_option("convolution", {"approximate", "exact"},
                      "lobe=sg: the convolution of two spherical Gaussians as one (Eq. 14), or exactly (Eq. 11)."),
          word_option("cosines", {"base", "published"},
                      "What facets weigh in the specular term: (n.wo), with the base BRDF's own cosine and geometry "
                      "term, or the paper's (n.wi)(n.wo) without a geometry term."),
          word_option("energy", {"conserved", "published"},
                      "Whether the amplitudes are scaled to the energy of the visible facets; plain least squares, as "
                      "in the paper, does not conserve it."),
          word_option("storage", {"fp32", "fp16"}, "How the amplitudes are stored: 32-bit or 16-bit floats.")};
}

bool is_tabulated(const Material& material) { return material.microgeometry && material.microgeometry->brdf; }

EffectSet patch_effects(const Material& material) {
  EffectSet effects;
  if (!material.microgeometry) return effects;
  effects.set(static_cast<std::size_t>(Effect::microgeometry_visibility));
  effects.set(static_cast<std::size_t>(Effect::microgeometry_colour), needs_colors(*material.microgeometry));
  effects.set(static_cast<std::size_t>(Effect::tabulated_brdf), is_tabulated(material));
  return effects;
}

TableSettings table_settings(const Material& material, const Options& options, const EffectSet& effects) {
  return {
      .lobes = static_cast<int>(options.number("j")),
      .side = static_cast<int>(options.number("directions")),
      .facets = static_cast<std::size_t>(options.number("facets")),
      .cosines = options.word("cosines") == "published" || is_tabulated(material) ? Cosines::published : Cosines::base,
      .energy = options.word("energy") == "conserved" ? Energy::conserved : Energy::published,
      .channels = has(effects, Effect::microgeometry_colour) ? std::size_t{3} : std::size_t{1},
      .paints = paint_factors(material)};
}

}  // namespace footprint::iwasaki_sg
