// Chooses the exposure, then for each distance: the reference, the methods, their times. Finished distances are read
// back.
#include "experiments/studies/compare.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>

#include "experiments/studies/distance_result.hpp"
#include "experiments/studies/error_pictures.hpp"
#include "experiments/studies/exposure.hpp"
#include "experiments/studies/method_pairs.hpp"
#include "experiments/studies/method_record.hpp"
#include "experiments/studies/picture_files.hpp"
#include "experiments/studies/reference_noise.hpp"
#include "experiments/studies/run_fingerprint.hpp"
#include "experiments/studies/run_info.hpp"
#include "experiments/studies/zoom.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/image/metrics.hpp"
#include "renderer/scene/assembly/load_scene.hpp"
#include "results/report/ranking.hpp"

namespace footprint {
namespace {

// Images of a frame's size at once: each method's image and its strips, and those of the reference.
int images_at_once(std::size_t methods) { return 6 * static_cast<int>(methods) + 15; }

double weight_of_methods(const RunSettings& settings) {
  return static_cast<double>(settings.methods.size()) * (settings.reference.spp + settings.timing.repeats);
}

// Everything that renders, created with the first image.
struct Workbench {
  Workbench(std::shared_ptr<PreparedScene> scene, const RunSettings& settings, const std::filesystem::path& folder,
            const Progress& staging, ProgressParts& progress, SharedReferences* shared)
      : stage(std::move(scene), settings, staging, pictures_of_a_frame, Unit::direct, Refusal::keeps_a_row),
        measurer(stage),
        references(settings, stage, folder, progress, shared) {}

  Stage stage;
  MethodMeasurer measurer;
  ReferenceRenderer references;
};

// A comparison's inputs, and its workbench once something is rendered.
struct Job {
  Job(const RunSettings& of, std::filesystem::path into, const Progress& all, const CompareContext& with)
      : settings(of),
        folder(std::move(into)),
        context(with),
        whole(all, 4),
        staging(whole.next(1, "")),
        scene(context.shared != nullptr ? Scene{}
                                        : load_scene(settings.scene, settings.scene_library, settings.overrides)),
        distances(run_distances(settings.view, loaded())),
        progress(whole.next(3, ""), static_cast<double>(distances.size()) *
                                        (ReferenceRenderer::weight(settings) + weight_of_methods(settings))) {
    require_pictures(frame_size(loaded(), settings.view.size), images_at_once(settings.methods.size()));
    if (context.finished != nullptr) run = fingerprint();
  }

  Workbench& workbench() {
    if (!bench) {
      if (context.finished != nullptr) context.finished->require_more_allowed(settings.scene);
      auto prepared = context.shared != nullptr ? context.shared->scene
                                                : std::make_shared<PreparedScene>(std::move(scene), settings);
      bench = std::make_unique<Workbench>(std::move(prepared), settings, folder, staging, progress,
                                          context.shared != nullptr ? &context.shared->references : nullptr);
    }
    return *bench;
  }

  // As it was loaded, or as the stage has it.
  [[nodiscard]] const Scene& loaded() const {
    if (bench) return bench->stage.scene();
    return context.shared != nullptr ? context.shared->scene->scene : scene;
  }

  template <class T>
  [[nodiscard]] std::optional<T> find(const std::string& part) const {
    if (context.finished == nullptr) return {};
    return context.finished->find<T>(run + "/" + part, folder);
  }
  template <class T>
  void store(const std::string& part, const T& value, const std::vector<std::string>& files = {}) const {
    if (context.finished != nullptr) context.finished->store(run + "/" + part, value, folder, files);
  }

  [[nodiscard]] std::string fingerprint() const {
    SharedWork* const shared = context.shared;
    const std::string content = shared != nullptr ? shared->content : scene_content(loaded());
    std::vector<std::string> more;
    if (shared != nullptr && !shared->first.empty()) more.push_back(shared->first);
    std::string own = run_fingerprint(context.finished->maker(), settings, loaded(), content, more);
    if (shared != nullptr && shared->first.empty()) shared->first = own;
    return own;
  }

