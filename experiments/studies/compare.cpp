// One comparison from its stage to its records: each distance in turn, then what all of them share.
#include "experiments/studies/compare.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "experiments/studies/error_pictures.hpp"
#include "experiments/studies/exposure.hpp"
#include "experiments/studies/method_pairs.hpp"
#include "experiments/studies/method_record.hpp"
#include "experiments/studies/picture_files.hpp"
#include "experiments/studies/reference_noise.hpp"
#include "experiments/studies/run_info.hpp"
#include "experiments/studies/stage.hpp"
#include "experiments/studies/truth.hpp"
#include "experiments/studies/zoom.hpp"
#include "renderer/image/metrics.hpp"
#include "renderer/pipeline/unresolved.hpp"
#include "renderer/scene/assembly/load_scene.hpp"
#include "results/report/ranking.hpp"

namespace footprint {
namespace {

// `direct` is what every ratio is taken to: it is staged first, also where it is not asked for, and looks its maps up
// by one trilinear lookup whatever the footprint filter, so that ratios of several filters compare.
constexpr FootprintFilter filter_of_the_unit{FootprintFilterKind::trilinear, 1};

RunSettings with_direct(RunSettings settings) {
  settings.methods.insert(settings.methods.begin(), {.text = "direct", .name = "direct", .options = {}});
  return settings;
}

// Kept of each distance until the end: the reference, and of each method the picture and its error (a quarter as
// large). Beside them what is worked on: most of all the strips of one distance, made of all its pictures in 5 steps.
int pictures_held(std::size_t methods, std::size_t distances) {
  const double kept = static_cast<double>(distances) * (1.0 + 1.25 * static_cast<double>(methods));
  constexpr double own_of_the_reference = 10;  // with its masks and the bound
  return static_cast<int>(std::ceil(kept + 5.0 * static_cast<double>(methods + 1) + own_of_the_reference));
}

double weight_of_methods(const RunSettings& settings) {
  return static_cast<double>(settings.methods.size()) * (settings.reference.spp + settings.timing.repeats);
}

class Comparison {
 public:
  Comparison(const RunSettings& settings, std::filesystem::path folder, const Progress& progress)
      : settings_(settings),
        folder_(std::move(folder)),
        whole_(progress, 4),
        stage_(load_scene(settings.scene, settings.scene_library, settings.overrides), with_direct(settings),
               whole_.next(1, ""), pictures_of_a_frame, filter_of_the_unit),
        distances_(run_distances(settings.view, stage_.scene())),
        parts_(whole_.next(3, ""),
               static_cast<double>(distances_.size()) * (TruthFinder::weight(settings) + weight_of_methods(settings))),
        measurer_(stage_) {
    require_pictures(stage_.view(1.0).size, pictures_held(settings.methods.size(), distances_.size()));
  }

  Results run(std::span<const FrameTimes> further_times, SharedTruth* shared) {
    std::filesystem::create_directories(folder_ / "images");
    TruthFinder finder(
        settings_, stage_, folder_, [this](const Image& first) { return choose(first); }, parts_, shared);
    results_.scene.warnings = finder.warnings();
    for (std::size_t i = 0; i < distances_.size(); ++i) {
      Truth truth = finder.find(i, distances_[i]);
      for (std::size_t m = 0; m < settings_.methods.size(); ++m) drafts_.push_back(compare_method(truth, m));
      std::ranges::move(compare_pairs(folder_, drafts_at(i), truth, exposure_.factor),
                        std::back_inserter(results_.pairs));
      time_records(i, further_times);
      keep(std::move(truth));
    }
    finish_error_pictures();
    describe(static_cast<int>(further_times.size()) + 1);
    return std::move(results_);
  }

  FrameTimes times() {
    FrameTimes all;
    for (const double distance : distances_) all.push_back(time_distance(distance));
    return all;
  }

 private:
  [[nodiscard]] const StagedMethod& method(std::size_t index) const { return stage_.methods()[index + 1]; }

  float choose(const Image& first_reference) {
    exposure_ = choose_exposure(settings_.view.exposure, stage_.scene(), first_reference);
    return exposure_.factor;
  }

  Draft compare_method(const Truth& truth, std::size_t index) {
    const StagedMethod& staged = method(index);
    const std::string& text = settings_.methods[index].text;
    const std::string prefix = fmt::format("distance {:g}: {}, ", truth.distance, text);
    MethodPictures pictures{.frame = staged.frames().render(truth.view), .finest = {}};
    pictures.finest = settings_.reference.finest_levels ? finest_level(truth, staged, prefix) : pictures.frame;
    stage_.context().check("rendering " + text);
    Draft draft{.record = measurer_.measure(staged, pictures, truth, exposure_.factor),
                .exhibit = {},
                .stem = {},
                .name = method_stem(settings_.methods, index)};
    draft.stem = distance_stem(truth.distance, draft.name);
    set_flicker(draft.record, truth, pictures.frame, index);
    draft.record.images.color = write_exposable_picture(folder_, draft.stem, pictures.frame, exposure_.factor);
    Image error = error_map(pictures.frame, truth.reference.mean, exposure_.factor);
    draft.exhibit = {.caption = text, .picture = std::move(pictures.frame), .error = std::move(error)};
    return draft;
  }

  Image finest_level(const Truth& truth, const StagedMethod& staged, const std::string& prefix) {
    const Image finest = finest_mean(stage_.finest_level(staged), truth.view, settings_.reference,
                                     parts_.next(finest_samples(settings_.reference), prefix + "finest level, "));
    return as_converged(finest, truth.first, truth.reference.mean);
  }

