// Runs an experiment's comparison, and adds NDFs, quantities and composed figures to its results.
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

// Looks into the footprints, each in a folder NDF/NAME of its own, and adds the figures to the results.
void inspect_footprints(const Experiment& experiment, const std::filesystem::path& folder, Results& results,
                        const Progress& progress) {
  if (experiment.footprints.empty()) return;
  const NdfSource source = load_ndf_source(experiment.run.scene, "", experiment.run.scene_library);
  ProgressParts parts(progress, static_cast<double>(experiment.footprints.size()));
  for (const NamedFootprint& footprint : experiment.footprints) {
    const std::string subfolder = "ndf/" + footprint.name;
    std::filesystem::create_directories(folder / subfolder / "images");
    const NdfSettings wanted{.run = experiment.run, .footprint = footprint.rect};
    const NdfResults found =
        inspect_ndf(source, wanted, folder / subfolder, parts.next(1, "footprint " + footprint.name + ": "));
    for (const NdfRecord& record : found.records) {
      results.ndf.push_back({.footprint = footprint.name,
                             .method = record.method,
                             .l2 = record.l2,
                             .energy = record.energy,
                             .peak = record.peak,
                             .lobes = record.lobes,
                             .picture = subfolder + "/" + found.strip});
    }
  }
}

// The pictures of all footprints, each once.
std::vector<std::string> ndf_pictures(const Results& results) {
  std::vector<std::string> pictures;
  for (const FootprintNdf& figures : results.ndf) {
    if (pictures.empty() || pictures.back() != figures.picture) pictures.push_back(figures.picture);
  }
  return pictures;
}

}  // namespace

void make_quick(Experiment& experiment) {
  RunSettings& run = experiment.run;
  experiment.quick = true;
  run.reference.spp = std::min(run.reference.spp, quick_spp);
  run.timing.repeats = std::min(run.timing.repeats, quick_repeats);
  run.view.size = run.view.size ? glm::max(*run.view.size / quick_divisor, glm::ivec2(1)) : glm::ivec2(quick_default);
}

Results run_experiment(const Experiment& experiment, std::span<const FrameTimes> further_times,
                       const std::filesystem::path& folder, const Progress& progress) {
  const bool looks_further = !experiment.footprints.empty() || !experiment.quantities.empty();
  ProgressParts parts(progress, looks_further ? 6 : 4);
  Results results = run_compare(experiment.run, folder, further_times, parts.next(4, ""));
  inspect_footprints(experiment, folder, results, parts.next(1, ""));
  if (!experiment.quantities.empty()) {
    const Scene scene = load_scene(experiment.run.scene, experiment.run.scene_library, experiment.run.overrides);
    results.quantities = measure_quantities(experiment, scene, parts.next(1, ""));
  }
  results.experiment = judge(experiment, results);
  results.experiment->quick = experiment.quick;
  results.experiment->pictures = write_figures(experiment.figure, experiment, results, folder);
  std::ranges::copy(ndf_pictures(results), std::back_inserter(results.experiment->pictures));
  return results;
}

}  // namespace footprint