  const RunSettings& settings;
  std::filesystem::path folder;
  const CompareContext& context;
  ProgressParts whole;
  Progress staging;
  std::unique_ptr<Workbench> bench;
  Scene scene;  // until the workbench takes it; empty if scenes are shared
  std::vector<double> distances;
  ProgressParts progress;
  std::string run;  // fingerprint, if work is stored
};

// The frame before, against which flicker is measured.
struct FrameBefore {
  std::size_t index = 0;
  Supersampled reference;
  std::vector<Image> images;  // of each method; empty: it failed
};

// ---- finished distances

std::string part_name(double distance) { return fmt::format("distance_{}", distance); }

std::vector<std::string> files_of(const DistanceResult& result) {
  std::vector<std::string> files = exposable_files(result.reference);
  for (const Record& record : result.records) {
    if (!record.failure) std::ranges::copy(exposable_files(record.images.color), std::back_inserter(files));
  }
  const RecordImages& shared = result.records.front().images;
  files.insert(files.end(), {shared.standard_error, shared.interior,
                             std::filesystem::path(shared.interior).replace_extension(".png").string()});
  for (const MethodPair& pair : result.pairs) files.push_back(pair.picture);
  return files;
}

// The indices of the pixels that a mask contains.
std::vector<std::uint32_t> set_pixels(const Image& mask) {
  std::vector<std::uint32_t> pixels;
  for (std::size_t i = 0; i < mask.texels.size(); ++i) {
    if (mask.texels[i] > 0.0F) pixels.push_back(static_cast<std::uint32_t>(i));
  }
  return pixels;
}

// A distance at which a method failed is measured again, unless everything must be there.
std::optional<DistanceResult> finished_distance(const Job& job, std::size_t i) {
  auto result = job.find<DistanceResult>(part_name(job.distances[i]));
  if (!result || result->records.size() != job.settings.methods.size()) return {};
  const bool any_failed =
      std::ranges::any_of(result->records, [](const Record& record) { return record.failure.has_value(); });
  if (any_failed && !job.context.finished->is_complete()) return {};
  for (Record& record : result->records) record.frame = static_cast<int>(i);
  if (result->wanted_noise && job.context.shared != nullptr)
    job.context.shared->references.wanted_noise.emplace(result->distance, *result->wanted_noise);
  return result;
}

// ---- one method

Image finest_level(Job& job, const ReferenceView& target, const StagedMethod& staged, const std::string& prefix) {
  const ReferenceSettings& reference = job.settings.reference;
  Image finest = finest_mean(job.workbench().stage.finest_level(staged), target.view, reference,
                             job.progress.next(finest_samples(reference), prefix + "finest level, "));
  if (target.first.texels.empty()) return finest;
  return as_converged(finest, target.first, target.reference.mean);
}

// Renders a method, measures it, and writes its image.
Image measure_method(Job& job, const ReferenceView& target, const StagedMethod& staged, std::size_t index,
                     float exposure, Record& record) {
  Workbench& bench = job.workbench();
  const std::string& text = job.settings.methods[index].text;
  const std::string prefix = fmt::format("distance {:g}: {}, ", target.distance, text);
  MethodPictures pictures{.frame = staged.frames().render(target.view), .finest = {}};
  if (job.settings.reference.by_cause) pictures.finest = finest_level(job, target, staged, prefix);
  bench.stage.context().check("rendering " + text);
  record = bench.measurer.measure(staged, pictures, target, exposure);
  bench.measurer.count_work(record, staged, target.view);
  const std::string stem = distance_stem(target.distance, method_stem(job.settings.methods, index));
  record.images.color = write_exposable_picture(job.folder, stem, pictures.frame, exposure);
  return std::move(pictures.frame);
}

// The same, or a record that says why the method failed.
Image measure_or_fail(Job& job, const ReferenceView& target, std::size_t index, float exposure, Record& record) {
  Workbench& bench = job.workbench();
  const StagedMethod& staged = bench.stage.methods()[index];
  Image image;
  std::optional<Error> failure = staged.refusal();
  if (!failure)
    failure = failure_of(bench.stage.context(), job.settings.methods[index],
                         [&] { image = measure_method(job, target, staged, index, exposure, record); });
  if (!failure) return image;
  record = bench.measurer.failed(staged, target, *failure);
  return {};
}

// ---- one distance

// Records with nothing but the errors that the reference's noise alone causes.
std::vector<Record> noise_records(const RunSettings& settings, const ReferenceView& target) {
  Record record;
  record.distance = target.distance;
  record.frame = static_cast<int>(target.frame);
  RecordError& error = record.error.emplace();
  error.noise_floor = target.noise_floor;
  error.causes.shading_floor = target.shading_floor;
  if (target.shading_floor) error.causes.shading = 0.0;
  for (const OtherReferenceImage& other : target.others)
    record.other_references.push_back({.spp = other.spp, .normalized_color = 0, .noise_floor = other.noise_floor});
  std::vector<Record> records(settings.methods.size(), record);
  for (std::size_t m = 0; m < records.size(); ++m) records[m].method = settings.methods[m].text;
  return records;
}

DistanceTimes time_distance(Job& job, double distance) {
  const RunSettings& settings = job.settings;
  const double weight = static_cast<double>(settings.methods.size()) * settings.timing.repeats;
  const Stage& stage = job.workbench().stage;
  return time_methods(stage, stage.view(distance), settings.timing.repeats,
                      job.progress.next(weight, fmt::format("distance {:g}: ", distance)));
}

// Reads the frame before from what an earlier run finished. The reference is rendered again.
FrameBefore finished_frame(Job& job, const DistanceResult& result, std::size_t index) {
  FrameBefore before{.index = index, .reference = {}, .images = {}};
  before.reference = job.workbench().references.render(index, result.distance, result.exposure.factor).reference;
  for (const Record& record : result.records)
    before.images.push_back(record.failure ? Image() : read_image(job.folder / record.images.color, Transfer::linear));
  return before;
}

void add_flicker(std::vector<Record>& records, const FrameBefore& before, const std::vector<Image>& images,
                 const ReferenceView& target, float exposure) {
  for (std::size_t m = 0; m < records.size(); ++m) {
    if (images[m].texels.empty() || before.images[m].texels.empty()) continue;
    records[m].flicker = flicker_between(before.images[m], images[m], before.reference, target.reference, exposure);
  }
}

// Everything but the times. In a zoom `before` becomes this frame.
DistanceResult measure_images(Job& job, std::size_t i, const Exposure& exposure, std::optional<FrameBefore>& before) {
  const RunSettings& settings = job.settings;
  ReferenceView target = job.workbench().references.find(i, job.distances[i], exposure.factor);
  if (job.context.watch) job.context.watch(noise_records(settings, target));
  DistanceResult result{.distance = target.distance,
                        .exposure = exposure,
                        .wanted_noise = target.wanted_noise,
                        .standard_error = relative_standard_error(target.reference),
                        .samples = target.samples,
                        .seconds = target.seconds,
                        .reference = target.files.reference,
                        .unresolved = set_pixels(target.unresolved),
                        .records = std::vector<Record>(settings.methods.size()),
                        .pairs = {},
                        .curve = target.curve,
                        .warnings = target.warnings};
  std::vector<Image> images;
  std::vector<std::string> names;
  for (std::size_t m = 0; m < settings.methods.size(); ++m) {
    images.push_back(measure_or_fail(job, target, m, exposure.factor, result.records[m]));
    names.push_back(method_stem(settings.methods, m));
    if (images.back().texels.empty()) continue;
    const Image error = error_map(images.back(), target.reference.mean, exposure.factor);
    result.largest_error = std::max(result.largest_error, error_percentile(error));
  }
  result.pairs = compare_pairs(job.folder, result.records, images, names, target, exposure.factor);
  if (settings.view.zoom.frames == 0) return result;
  if (before) add_flicker(result.records, *before, images, target, exposure.factor);
  before = FrameBefore{.index = i, .reference = std::move(target.reference), .images = std::move(images)};
  return result;
}

// The times of other processes, taken once.
class OtherProcesses {
 public:
  explicit OtherProcesses(const FurtherTimes& take) : take_(take) {}

