// One comparison from its stage to its records: each distance in turn, as far as it is not kept, then what all of them
// share.
#include "experiments/studies/compare.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <utility>

#include "experiments/studies/error_pictures.hpp"
#include "experiments/studies/exposure.hpp"
#include "experiments/studies/kept_comparison.hpp"
#include "experiments/studies/method_pairs.hpp"
#include "experiments/studies/method_record.hpp"
#include "experiments/studies/picture_files.hpp"
#include "experiments/studies/reference_noise.hpp"
#include "experiments/studies/run_info.hpp"
#include "experiments/studies/stage.hpp"
#include "experiments/studies/truth.hpp"
#include "experiments/studies/zoom.hpp"
#include "renderer/core/host.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/image/metrics.hpp"
#include "renderer/pipeline/unresolved.hpp"
#include "renderer/scene/assembly/load_scene.hpp"
#include "results/report/ranking.hpp"

namespace footprint {
namespace {

// Kept of each distance until the end: of each method the image and its error (a quarter as large). Beside them what is
// worked on: most of all the strips of one distance, made of all its pictures in 5 steps.
int pictures_held(std::size_t methods, std::size_t distances) {
  const double kept = static_cast<double>(distances) * 1.25 * static_cast<double>(methods);
  constexpr double own_of_the_reference = 10;  // with its masks and the bound
  return static_cast<int>(std::ceil(kept + 5.0 * static_cast<double>(methods + 1) + own_of_the_reference));
}

double weight_of_methods(const RunSettings& settings) {
  return static_cast<double>(settings.methods.size()) * (settings.reference.spp + settings.timing.repeats);
}

// One distance of a comparison, as far as it is known.
struct DistanceWork {
  std::optional<KeptTruth> truth;
  std::vector<std::optional<Draft>> drafts;  // one a method, without times
  std::optional<std::vector<MethodPair>> pairs;
  std::optional<KeptTimes> times;

  [[nodiscard]] bool is_drawn() const {
    return truth && pairs && std::ranges::all_of(drafts, [](const auto& draft) { return draft.has_value(); });
  }
};

class Comparison {
 public:
  Comparison(const RunSettings& settings, std::filesystem::path folder, const Progress& progress, const KeptWork* kept,
             RecordWatch watch, SharedWork* shared = nullptr)
      : settings_(settings),
        folder_(std::move(folder)),
        kept_(kept),
        watch_(std::move(watch)),
        shared_(shared),
        whole_(progress, 4),
        scene_(shared_ != nullptr ? Scene{} : load_scene(settings.scene, settings.scene_library, settings.overrides)),
        size_(frame_size(loaded(), settings.view.size)),
        distances_(run_distances(settings.view, loaded())),
        stage_progress_(whole_.next(1, "")),
        parts_(whole_.next(3, ""),
               static_cast<double>(distances_.size()) * (TruthFinder::weight(settings) + weight_of_methods(settings))) {
    require_pictures(size_, pictures_held(settings.methods.size(), distances_.size()));
    if (kept_ == nullptr) return;
    keys_.emplace(*kept_, settings_, loaded(), shared_ != nullptr ? shared_->content : scene_content(loaded()),
                  distances_);
    if (shared_ != nullptr && shared_->kept_as.empty()) shared_->kept_as = keys_->truth_content();
  }

  Results run(const FurtherTimes& further_times, const ResultsWatch& so_far) {
    further_ = &further_times;
    std::filesystem::create_directories(folder_ / "images");
    for (std::size_t i = 0; i < distances_.size(); ++i) {
      DistanceWork work = measured(i);
      const KeptTruth truth = *work.truth;
      add(i, std::move(work));
      write_pictures(i, truth);
      if (so_far && i + 1 < distances_.size()) so_far(results());
    }
    write_shared_pictures();
    return results();
  }

  void measure(std::span<const std::size_t> wanted, const FurtherTimes& further_times) {
    further_ = &further_times;
    std::filesystem::create_directories(folder_ / "images");
    for (const std::size_t i : wanted) add(i, measured(i));
    (void)head();
  }

  FrameTimes times() {
    FrameTimes all;
    for (const double distance : distances_) all.push_back(time_distance(distance));
    return all;
  }

 private:
  // ---- what is made where something is to be drawn, and not before

