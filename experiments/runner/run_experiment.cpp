// Runs an experiment's comparison, and adds NDFs, quantities and composed figures to its results.
#include "experiments/runner/run_experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>

#include "experiments/runner/composed_figure.hpp"
#include "experiments/runner/judge.hpp"
#include "experiments/runner/quantities.hpp"
#include "experiments/studies/kept_comparison.hpp"
#include "experiments/studies/ndf_inspection.hpp"
#include "experiments/studies/zoom.hpp"
#include "renderer/scene/assembly/load_scene.hpp"

namespace footprint {
namespace {

constexpr int quick_spp = 16;
constexpr int quick_repeats = 1;
constexpr int quick_divisor = 4;
constexpr int quick_texels = 256;   // a side of surfaces that are made: bakes grow with them
constexpr int quick_default = 128;  // pixels a side where the experiment gives no size

// Looks into one footprint, in a folder ndf/NAME of its own.
std::vector<FootprintNdf> inspected(const Experiment& experiment, const NdfSource& source,
                                    const NamedFootprint& footprint, const std::filesystem::path& folder,
                                    const Progress& progress) {
  const std::string subfolder = "ndf/" + footprint.name;
  std::filesystem::create_directories(folder / subfolder / "images");
  const NdfSettings wanted{.run = experiment.run, .footprint = footprint.rect};
  const NdfResults found = inspect_ndf(source, wanted, folder / subfolder, progress);
  std::vector<FootprintNdf> figures;
  for (const NdfRecord& record : found.records) {
    figures.push_back({.footprint = footprint.name,
                       .method = record.method,
                       .l2 = record.l2,
                       .energy = record.energy,
                       .peak = record.peak,
                       .lobes = record.lobes,
                       .picture = subfolder + "/" + found.strip});
  }
  return figures;
}

// The files of a folder below `folder`, relative to that.
std::vector<std::string> files_below(const std::filesystem::path& folder, const std::string& subfolder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / subfolder)) {
    if (entry.is_regular_file()) files.push_back(entry.path().lexically_relative(folder).string());
  }
  std::ranges::sort(files);
  return files;
}

bool looks_further(const Experiment& experiment) {
  return !experiment.footprints.empty() || !experiment.quantities.empty();
}

// What an experiment asks for beside its comparison: NDFs and quantities, each kept on its own.
class FurtherFigures {
 public:
  FurtherFigures(const Experiment& experiment, const std::filesystem::path& folder, const KeptWork* kept)
      : experiment_(experiment),
        folder_(folder),
        kept_(kept),
        scene_(load_scene(experiment.run.scene, experiment.run.scene_library, experiment.run.overrides)) {
    if (kept_ != nullptr)
      keys_.emplace(*kept_, experiment.run, scene_, scene_content(scene_), run_distances(experiment.run.view, scene_));
  }

  void add_to(Results& results, const Progress& progress) {
    ProgressParts parts(progress, static_cast<double>(experiment_.footprints.size() + 1));
    for (const NamedFootprint& footprint : experiment_.footprints)
      std::ranges::move(ndf_of(footprint, parts.next(1, "footprint " + footprint.name + ": ")),
                        std::back_inserter(results.ndf));
    if (!experiment_.quantities.empty()) results.quantities = quantities(parts.next(1, ""));
  }

 private:
  std::vector<FootprintNdf> ndf_of(const NamedFootprint& footprint, const Progress& progress) {
    const auto& [lower, upper] = footprint.rect;
    const std::string key =
        key_of("ndf", {footprint.name, fmt::format("{} {} {} {}", lower.x, lower.y, upper.x, upper.y)});
    if (auto known = found<std::vector<FootprintNdf>>(key)) return *known;
    const NdfSource source = load_ndf_source(experiment_.run.scene, "", experiment_.run.scene_library);
    std::vector<FootprintNdf> figures = inspected(experiment_, source, footprint, folder_, progress);
    if (kept_ != nullptr) kept_->keep(key, figures, folder_, files_below(folder_, "ndf/" + footprint.name));
    return figures;
  }

  std::vector<QuantityFigure> quantities(const Progress& progress) {
    std::vector<std::string> asked;
    for (const NamedQuantity& quantity : experiment_.quantities) {
      asked.push_back(fmt::format("{} {} {}", quantity.name, quantity.quantity, quantity.material));
      for (const auto& [name, value] : quantity.parameters) asked.push_back(name + "=" + value);
    }
    const std::string key = key_of("quantities", asked);
    if (auto known = found<std::vector<QuantityFigure>>(key)) return *known;
    std::vector<QuantityFigure> figures = measure_quantities(experiment_, scene_, progress);
    if (kept_ != nullptr) kept_->keep(key, figures, folder_);
    return figures;
  }

  [[nodiscard]] std::string key_of(std::string_view kind, const std::vector<std::string>& more) const {
    return keys_ ? keys_->of_scene(kind, more) : "";
  }

  // Errors (usage): it is not kept, where all of it must be.
  template <class T>
  std::optional<T> found(const std::string& key) const {
    if (kept_ == nullptr) return {};
    auto known = kept_->find<T>(key, folder_);
    if (!known) kept_->require_more_allowed(experiment_.run.scene);
    return known;
  }

  const Experiment& experiment_;
  const std::filesystem::path& folder_;
  const KeptWork* kept_;
  Scene scene_;
  std::optional<ComparisonKeys> keys_;  // where work is kept
};

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
  run.reference.fixed_spp = true;  // no noise is waited for
  run.timing.repeats = std::min(run.timing.repeats, quick_repeats);
  if (!run.view.quick_size) {
    run.view.quick_size =
        run.view.size ? glm::max(*run.view.size / quick_divisor, glm::ivec2(1)) : glm::ivec2(quick_default);
  }
  run.view.size = run.view.quick_size;
  run.overrides.most_texels = quick_texels;
}

Results run_experiment(const Experiment& experiment, const FurtherTimes& further_times,
                       const std::filesystem::path& folder, const Progress& progress, const KeptWork* kept,
                       const RecordWatch& watch) {
  ProgressParts parts(progress, looks_further(experiment) ? 6 : 4);
  Results results = run_compare(experiment.run, folder, further_times, parts.next(4, ""), nullptr, kept, watch);
  results.coordinates = experiment.coordinates;
  if (looks_further(experiment)) FurtherFigures(experiment, folder, kept).add_to(results, parts.next(2, ""));
  results.experiment = judge(experiment, std::span(&results, 1));
  results.experiment->quick = experiment.quick;
  results.experiment->pictures = write_figures(experiment.figure, experiment, results, folder);
  std::ranges::copy(ndf_pictures(results), std::back_inserter(results.experiment->pictures));
  return results;
}

std::vector<WorkUnit> work_units(const Experiment& experiment) {
  const std::size_t count = distances_of(experiment).size();
  std::vector<WorkUnit> units;
  for (std::size_t i = 0; i < count; ++i) {
    if (i == 0 || experiment.run.view.zoom.frames == 0) units.emplace_back();
    units.back().distances.push_back(i);
  }
  if (looks_further(experiment)) units.emplace_back();
  return units;
}

void measure_unit(const Experiment& experiment, const WorkUnit& unit, const FurtherTimes& further_times,
                  const std::filesystem::path& folder, const Progress& progress, const KeptWork& kept,
                  const RecordWatch& watch) {
  if (!unit.distances.empty())
    return measure_distances(experiment.run, unit.distances, folder, further_times, kept, progress, watch);
  Results figures;
  FurtherFigures(experiment, folder, &kept).add_to(figures, progress);
}

}  // namespace footprint