  [[nodiscard]] std::vector<DistanceTimes> at(std::size_t distance) {
    if (!times_) times_ = take_ ? take_() : std::vector<FrameTimes>{};
    std::vector<DistanceTimes> own;
    for (const FrameTimes& process : *times_) own.push_back(process.at(distance));
    return own;
  }

 private:
  const FurtherTimes& take_;
  std::optional<std::vector<FrameTimes>> times_;
};

Exposure exposure_of(Job& job) {
  const std::optional<Exposure>& given = job.settings.view.exposure;
  if (given || job.loaded().exposure) return choose_exposure(given, job.loaded(), {});
  return choose_exposure({}, job.loaded(), job.workbench().references.first_samples(job.distances.front()));
}

// Measures the distances in turn, or reads them back.
class Distances {
 public:
  explicit Distances(Job& job) : job_(job), processes_(job.context.further_times) {}

  DistanceResult next(std::size_t i) {
    if (auto finished = finished_distance(job_, i)) {
      exposure_ = finished->exposure;
      if (job_.context.watch) job_.context.watch(finished->records);
      last_ = {i, *finished};
      return std::move(*finished);
    }
    if (!exposure_) exposure_ = exposure_of(job_);
    const bool has_before = last_ && last_->first + 1 == i && job_.settings.view.zoom.frames > 0;
    if (has_before && (!before_ || before_->index + 1 != i)) before_ = finished_frame(job_, last_->second, i - 1);
    DistanceResult result = measure_images(job_, i, *exposure_, before_);
    if (job_.context.watch) job_.context.watch(result.records);
    std::vector<DistanceTimes> times = processes_.at(i);
    times.push_back(time_distance(job_, result.distance));
    result.processes = static_cast<int>(times.size());
    set_times(result.records, job_.workbench().stage, times);
    job_.store(part_name(result.distance), result, files_of(result));
    last_ = {i, result};
    return result;
  }

