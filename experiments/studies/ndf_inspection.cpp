// The exact NDF of a footprint on a grid of directions, and what each method makes of it.
#include "experiments/studies/ndf_inspection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "experiments/settings/known_methods.hpp"
#include "experiments/studies/ndf_pictures.hpp"
#include "experiments/studies/stage.hpp"
#include "methods/registry.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/memory.hpp"
#include "renderer/core/names.hpp"
#include "renderer/ndf/footprint_texels.hpp"
#include "renderer/ndf/hemisphere_grid.hpp"
#include "renderer/ndf/method_ndf.hpp"
#include "renderer/ndf/reference_ndf.hpp"

namespace footprint {
namespace {

// Pictures are of facets merged within this part of the narrowest lobe's width: within 1e-3 of a lobe's peak.
constexpr double part_in_pictures = 1.0 / 16.0;
// What lies below the horizon needs no more than this.
constexpr double part_in_energy = 1.0 / 8.0;

FootprintFilter filter_of(const RunSettings& run) { return run.footprint.value_or(default_footprint_filter); }

// What is evaluated, and the truth there.
struct Grid {
  HemisphereGrid hemisphere;
  std::vector<glm::vec3> disc;
  std::vector<double> truth;   // at the hemisphere's directions, exact
  std::vector<float> picture;  // at the disc's
};

void require_grid_memory(int resolution, int picture) {
  // Directions, solid angles, truth and one method's densities, and the growth of vectors.
  constexpr std::uint64_t bytes_a_direction = 2 * (sizeof(glm::vec3) + 2 * sizeof(double) + sizeof(float));
  const double directions = std::max(direction_count(resolution), static_cast<double>(picture) * picture);
  require_memory(frame_bytes(static_cast<std::uint64_t>(directions), 1, bytes_a_direction),
                 fmt::format("{:.0f} directions", directions), "give a smaller --resolution or --picture-size");
}

Grid take_truth(const Material& material, const NdfSettings& settings, const FootprintTexels& texels,
                NdfResults& results, const Progress& progress) {
  ProgressParts parts(progress, 2);
  const NormalDistribution distribution = material.brdf.distribution;
  const ReferenceNdf exact(distribution, texels.facets);
  const Lobe narrowest = exact.narrowest();
  const auto merged = [&](double part) {
    return ReferenceNdf(distribution, merged_facets(texels.facets, part * lobe_width(narrowest)));
  };
  results.lobe = lobe_text(narrowest);
  results.resolution = settings.resolution > 0 ? settings.resolution : resolution_for(narrowest);
  require_grid_memory(results.resolution, settings.picture);
  Grid grid{hemisphere_grid(results.resolution), disc_directions(settings.picture), {}, {}};
  grid.truth = exact.densities(grid.hemisphere.directions, parts.next(1, ""));
  const std::vector<double> picture = merged(part_in_pictures).densities(grid.disc, parts.next(1, ""));
  grid.picture.assign(picture.begin(), picture.end());
  const NdfTotals totals = ndf_totals(grid.hemisphere, grid.truth);
  results.directions = grid.hemisphere.directions.size();
  results.truth.energy = totals.energy;
  results.truth.peak = std::max(totals.peak, largest_density(grid.picture));
  results.truth.expected_energy = merged(part_in_energy).expected_energy();
  results.fine_enough =
      std::abs(totals.energy - results.truth.expected_energy) <= ndf_energy_tolerance * results.truth.expected_energy;
  return grid;
}

NdfResults described(const NdfSource& source, const NdfSettings& settings, const FootprintTexels& texels) {
  const FootprintRect& rect = settings.footprint;
  NdfResults results;
  results.source = source.path;
  results.kind = source.is_map ? "map" : "scene";
  results.material = source.material.name;
  if (source.material.normal_map) {
    const MapTexels& map = source.material.normal_map->image;
    results.map_size = {map.width(), map.height()};
  }
  results.lobe_varies = texels.facets.front().parameter != texels.facets.back().parameter;  // sorted by it
  results.footprint = {rect.lower.x, rect.lower.y, rect.upper.x, rect.upper.y};
  results.texels = texels.texels;
  results.valid_share = texels.valid_share;
  results.facets = texels.facets.size();
  results.level = footprint_level(source.material, rect);
  results.filter = footprint_filter_text(filter_of(settings.run));
  results.notes = source.notes;
  return results;
}

// The methods asked for, or all of them.
std::vector<MethodSpec> methods_of(const NdfSettings& settings) {
  if (!settings.run.methods.empty()) return settings.run.methods;
  return every_method();
}

// Of the texels of the normal map those that a method bakes, where a part of it is enough.
double share_baked(const Material& material, const std::optional<FootprintPart>& part) {
  if (!part) return 1.0;
  return static_cast<double>(part->material.normal_map->image.texel_count()) /
         static_cast<double>(material.normal_map->image.texel_count());
}

// What a method bakes and draws from.
struct Stand {
  Scene scene;
  FootprintRect footprint;
  GpuScene gpu;