  const Stage& stage() {
    if (!stage_) {
      if (kept_ != nullptr) kept_->require_more_allowed(settings_.scene);
      auto prepared =
          shared_ != nullptr ? shared_->scene : std::make_shared<PreparedScene>(std::move(scene_), settings_);
      stage_ = std::make_unique<Stage>(std::move(prepared), settings_, stage_progress_, pictures_of_a_frame,
                                       Unit::direct, Refusal::keeps_a_row);
      measurer_.emplace(*stage_);
    }
    return *stage_;
  }

  // Before there is a stage.
  [[nodiscard]] const Scene& loaded() const { return shared_ != nullptr ? shared_->scene->scene : scene_; }

  // As it was loaded, or as the stage has it: no second copy of a large one.
  [[nodiscard]] const Scene& scene() const { return stage_ ? stage_->scene() : loaded(); }

  TruthFinder& finder() {
    if (!finder_)
      finder_.emplace(
          settings_, stage(), folder_, [this](const Image& first) { return choose(first); }, parts_,
          shared_ != nullptr ? &shared_->truth : nullptr);
    return *finder_;
  }

  const StagedMethod& method(std::size_t index) { return stage().methods()[index]; }

  float choose(const Image& first_reference) {
    exposure_ = choose_exposure(settings_.view.exposure, scene(), first_reference);
    return exposure_->factor;
  }

  // ---- one distance

  DistanceWork measured(std::size_t i) {
    DistanceWork work = found(i);
    if (work.truth) exposure_ = work.truth->exposure;
    if (!work.is_drawn()) draw(i, work);
    show_errors(work);
    if (!work.times) work.times = keep(keys_ ? keys_->times(i) : "", take_times(i), {});
    return work;
  }

  // ---- what is known before times are taken, for whom it may be enough

  void show_floors(const Truth& truth) {
    if (!watch_) return;
    Record floors;
    floors.distance = truth.distance;
    floors.frame = static_cast<int>(truth.frame);
    RecordError& error = floors.error.emplace();
    error.noise_floor = truth.noise_floor;
    error.causes.shading_floor = truth.shading_floor;
    if (truth.shading_floor) error.causes.shading = 0.0;
    for (const OtherTruth& other : truth.others)
      floors.other_references.push_back({.spp = other.spp, .normalized_color = 0, .noise_floor = other.noise_floor});
    std::vector<Record> records(settings_.methods.size(), floors);
    for (std::size_t m = 0; m < records.size(); ++m) records[m].method = settings_.methods[m].text;
    watch_(records);
  }

  void show_errors(const DistanceWork& work) {
    if (!watch_) return;
    std::vector<Record> records;
    records.reserve(work.drafts.size());
    for (const std::optional<Draft>& draft : work.drafts) records.push_back(draft->record);
    watch_(records);
  }

  // What was kept of it.
  DistanceWork found(std::size_t i) {
    DistanceWork work;
    work.drafts.resize(settings_.methods.size());
    if (!keys_) return work;
    work.truth = kept_->find<KeptTruth>(keys_->truth(i), folder_);
    work.pairs = kept_->find<std::vector<MethodPair>>(keys_->pairs(i), folder_);
    work.times = kept_->find<KeptTimes>(keys_->times(i), folder_);
    if (!work.truth) return work;
    for (std::size_t m = 0; m < settings_.methods.size(); ++m) work.drafts[m] = found_draft(i, m, *work.truth);
    return work;
  }

  std::optional<Draft> found_draft(std::size_t i, std::size_t m, const KeptTruth& truth) {
    auto kept = kept_->find<KeptRecord>(keys_->record(i, m), folder_);
    if (!kept) return {};
    kept->record.frame = static_cast<int>(i);
    Image picture = read_image(folder_ / kept->record.images.color, Transfer::linear);
    Image error = error_map(picture, counted_reference(truth), truth.exposure.factor);
    return Draft{
        .record = std::move(kept->record),
        .exhibit = {.caption = settings_.methods[m].text, .picture = std::move(picture), .error = std::move(error)},
        .stem = std::move(kept->stem),
        .name = std::move(kept->name)};
  }

  [[nodiscard]] Image whole_reference(const KeptTruth& truth) const {
    return read_image(folder_ / truth.files.reference, Transfer::linear);
  }

  // The reference without the pixels that it does not resolve.
  [[nodiscard]] Image counted_reference(const KeptTruth& truth) const {
    Image reference = whole_reference(truth);
    uncover(reference, mask_of(truth.unresolved, reference.width, reference.height));
    return reference;
  }

