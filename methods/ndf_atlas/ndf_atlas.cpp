// `ndf_atlas`: from one level on, every texel stores the density of its normals on a small lattice over the half
// vector. Finer levels store moments of a few parts of the normals, as `cells` does.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "methods/cells/partition.hpp"
#include "methods/ndf_atlas/atlas.hpp"
#include "renderer/bake/material_maps.hpp"
#include "renderer/bake/method.hpp"
#include "renderer/bake/normal_chain.hpp"
#include "renderer/bake/slope_moments.hpp"
#include "renderer/image/mipmap.hpp"

namespace footprint {

extern const EmbeddedTexts ndf_atlas_glsl;

namespace {

using namespace ndf_atlas;

constexpr int most_parts = 4;

std::vector<OptionSpec> option_table() {
  return {whole_option("level", 2, 1, 10,
                       "The first level whose texels have tables; below it, lobes. A finer one takes four times the "
                       "memory."),
          number_option("step", 0.73, 0.3, 1.2,
                        "The distance of a table's nodes at most, over the deviation of the Gaussian that is as curved "
                        "as the narrowest lobe's peak."),
          whole_option("nodes", 64, 8, 256,
                       "Nodes along an edge at most: a material whose lobes are too narrow for them has lobes alone."),
          whole_option("megabytes", 400, 1, 480,
                       "What the tables of a material may take: of a larger map they start at a coarser level."),
          word_option("tables", {"unorm8", "fp16", "fp32"},
                      "How tables are stored: in bytes whose rounding keeps the energy, 16-bit or 32-bit floats."),
          whole_option("k", 3, 1, most_parts, "Parts of the normals, with a lobe each, where there are no tables."),
          word_option("storage", {"fp32", "fp16"}, "How the moments of parts and the mean normals are stored.")};
}

struct Settings {
  const Options& options;
  int level = static_cast<int>(options.number("level"));
  double step = options.number("step");
  int nodes = static_cast<int>(options.number("nodes"));
  double megabytes = options.number("megabytes");
  Storage tables = parse_storage(options.word("tables"));
  int parts = static_cast<int>(options.number("k"));
  Storage storage = parse_storage(options.word("storage"));
};

// Lattice and layout of a material's tables; without facets the material has no tables.
struct Plan {
  std::optional<Facets> facets{};
  Lattice lattice{};
  AtlasLayout layout{};
};

// The finest level, not finer than the option `level`, whose tables fit into `megabytes`; at worst the coarsest level.
int affordable_level(const Facets& facets, const Lattice& lattice, const Settings& settings) {
  const int levels = mip_level_count(facets.width, facets.height);
  int level = std::min(settings.level, levels - 1);
  const double most = settings.megabytes * 1e6 / static_cast<double>(channel_bytes(settings.tables));
  while (level + 1 < levels && node_count(facets.width, facets.height, lattice, level) > most) ++level;
  return level;
}

Plan plan_tables(const Material& material, const Settings& settings, const EffectSet& effects,
                 std::vector<std::string>& notes) {
  Plan plan;
  plan.facets = collect_facets(material, has(effects, Effect::roughness_variation));
  if (!plan.facets) {
    notes.emplace_back("the roughness map does not lie on the normal map's texels: lobes at all levels, no tables");
    return plan;
  }
  plan.lattice = lattice_over(*plan.facets, settings.step);
  const int needed = std::max(plan.lattice.nodes.x, plan.lattice.nodes.y);
  if (needed > settings.nodes) {
    notes.push_back(fmt::format(
        "the narrowest lobe needs tables of {} nodes along an edge, and `nodes` allows {}: lobes at all levels", needed,
        settings.nodes));
    plan.facets.reset();
    plan.lattice = {};
    return plan;
  }
  const int level = affordable_level(*plan.facets, plan.lattice, settings);
  plan.layout = layout_for(plan.facets->width, plan.facets->height, plan.lattice, level);
  if (level > settings.level)
    notes.push_back(fmt::format("tables start at level {}: `megabytes` allows no finer one", level));
  return plan;
}

// All materials share a program: one without tables has textures of one texel.
void add_tables(Plan plan, const Material& material, Storage storage, const Progress& progress, Prefiltered& out) {
  const TextureCoordinates coordinates = normal_coordinates(material);
  const bool tabulated = plan.facets.has_value();
  LevelTables finest{.width = 1, .height = 1, .nodes = 4, .density = std::vector<float>(4), .coverage = {0.0F}};
  if (tabulated) finest = build_tables(*plan.facets, plan.lattice, plan.layout.first_level, progress);
  append(out.textures, atlas_textures(std::move(finest), plan.lattice, plan.layout, storage, coordinates.wrap));
  out.scalars["ndf_atlas_level"] = tabulated ? static_cast<float>(plan.layout.first_level) : 1e3F;
  out.scalars["ndf_atlas_column_bits"] = std::log2(static_cast<float>(plan.layout.columns));
  out.vectors["ndf_atlas_lattice"] = {plan.lattice.nodes, plan.lattice.origin, plan.lattice.step};
  out.scalars["ndf_atlas_wrap_u"] = wrap_number(coordinates.wrap[0]);
  out.scalars["ndf_atlas_wrap_v"] = wrap_number(coordinates.wrap[1]);
}

// Partitions the normals and adds the moments of each part, as `cells` does.
void add_parts(const Material& material, const Settings& settings, const Progress& progress, Prefiltered& out) {
  constexpr cells::Covariance covariance = cells::Covariance::full;
  const cells::PartedPoints map = cells::parted_points(
      normal_map_of(material), steepest_slope, {},
      {.parts = settings.parts, .variance = lobe_variance_chain(material).back().texels[0]}, progress);
  const auto frames = cells::part_frames(map, covariance);
  for (std::size_t k = 0; k < most_parts; ++k) out.vectors["ndf_atlas_centres"].emplace_back(frames[k].centre);
  // The shader reads them by level, because the levels that have tables do not need them.
  out.textures.push_back(make_array_texture("ndf_atlas_moments", cells::moment_chains(map, frames, covariance),
                                            settings.storage, normal_coordinates(material), TextureFilter::by_level));
}

Prefiltered precompute(const Material& material, const Options& options, const EffectSet& effects,
                       const Progress& progress) {
  const Settings settings{options};
  Prefiltered out = bake_lobe_variance(material, settings.storage, effects);
  if (!has(effects, Effect::normal_variation)) return out;
  append(out.textures, bake_mean_normal(material, settings.storage, effects).textures);
  ProgressParts steps(progress, 2);
  add_parts(material, settings, steps.next(1, ""), out);
  add_tables(plan_tables(material, settings, effects, out.notes), material, settings.tables, steps.next(1, ""), out);
  return out;
}

}  // namespace

const Method& ndf_atlas_method() {
  static const Method method{
      .info = {.name = "ndf_atlas",
               .summary =
                   "From a level on every texel keeps the density of its normals itself, on a small lattice over "
                   "the half vector; finer levels have a lobe for each of a few parts of the normals.",
               .paper = "Footprint's own; histograms of normals as in Gamboa et al. 2018, with the base lobe in them",
               .options = option_table(),
               .honours = map_effects_but({Effect::multi_lobe, Effect::normal_layers}),
               .slow_precompute = true},
      .precompute = precompute,
      .shader = module_of(ndf_atlas_glsl, "ndf_atlas.glsl"),
      .lobe_count = [](const Options& options) { return Settings{options}.parts; }};
  return method;
}

}  // namespace footprint
