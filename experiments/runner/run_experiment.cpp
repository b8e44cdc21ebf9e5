// Runs an experiment's comparison, and adds NDFs, quantities and composed figures to its results.
#include "experiments/runner/run_experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "experiments/runner/composed_figure.hpp"
#include "experiments/runner/judge.hpp"
#include "experiments/settings/known_methods.hpp"
#include "experiments/studies/ndf_inspection.hpp"
#include "experiments/studies/run_info.hpp"
#include "experiments/studies/views.hpp"
#include "methods/registry.hpp"
#include "renderer/bake/baked_method.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/names.hpp"
#include "renderer/scene/assembly/load_scene.hpp"
#include "results/report/record_fields.hpp"
#include "results/report/report.hpp"

namespace footprint {

/// The figures of an experiment that are not about images.
struct FurtherFigures {
  std::vector<FootprintNdf> ndf;
  std::vector<QuantityFigure> quantities;
};

void fields(auto& archive, Is<FurtherFigures> auto& value) {
  archive("ndf", value.ndf);
  archive("quantities", value.quantities);
}

namespace {

constexpr int quick_spp = 16;
constexpr int quick_repeats = 1;
constexpr int quick_divisor = 4;
constexpr int quick_texels = 256;   // a side of surfaces that are made: bakes grow with them
constexpr int quick_default = 128;  // pixels per side where the experiment gives no size

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

bool has_further_figures(const Experiment& experiment) {
  return !experiment.footprints.empty() || !experiment.quantities.empty();
}

// The inputs of the figures besides the settings.
std::vector<std::string> figure_content(const Experiment& experiment) {
  std::vector<std::string> content;
  for (const auto& [name, rect] : experiment.footprints) {
    const auto& [lower, upper] = rect;
    content.push_back(fmt::format("{} {} {} {} {}", name, lower.x, lower.y, upper.x, upper.y));
  }
  for (const NamedQuantity& quantity : experiment.quantities) {
    content.push_back(fmt::format("{} {} {}", quantity.name, quantity.quantity, quantity.material));
    for (const auto& [name, value] : quantity.parameters) content.push_back(fmt::format("{}={}", name, value));
  }
  return content;
}

const Material& material_of(const NamedQuantity& named, const Scene& scene) {
  std::vector<std::string> names;
  for (const Material& material : scene.materials) {
    if (named.material.empty() || material.name == named.material) return material;
    names.push_back(material.name);
  }
  throw Error(ErrorKind::usage, scene.source, fmt::format("has no material `{:.80}`", named.material),
              suggestion(named.material, names));
}

// The experiment's quantities, each for every method that has it. Errors (usage): of the figure, naming quantity and
// method; a material that the scene does not have.
std::vector<QuantityFigure> measure_quantities(const Experiment& experiment, const Scene& scene,
                                               const Progress& progress) {
  std::vector<QuantityFigure> figures;
  if (experiment.quantities.empty()) return figures;
  ProgressParts parts(progress, static_cast<double>(experiment.quantities.size() * experiment.run.methods.size()));
  for (const NamedQuantity& named : experiment.quantities) {
    for (const MethodSpec& spec : experiment.run.methods) {
      parts.next(1, "")(fmt::format("{} of {}", named.name, spec.text), 0.0);
      const Method& method = find_method(spec);
      const Quantity* const quantity = find_quantity(method, named.quantity);
      if (quantity == nullptr) continue;
      try {
        const Options options = options_of(method, spec);
        const Options parameters(quantity->parameters, named.parameters, "figure " + named.quantity);
        const double value = quantity->measure(material_of(named, scene), options, parameters);
        figures.push_back({.name = named.name, .method = spec.text, .quantity = named.quantity, .value = value});
      } catch (const Error& error) {
        throw error.within(fmt::format("[[quantity]] {} of {}", named.name, spec.text));
      }
    }
  }
  return figures;
}

FurtherFigures measured_figures(const Experiment& experiment, const Scene& scene, const std::filesystem::path& folder,
                                const Progress& progress) {
  FurtherFigures figures;
  ProgressParts parts(progress, static_cast<double>(experiment.footprints.size() + 1));
  for (const NamedFootprint& footprint : experiment.footprints) {
    const NdfSource source = load_ndf_source({.path = experiment.run.scene}, "", experiment.run.scene_library);
    std::ranges::move(
        inspected(experiment, source, footprint, folder, parts.next(1, "footprint " + footprint.name + ": ")),
        std::back_inserter(figures.ndf));
  }
  if (!experiment.quantities.empty()) figures.quantities = measure_quantities(experiment, scene, parts.next(1, ""));
  return figures;
}

// NDFs and quantities, measured or read back. Errors (usage): they are not finished, and must be.
FurtherFigures further_figures(const Experiment& experiment, const std::filesystem::path& folder,
                               const Progress& progress, const FinishedWork* finished) {
  const RunSettings& run = experiment.run;
  const Scene scene = load_scene(run.scene, run.scene_library, run.overrides);
  if (finished == nullptr) return measured_figures(experiment, scene, folder, progress);
  const std::string key =
      run_fingerprint(finished->maker(), run, scene, scene_content(scene), figure_content(experiment)) + "/figures";
  if (auto known = finished->find<FurtherFigures>(key, folder)) return std::move(*known);
  finished->require_more_allowed(run.scene);
  FurtherFigures figures = measured_figures(experiment, scene, folder, progress);
  finished->store(key, figures, folder, files_below(folder, "ndf"));
  return figures;
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
  run.reference.fixed_spp = true;  // no noise is waited for
  run.timing.repeats = std::min(run.timing.repeats, quick_repeats);
  if (!run.view.quick_size) {
    run.view.quick_size =
        run.view.size ? glm::max(*run.view.size / quick_divisor, glm::ivec2(1)) : glm::ivec2(quick_default);
  }
  run.view.size = run.view.quick_size;
  run.overrides.most_texels = quick_texels;
}

Results run_experiment(const Experiment& experiment, const std::filesystem::path& folder, const Progress& progress,
                       const CompareContext& context) {
  ProgressParts parts(progress, has_further_figures(experiment) ? 6 : 4);
  Results results = run_compare(experiment.run, folder, parts.next(4, ""), context);
  results.coordinates = experiment.coordinates;
  if (has_further_figures(experiment)) {
    FurtherFigures figures = further_figures(experiment, folder, parts.next(2, ""), context.finished);
    results.ndf = std::move(figures.ndf);
    results.quantities = std::move(figures.quantities);
  }
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
  if (has_further_figures(experiment)) units.emplace_back();
  return units;
}

void measure_unit(const Experiment& experiment, const WorkUnit& unit, const std::filesystem::path& folder,
                  const Progress& progress, const CompareContext& context) {
  if (!unit.distances.empty()) {
    measure_views(experiment.run, unit.distances, folder, progress, context);
    return;
  }
  (void)further_figures(experiment, folder, progress, context.finished);
}

}  // namespace footprint
