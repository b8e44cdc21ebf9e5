// See run_experiment.hpp.
#include "experiments/runner/run_experiment.hpp"

#include <algorithm>

#include "experiments/runner/composed_figure.hpp"
#include "experiments/runner/judge.hpp"

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

}  // namespace

CompareSettings compare_settings(const Experiment& experiment, const RunSettings& settings) {
  CompareSettings compare;
  compare.scene = experiment.scene;
  compare.library = settings.library;
  compare.methods = experiment.methods;
  compare.distances = experiment.distances;
  compare.consecutive = experiment.consecutive;
  compare.camera = experiment.camera;
  compare.size = experiment.size;
  compare.spp = experiment.spp;
  compare.other_spp = experiment.other_spp;
  compare.seed = experiment.seed;
  compare.filter = experiment.filter;
  compare.exposure = experiment.exposure;
  compare.repeats = experiment.repeats;
  compare.anisotropy = experiment.anisotropy;
  compare.tile = settings.tile;
  compare.cache = settings.cache;
  compare.context = settings.context;
  if (settings.quick) make_quick(compare);
  return compare;
}

Results run_experiment(const Experiment& experiment, const RunSettings& settings, const std::filesystem::path& folder,
                       const Progress& progress) {
  Results results = run_compare(compare_settings(experiment, settings), folder, {}, progress);
  results.experiment = judge(experiment, results);
  results.experiment->quick = settings.quick;
  results.experiment->pictures = write_figures(experiment.figure, experiment, results, folder);
  return results;
}

}  // namespace footprint