  // Against the frame before: the picture of the same method, one round of drafts earlier.
  void set_flicker(Record& record, const Truth& truth, const Image& picture, std::size_t index) const {
    if (settings_.view.zoom.frames == 0 || truth.frame == 0) return;
    const Image& before = drafts_[(truth.frame - 1) * settings_.methods.size() + index].exhibit.picture;
    record.flicker = flicker_between(before, picture, before_, truth.reference, exposure_.factor);
  }

  std::vector<std::vector<double>> time_distance(double distance) {
    const double weight = static_cast<double>(settings_.methods.size()) * settings_.timing.repeats;
    return time_methods(stage_, stage_.view(distance), settings_.timing.repeats,
                        parts_.next(weight, fmt::format("distance {:g}: ", distance)));
  }

  void time_records(std::size_t distance, std::span<const FrameTimes> further) {
    std::vector<FrameTimes> processes(further.begin(), further.end());
    processes.emplace_back(distances_.size());
    processes.back()[distance] = time_distance(distances_[distance]);
    std::vector<std::reference_wrapper<Record>> records;
    for (Draft& draft : drafts_at(distance)) records.emplace_back(draft.record);
    set_times(records, stage_, processes, distance);
    for (std::size_t m = 0; m < records.size(); ++m)
      records[m].get().work = measurer_.work_of(method(m), stage_.view(distances_[distance]));
  }

  // What outlives its distance.
  void keep(Truth truth) {
    if (truth.frame == 0) results_.reference.standard_error = relative_standard_error(truth.reference);
    results_.reference.samples += truth.samples / static_cast<double>(distances_.size());
    results_.reference.seconds += truth.seconds;
    std::ranges::move(truth.curve, std::back_inserter(results_.supersampling));
    std::ranges::move(truth.warnings, std::back_inserter(results_.scene.warnings));
    references_.push_back({.caption = fmt::format("reference, {} spp", settings_.reference.spp),
                           .picture = std::move(truth.whole),
                           .error = {}});
    before_ = std::move(truth.reference);
  }

  // The drafts stand in the order of the distances, as many for each as there are methods.
  [[nodiscard]] std::span<Draft> drafts_at(std::size_t distance) {
    return std::span(drafts_).subspan(distance * settings_.methods.size(), settings_.methods.size());
  }

  void finish_error_pictures() {
    const std::optional<double>& asked = settings_.view.error_scale;
    results_.error_scale = error_scale(drafts_, asked);
    for (std::size_t i = 0; i < distances_.size(); ++i) {
      const std::span<Draft> drafts = drafts_at(i);
      const double scale = error_scale(drafts, asked);
      results_.error_scales.push_back({.distance = distances_[i], .error = scale});
      write_distance_strips(folder_, std::move(references_[i]), drafts, exposure_.factor, scale);
      write_error_pictures(folder_, drafts, scale, results_.error_scale);
      for (Draft& draft : drafts) results_.records.push_back(std::move(draft.record));
    }
  }

  void describe(int processes) {
    results_.backend = backend_info(stage_.context().info());
    results_.reference.spp = settings_.reference.spp;
    results_.reference.filter = word_for(reference_filters, settings_.reference.filter);
    results_.reference.seed = settings_.reference.seed;
    results_.footprint = footprint_filter_text(footprint_filter_of(settings_, stage_.scene()));
    results_.timing = {.frames = settings_.timing.repeats, .processes = processes};
    if (has(stage_.effects(), Effect::environment_light))
      results_.reference.environment = word_for(reference_integrals, settings_.reference.environment);
    std::vector<std::string> notes = std::move(results_.scene.warnings);
    results_.scene = scene_info(stage_.scene(), exposure_);
    std::ranges::move(notes, std::back_inserter(results_.scene.warnings));
    if (auto warning = linear_measures_warning(results_.reference))
      results_.scene.warnings.push_back(std::move(*warning));
    add_left_out();
    add_precompute_notes();
  }

  void add_left_out() {
    const EffectSet left_out = effects_on(stage_.decisions()) & settings_.without;
    if (left_out.none()) return;
    results_.scene.warnings.push_back(fmt::format("left out of every picture, the reference's too, as was asked: {}",
                                                  fmt::join(effect_names(left_out), ", ")));
  }

  void add_precompute_notes() {
    for (std::size_t m = 0; m < settings_.methods.size(); ++m) {
      const BakedMethod& baked = method(m).baked();
      for (std::size_t i = 0; i < baked.materials.size(); ++i) {
        for (const std::string& note : baked.materials[i].notes)
          results_.scene.warnings.push_back(
              fmt::format("{}, material {}: {}", baked.spec.text, stage_.scene().materials[i].name, note));
      }
    }
  }

  const RunSettings& settings_;
  std::filesystem::path folder_;
  ProgressParts whole_;
  Stage stage_;
  std::vector<double> distances_;
  ProgressParts parts_;
  MethodMeasurer measurer_;
  Exposure exposure_;
  std::vector<Draft> drafts_;
  std::vector<Exhibit> references_;  // one a distance, for the strips
  Supersampled before_;              // the reference of the frame before
  Results results_;
};

}  // namespace

FrameTimes time_frames(const RunSettings& settings, const Progress& progress) {
  return Comparison(settings, {}, progress).times();
}

Results run_compare(const RunSettings& settings, const std::filesystem::path& folder,
                    std::span<const FrameTimes> further_times, const Progress& progress, SharedTruth* shared) {
  return Comparison(settings, folder, progress).run(further_times, shared);
}

}  // namespace footprint