 private:
  Job& job_;
  OtherProcesses processes_;
  std::optional<Exposure> exposure_;
  std::optional<FrameBefore> before_;                             // in a zoom
  std::optional<std::pair<std::size_t, DistanceResult>> last_{};  // the distance before, with its index
};

// ---- the whole

void add_precompute_notes(const Stage& stage, std::size_t methods, std::vector<std::string>& warnings) {
  for (std::size_t m = 0; m < methods; ++m) {
    const BakedMethod& baked = stage.methods()[m].baked();
    for (std::size_t i = 0; i < baked.materials.size(); ++i) {
      for (const std::string& note : baked.materials[i].notes)
        warnings.push_back(fmt::format("{}, material {}: {}", baked.spec.text, stage.scene().materials[i].name, note));
    }
  }
}

ComparisonHead head_of(Job& job) {
  if (auto finished = job.find<ComparisonHead>("head")) return std::move(*finished);
  const Stage& stage = job.workbench().stage;
  ComparisonHead head{.backend = backend_info(stage.context().info()),
                      .scene = stage.info({}),
                      .footprint = footprint_filter_text(footprint_filter_of(job.settings, job.loaded())),
                      .environment = {},
                      .first_warnings = job.workbench().references.warnings(),
                      .last_warnings = {}};
  if (has(stage.effects(), Effect::environment_light))
    head.environment = word_for(reference_integrals, job.settings.reference.environment);
  const EffectSet left_out = effects_on(stage.decisions()) & job.settings.without;
  if (left_out.any())
    head.last_warnings.push_back(fmt::format("left out of every image, the reference's too, as was asked: {}",
                                             fmt::join(effect_names(left_out), ", ")));
  add_precompute_notes(stage, job.settings.methods.size(), head.last_warnings);
  job.store("head", head);
  return head;
}

void append(std::vector<std::string>& texts, const std::vector<std::string>& more) {
  texts.insert(texts.end(), more.begin(), more.end());
}

std::vector<std::string> warnings_of(const DistanceResult& result) {
  std::vector<std::string> warnings;
  for (const Record& record : result.records) {
    if (record.failure)
      warnings.push_back(fmt::format("distance {:g}: {} failed: {}", record.distance, record.method, *record.failure));
  }
  append(warnings, result.warnings);
  if (auto warning = linear_measures_warning(result.distance, result.standard_error))
    warnings.push_back(std::move(*warning));
  return warnings;
}

// Of one distance or more.
Results results_of(const RunSettings& settings, const ComparisonHead& head,
                   const std::vector<DistanceResult>& distances) {
  Results results;
  results.backend = head.backend;
  results.scene = head.scene;
  results.footprint = head.footprint;
  const Exposure& exposure = distances.front().exposure;
  results.scene.exposure = exposure.factor;
  results.scene.exposure_source = word_for(exposure_sources, exposure.source);
  results.reference.spp = settings.reference.spp;
  results.reference.filter = word_for(reference_filters, settings.reference.filter);
  results.reference.seed = settings.reference.seed;
  results.reference.environment = head.environment;
  results.timing = {.frames = settings.timing.repeats, .processes = distances.back().processes};
  append(results.scene.warnings, head.first_warnings);
  double largest_error = 0;
  for (const DistanceResult& result : distances) {
    results.reference.standard_errors.push_back(result.standard_error);
    results.reference.samples += result.samples;
    results.reference.seconds += result.seconds;
    largest_error = std::max(largest_error, result.largest_error);
    results.error_scales.push_back(
        {.distance = result.distance, .error = error_scale(result.largest_error, settings.view.error_scale)});
    std::ranges::copy(result.records, std::back_inserter(results.records));
    std::ranges::copy(result.pairs, std::back_inserter(results.pairs));
    std::ranges::copy(result.curve, std::back_inserter(results.supersampling));
    append(results.scene.warnings, warnings_of(result));
  }
  append(results.scene.warnings, head.last_warnings);
  results.reference.samples /= static_cast<double>(distances.size());
  results.error_scale = error_scale(largest_error, settings.view.error_scale);
  return results;
}

}  // namespace

FrameTimes time_frames(const RunSettings& settings, const Progress& progress) {
  const CompareContext context;
  Job job(settings, {}, progress, context);
  FrameTimes all;
  for (const double distance : job.distances) all.push_back(time_distance(job, distance));
  return all;
}

Results run_compare(const RunSettings& settings, const std::filesystem::path& folder, const Progress& progress,
                    const CompareContext& context) {
  Job job(settings, folder, progress, context);
  std::filesystem::create_directories(folder / "images");
  Distances distances(job);
  std::vector<DistanceResult> done;
  for (std::size_t i = 0; i < job.distances.size(); ++i) {
    done.push_back(distances.next(i));
    write_error_images(folder, done.back(), error_scale(done.back().largest_error, settings.view.error_scale));
    if (context.so_far && i + 1 < job.distances.size()) context.so_far(results_of(settings, head_of(job), done));
  }
  const Results own_scales = results_of(settings, head_of(job), done);
  for (std::size_t i = 0; i < done.size(); ++i) {
    if (own_scales.error_scales[i].error != own_scales.error_scale)
      write_shared_error_images(folder, done[i], own_scales.error_scale);
  }
  return results_of(settings, head_of(job), done);
}

void measure_distances(const RunSettings& settings, std::span<const std::size_t> distances,
                       const std::filesystem::path& folder, const Progress& progress, const CompareContext& context) {
  Job job(settings, folder, progress, context);
  std::filesystem::create_directories(folder / "images");
  Distances measured(job);
  for (const std::size_t i : distances) (void)measured.next(i);
  (void)head_of(job);
}

}  // namespace footprint