  Stand(const gl::Context& context, const Material& material, const FootprintRect& rect, const EffectSet& effects,
        const DiskCache* cache)
      : scene(scene_of_facets(material)), footprint(rect), gpu(context.info(), scene, effects, no_progress, cache) {}
};

// One material on the GPU, by whichever method: the whole of it, or what the footprint needs where a method can bake
// that for itself.
class Bench {
 public:
  Bench(const NdfSettings& settings, const Material& material)
      : settings_(settings),
        part_(part_under(material, settings.footprint, filter_of(settings.run))),
        share_(share_baked(material, part_)),
        context_(settings.run.backend.context),
        effects_(effects_on(derive_effects(scene_of_facets(material)))),
        cache_(cache_of(settings.run)),
        whole_(context_, material, settings.footprint, effects_, cache_ ? &*cache_ : nullptr) {
    if (cache_) bakes_.emplace(*cache_);
  }

  // Of the whole time, next to a method that bakes in milliseconds: for progress.
  [[nodiscard]] double weight_of(const MethodSpec& spec) const {
    const MethodInfo& info = find_method(spec.name).info();
    if (!info.slow_precompute) return 1.0;
    constexpr double slow = 30.0;
    return info.bakes_by_texel ? std::max(slow * share_, 1.0) : slow;
  }

  // Adds the figures of a method to `results` and gives its picture.
  NdfPicture inspect(const MethodSpec& spec, const Grid& grid, NdfResults& results, const Progress& progress) {
    const Method& method = find_method(spec.name);
    Stand& stand = stand_of(method);
    const BakedMethod baked = bake(method, spec, stand.scene, effects_, progress, bakes_ ? &*bakes_ : nullptr);
    const MethodNdf ndf(context_.info(), stand.gpu, baked, stand.scene.materials.front(), filter_of(settings_.run),
                        settings_.run.backend.tile);
    for (const std::string& note : baked.materials.front().notes)
      results.notes.push_back(fmt::format("{}: {}", spec.text, note));
    const std::vector<float> densities = ndf.densities(stand.footprint, grid.hemisphere.directions);
    const NdfFigures figures = compare_ndfs(grid.hemisphere, densities, grid.truth);
    NdfRecord record{spec.text, {}, figures.l2, figures.energy, figures.peak, method.lobe_count(baked.options), {}};
    for (const auto& [name, value] : baked.options.all()) record.options[name] = value;
    results.records.push_back(std::move(record));
    NdfPicture picture{file_stem(spec.text), fmt::format("{}  L2 {:.3g}", spec.text, figures.l2),
                       ndf.densities(stand.footprint, grid.disc)};
    context_.check("evaluating the NDF of " + spec.text);
    const double peak = largest_density(picture.densities);
    results.records.back().peak = std::isfinite(peak) ? figures.peak + std::max(peak - figures.peak, 0.0) : peak;
    return picture;
  }

 private:
  Stand& stand_of(const Method& method) {
    if (!part_ || !method.info().bakes_by_texel) return whole_;
    if (!partial_) partial_.emplace(context_, part_->material, part_->rect, effects_, cache_ ? &*cache_ : nullptr);
    return *partial_;
  }

  const NdfSettings& settings_;
  std::optional<FootprintPart> part_;
  double share_;
  gl::Context context_;
  EffectSet effects_;  // those of the whole map, whatever the part of it shows
  std::optional<DiskCache> cache_;
  Stand whole_;
  std::optional<Stand> partial_;
  std::optional<BakeCache> bakes_;
};

}  // namespace

NdfResults inspect_ndf(const NdfSource& source, const NdfSettings& settings, const std::filesystem::path& folder,
                       const Progress& progress) {
  check_footprint(settings.footprint, "--region");
  const std::vector<MethodSpec> methods = methods_of(settings);
  const FootprintTexels texels = texels_under(source.material, settings.footprint);
  NdfResults results = described(source, settings, texels);
  Bench bench(settings, source.material);
  constexpr double weight_of_truth = 10.0;
  double weight = weight_of_truth;
  for (const MethodSpec& spec : methods) weight += bench.weight_of(spec);
  ProgressParts parts(progress, weight);
  const Grid grid = take_truth(source.material, settings, texels, results, parts.next(weight_of_truth, ""));
  std::vector<NdfPicture> pictures;
  for (const MethodSpec& spec : methods) {
    try {
      pictures.push_back(bench.inspect(spec, grid, results, parts.next(bench.weight_of(spec), "")));
    } catch (const Error& error) {
      if (!settings.run.methods.empty() || error.kind() != ErrorKind::usage) throw;
      results.notes.push_back(fmt::format("{} is left out: {}", spec.text, error.what()));
    }
  }
  const NdfPicture truth{"truth", "truth", grid.picture};
  write_ndf_pictures(folder, settings.picture, truth, pictures, results);
  return results;
}

}  // namespace footprint