  // Whatever it lacks of what is drawn, each part kept as soon as it is there.
  void draw(std::size_t i, DistanceWork& work) {
    Truth truth = truth_of(i);
    if (!work.truth) work.truth = keep(keys_ ? keys_->truth(i) : "", outline(truth), files_of(truth.files));
    show_floors(truth);
    std::vector<Draft> drafts;
    for (std::size_t m = 0; m < settings_.methods.size(); ++m) {
      drafts.push_back(work.drafts[m] ? std::move(*work.drafts[m]) : kept_draft(truth, i, m));
    }
    if (!work.pairs) {
      std::vector<MethodPair> pairs = compare_pairs(folder_, drafts, truth, exposure_->factor);
      std::vector<std::string> files;
      files.reserve(pairs.size());
      for (const MethodPair& pair : pairs) files.push_back(pair.picture);
      work.pairs = keep(keys_ ? keys_->pairs(i) : "", std::move(pairs), files);
    }
    std::ranges::move(drafts, work.drafts.begin());
    before_ = {i, std::move(truth.reference)};
  }

  Truth truth_of(std::size_t i) {
    if (exposure_) {
      finder().set_exposure(exposure_->factor);
    } else if (i > 0) {
      finder().choose_exposure(distances_.front());
    }
    if (!keys_ || shared_ == nullptr || shared_->truth.at(distances_[i])) return finder().find(i, distances_[i]);
    const std::string key = keys_->shared_truth(shared_->kept_as, i);
    auto known = kept_->find<SharedTruth::AtDistance>(key, folder_);
    if (known) {
      shared_->truth.distances.push_back(std::move(*known));
      return finder().find(i, distances_[i]);
    }
    Truth truth = finder().find(i, distances_[i]);
    kept_->keep(key, *shared_->truth.at(distances_[i]), folder_);
    return truth;
  }

  KeptTruth outline(const Truth& truth) {
    return {.exposure = *exposure_,
            .standard_error = relative_standard_error(truth.reference),
            .samples = truth.samples,
            .seconds = truth.seconds,
            .unresolved = set_pixels(truth.unresolved),
            .files = truth.files,
            .curve = truth.curve,
            .warnings = truth.warnings};
  }

  Draft kept_draft(const Truth& truth, std::size_t i, std::size_t m) {
    Draft draft = compare_method(truth, m);
    if (keys_ && !draft.record.failure)
      kept_->keep(keys_->record(i, m), KeptRecord{draft.record, draft.stem, draft.name}, folder_,
                  exposable_files(draft.record.images.color));
    return draft;
  }

  Draft compare_method(const Truth& truth, std::size_t index) {
    const StagedMethod& staged = method(index);
    Draft draft{.record = {}, .exhibit = {}, .stem = {}, .name = method_stem(settings_.methods, index)};
    draft.stem = distance_stem(truth.distance, draft.name);
    std::optional<Error> failure = staged.refusal();
    if (!failure)
      failure = failure_of(stage().context(), settings_.methods[index], [&] { measure(draft, truth, staged, index); });
    if (failure) {
      draft.record = measurer_->failed(staged, truth, *failure);
      draft.exhibit = {};
      return draft;
    }
    draft.record.images.color = write_exposable_picture(folder_, draft.stem, draft.exhibit.picture, exposure_->factor);
    return draft;
  }

  // Renders a method and compares it with the reference.
  void measure(Draft& draft, const Truth& truth, const StagedMethod& staged, std::size_t index) {
    const std::string& text = settings_.methods[index].text;
    const std::string prefix = fmt::format("distance {:g}: {}, ", truth.distance, text);
    MethodPictures pictures{.frame = staged.frames().render(truth.view), .finest = {}};
    if (settings_.reference.by_cause) pictures.finest = finest_level(truth, staged, prefix);
    stage().context().check("rendering " + text);
    draft.record = measurer_->measure(staged, pictures, truth, exposure_->factor);
    draft.record.work = measurer_->work_of(staged, truth.view);
    set_flicker(draft.record, truth, pictures.frame, index);
    Image error = error_map(pictures.frame, truth.reference.mean, exposure_->factor);
    draft.exhibit = {.caption = text, .picture = std::move(pictures.frame), .error = std::move(error)};
  }

  Image finest_level(const Truth& truth, const StagedMethod& staged, const std::string& prefix) {
    Image finest = finest_mean(stage().finest_level(staged), truth.view, settings_.reference,
                               parts_.next(finest_samples(settings_.reference), prefix + "finest level, "));
    if (truth.first.texels.empty()) return finest;
    return as_converged(finest, truth.first, truth.reference.mean);
  }

