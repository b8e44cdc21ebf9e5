// Turns an experiment into the settings of a comparison, and adds NDFs, quantities and composed figures to its results.
#include "experiments/runner/run_experiment.hpp"

#include <algorithm>
#include <iterator>

#include "experiments/runner/composed_figure.hpp"
#include "experiments/runner/judge.hpp"
#include "experiments/runner/quantities.hpp"
#include "experiments/studies/ndf_inspection.hpp"
#include "renderer/scene/assembly/load_scene.hpp"

namespace footprint {
namespace {

constexpr int quick_spp = 32;
constexpr int quick_repeats = 3;
constexpr int quick_divisor = 4;
constexpr int quick_default = 128;  // pixels a side where the experiment gives no size

void make_quick(CompareSettings& settings) {
  settings.spp = std::min(settings.spp, quick_spp);
  settings.repeats = std::min(settings.repeats, quick_repeats);
  settings.size = settings.size ? glm::max(*settings.size / quick_divisor, glm::ivec2(1)) : glm::ivec2(quick_default);
}

// Looks into the footprints, each in a folder NDF/NAME of its own, and adds the figures to the results.
void inspect_footprints(const Experiment& experiment, const RunSettings& settings, const std::filesystem::path& folder,
                        Results& results, const Progress& progress) {
  if (experiment.footprints.empty()) return;
  const NdfSource source = load_ndf_source(experiment.scene, "", settings.scene_library);
  ProgressParts parts(progress, static_cast<double>(experiment.footprints.size()));
  for (const NamedFootprint& footprint : experiment.footprints) {
    const std::string place = "ndf/" + footprint.name;
    std::filesystem::create_directories(folder / place / "images");
    NdfSettings wanted{.footprint = footprint.rect,
                       .methods = experiment.methods,
                       .anisotropy = experiment.anisotropy,
                       .context = settings.context,
                       .cache = settings.cache};
    const NdfResults found =
        inspect_ndf(source, wanted, folder / place, parts.next(1, "footprint " + footprint.name + ": "));
    for (const NdfRecord& record : found.records) {
      results.ndf.push_back({.footprint = footprint.name,
                             .method = record.method,
                             .l2 = record.l2,
                             .energy = record.energy,
                             .peak = record.peak,
                             .lobes = record.lobes,
                             .picture = place + "/" + found.strip});
    }
  }
}

// The pictures of all footprints, each once.
std::vector<std::string> ndf_pictures(const Results& results) {
  std::vector<std::string> pictures;
  for (const NdfFigures& figures : results.ndf) {
    if (pictures.empty() || pictures.back() != figures.picture) pictures.push_back(figures.picture);
  }
  return pictures;
}

}  // namespace

CompareSettings compare_settings(const Experiment& experiment, const RunSettings& settings) {
  CompareSettings compare;
  compare.scene = experiment.scene;
  compare.scene_library = settings.scene_library;
  compare.methods = experiment.methods;
  compare.distances = experiment.distances;
  compare.consecutive = experiment.consecutive;
  compare.camera = experiment.camera;
  compare.size = experiment.size;
  compare.spp = experiment.spp;
  compare.other_spp = experiment.other_spp;
  compare.supersampling = experiment.supersampling;
  compare.seed = experiment.seed;
  compare.filter = experiment.filter;
  compare.environment = experiment.environment;
  compare.exposure = experiment.exposure;
  compare.without = experiment.without;
  compare.repeats = experiment.repeats;
  compare.anisotropy = experiment.anisotropy;
  compare.tile = settings.tile;
  compare.cache = settings.cache;
  compare.context = settings.context;
  if (settings.quick) make_quick(compare);
  return compare;
}

Results run_experiment(const Experiment& experiment, const RunSettings& settings,
                       std::span<const FrameTimes> further_times, const std::filesystem::path& folder,
                       const Progress& progress) {
  const bool looks_further = !experiment.footprints.empty() || !experiment.quantities.empty();
  ProgressParts parts(progress, looks_further ? 6 : 4);
  Results results = run_compare(compare_settings(experiment, settings), folder, further_times, parts.next(4, ""));
  inspect_footprints(experiment, settings, folder, results, parts.next(1, ""));
  if (!experiment.quantities.empty()) {
    const Scene scene = load_scene(experiment.scene, settings.scene_library);
    results.quantities = measure_quantities(experiment, scene, parts.next(1, ""));
  }
  results.experiment = judge(experiment, results);
  results.experiment->quick = settings.quick;
  results.experiment->pictures = write_figures(experiment.figure, experiment, results, folder);
  std::ranges::copy(ndf_pictures(results), std::back_inserter(results.experiment->pictures));
  return results;
}

}  // namespace footprint