  // Against the frame before: the picture of the same method, one round of drafts earlier.
  void set_flicker(Record& record, const Truth& truth, const Image& picture, std::size_t index) {
    if (settings_.view.zoom.frames == 0 || truth.frame == 0) return;
    const Draft& frame_before = drafts_[(truth.frame - 1) * settings_.methods.size() + index];
    if (frame_before.record.failure) return;
    const Image& before = frame_before.exhibit.picture;
    record.flicker =
        flicker_between(before, picture, reference_before(truth.frame), truth.reference, exposure_->factor);
  }

  // Of the frame before; drawn again where that one was kept.
  const Supersampled& reference_before(std::size_t frame) {
    if (before_.first + 1 != frame || before_.second.spp == 0)
      before_ = {frame - 1, std::move(truth_of(frame - 1).reference)};
    return before_.second;
  }

  // ---- times

  DistanceTimes time_distance(double distance) {
    const double weight = static_cast<double>(settings_.methods.size()) * settings_.timing.repeats;
    return time_methods(stage(), stage().view(distance), settings_.timing.repeats,
                        parts_.next(weight, fmt::format("distance {:g}: ", distance)));
  }

  KeptTimes take_times(std::size_t i) {
    if (!further_known_) further_known_ = *further_ ? (*further_)() : std::vector<FrameTimes>{};
    KeptTimes times{.processes = {}, .builds = build_timings(stage()), .unit = stage().unit(), .node = host_name()};
    for (const FrameTimes& process : *further_known_) times.processes.push_back(process.at(i));
    times.processes.push_back(time_distance(distances_[i]));
    return times;
  }

  // ---- the whole

  template <class T>
  T keep(const std::string& key, T value, const std::vector<std::string>& files) {
    if (keys_) kept_->keep(key, value, folder_, files);
    return value;
  }

  void add(std::size_t i, DistanceWork work) {
    std::vector<std::reference_wrapper<Record>> records;
    for (std::optional<Draft>& draft : work.drafts) {
      draft->record.node = work.times->node;
      records.emplace_back(draft->record);
    }
    set_times(records, work.times->builds, work.times->processes, work.times->unit);
    for (const Record& record : records) {
      if (record.failure)
        results_.scene.warnings.push_back(
            fmt::format("distance {:g}: {} failed: {}", record.distance, record.method, *record.failure));
    }
    for (std::optional<Draft>& draft : work.drafts) drafts_.push_back(std::move(*draft));
    std::ranges::move(*work.pairs, std::back_inserter(results_.pairs));
    results_.reference.standard_errors.push_back(work.truth->standard_error);
    results_.reference.samples += work.truth->samples;
    results_.reference.seconds += work.truth->seconds;
    std::ranges::move(work.truth->curve, std::back_inserter(results_.supersampling));
    std::ranges::move(work.truth->warnings, std::back_inserter(results_.scene.warnings));
    if (auto warning = linear_measures_warning(distances_[i], work.truth->standard_error))
      results_.scene.warnings.push_back(std::move(*warning));
    processes_ = static_cast<int>(work.times->processes.size());
  }

  // What does not wait for the other distances.
  void write_pictures(std::size_t i, const KeptTruth& truth) {
    const std::span<Draft> drafts = drafts_at(i);
    const double scale = error_scale(drafts, settings_.view.error_scale);
    results_.error_scales.push_back({.distance = distances_[i], .error = scale});
    write_distance_strips(folder_,
                          {.caption = fmt::format("reference, {:.0f} spp", truth.samples),
                           .picture = whole_reference(truth),
                           .error = {}},
                          drafts, exposure_->factor, scale);
    write_error_pictures(folder_, drafts, scale);
  }

  // The drafts stand in the order of the distances, as many for each as there are methods.
  [[nodiscard]] std::span<Draft> drafts_at(std::size_t distance) {
    return std::span(drafts_).subspan(distance * settings_.methods.size(), settings_.methods.size());
  }

  void write_shared_pictures() {
    const double shared = error_scale(drafts_, settings_.view.error_scale);
    for (std::size_t i = 0; i < distances_.size(); ++i) {
      if (results_.error_scales[i].error != shared) write_shared_error_pictures(folder_, drafts_at(i), shared);
    }
  }

  // Of the distances that are done.
  Results results() {
    Results results = results_;
    results.error_scale = error_scale(drafts_, settings_.view.error_scale);
    for (const Draft& draft : drafts_) results.records.push_back(draft.record);
    results.reference.samples /= static_cast<double>(results_.error_scales.size());
    describe(results);
    return results;
  }

  void describe(Results& results) {
    KeptHead said = head();
    results.backend = std::move(said.backend);
    results.reference.spp = settings_.reference.spp;
    results.reference.filter = word_for(reference_filters, settings_.reference.filter);
    results.reference.seed = settings_.reference.seed;
    results.footprint = std::move(said.footprint);
    results.timing = {.frames = settings_.timing.repeats, .processes = processes_};
    if (said.lit_by_environment)
      results.reference.environment = word_for(reference_integrals, settings_.reference.environment);
    std::vector<std::string> notes = std::move(said.first_warnings);
    std::ranges::move(results.scene.warnings, std::back_inserter(notes));
    results.scene = std::move(said.scene);
    results.scene.exposure = exposure_->factor;
    results.scene.exposure_source = word_for(exposure_sources, exposure_->source);
    std::ranges::move(notes, std::back_inserter(results.scene.warnings));
    std::ranges::move(said.last_warnings, std::back_inserter(results.scene.warnings));
  }

  KeptHead head() {
    const std::string key = keys_ ? keys_->head() : "";
    if (auto known = keys_ ? kept_->find<KeptHead>(key, folder_) : std::nullopt) return std::move(*known);
    KeptHead head{.backend = backend_info(stage().context().info()),
                  .scene = stage().info({}),
                  .footprint = footprint_filter_text(footprint_filter_of(settings_, scene())),
                  .lit_by_environment = has(stage().effects(), Effect::environment_light),
                  .first_warnings = finder().warnings(),
                  .last_warnings = {}};
    add_left_out(head.last_warnings);
    add_precompute_notes(head.last_warnings);
    return keep(key, std::move(head), {});
  }

  void add_left_out(std::vector<std::string>& warnings) {
    const EffectSet left_out = effects_on(stage().decisions()) & settings_.without;
    if (left_out.none()) return;
    warnings.push_back(fmt::format("left out of every image, the reference's too, as was asked: {}",
                                   fmt::join(effect_names(left_out), ", ")));
  }

  void add_precompute_notes(std::vector<std::string>& warnings) {
    for (std::size_t m = 0; m < settings_.methods.size(); ++m) {
      const BakedMethod& baked = method(m).baked();
      for (std::size_t i = 0; i < baked.materials.size(); ++i) {
        for (const std::string& note : baked.materials[i].notes)
          warnings.push_back(
              fmt::format("{}, material {}: {}", baked.spec.text, stage().scene().materials[i].name, note));
      }
    }
  }

  const RunSettings& settings_;
  std::filesystem::path folder_;
  const KeptWork* kept_;
  RecordWatch watch_;
  SharedWork* shared_;
  ProgressParts whole_;
  Scene scene_;
  glm::ivec2 size_;
  std::vector<double> distances_;
  std::optional<ComparisonKeys> keys_;  // where work is kept
  Progress stage_progress_;
  ProgressParts parts_;
  std::unique_ptr<Stage> stage_;
  std::optional<MethodMeasurer> measurer_;
  std::optional<TruthFinder> finder_;
  const FurtherTimes* further_ = nullptr;
  std::optional<std::vector<FrameTimes>> further_known_;
  std::optional<Exposure> exposure_;
  std::vector<Draft> drafts_;
  std::pair<std::size_t, Supersampled> before_{};  // a frame and its reference
  int processes_ = 1;
  Results results_;  // without records; the reference's samples are a sum over the distances that are done
};

}  // namespace

FrameTimes time_frames(const RunSettings& settings, const Progress& progress) {
  return Comparison(settings, {}, progress, nullptr, {}).times();
}

Results run_compare(const RunSettings& settings, const std::filesystem::path& folder, const FurtherTimes& further_times,
                    const Progress& progress, SharedWork* shared, const KeptWork* kept, const RecordWatch& watch,
                    const ResultsWatch& so_far) {
  return Comparison(settings, folder, progress, kept, watch, shared).run(further_times, so_far);
}

void measure_distances(const RunSettings& settings, std::span<const std::size_t> distances,
                       const std::filesystem::path& folder, const FurtherTimes& further_times, const KeptWork& kept,
                       const Progress& progress, const RecordWatch& watch) {
  Comparison(settings, folder, progress, &kept, watch).measure(distances, further_times);
}

}  // namespace footprint
