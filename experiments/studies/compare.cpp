// Chooses the exposure, then for each view: the reference, the methods, their times. Finished views are read back.
#include "experiments/studies/compare.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "experiments/settings/setting.hpp"
#include "experiments/studies/exposure.hpp"
#include "experiments/studies/frame_setup.hpp"
#include "experiments/studies/picture_files.hpp"
#include "experiments/studies/report_facts.hpp"
#include "experiments/studies/view_path.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/image/metrics.hpp"

namespace footprint {
namespace {

// Images of a frame's size at once: each method's image and its strips, and those of the reference. An animation has
// no strips, but two frames.
int images_at_once(const RunSettings& settings) {
  const int methods = static_cast<int>(settings.methods.size());
  const int histories = 3 * static_cast<int>(count_histories(settings));  // two targets and their depths
  return histories + (is_animation(settings) ? 2 * methods + 28 : 6 * methods + 15);
}

double weight_of_methods(const RunSettings& settings) {
  return static_cast<double>(settings.methods.size()) * (settings.reference.spp + settings.timing.repeats);
}

// Everything that renders, created with the first image.
struct Workbench {
  Workbench(std::shared_ptr<PreparedScene> scene, const RunSettings& settings, const RunFolder& folder,
            const Progress& staging, ProgressParts& progress, SharedReferences* shared, const GpuCompiler& compiler)
      : stage(std::move(scene), settings, staging,
              {.has_unit = !is_animation(settings), .records_refusals = !is_animation(settings)}),
        frames(stage, settings),
        measurer(stage),
        references(settings, stage, folder, progress, shared) {
    if (!settings.gpus.empty()) gpu_costs.emplace(stage, settings.gpus, compiler);
  }

  Stage stage;
  MethodFrames frames;
  MethodMeasurer measurer;
  ReferenceRenderer references;
  std::optional<GpuCosts> gpu_costs{};
};

// A run's inputs, and its workbench once something is rendered.
struct Job {
  Job(const RunSettings& of, RunFolder into, const Progress& all, const CompareContext& with)
      : settings(of),
        folder(std::move(into)),
        context(with),
        whole(all, 4),
        staging(whole.next(1, "")),
        scene(context.shared != nullptr ? Scene{} : scene_for_path(settings, scene_of_run(settings))),
        views(run_views(settings, loaded())),
        progress(whole.next(3, ""), static_cast<double>(views.size()) *
                                        (ReferenceRenderer::weight(settings) + weight_of_methods(settings))) {
    require_pictures(frame_size(loaded(), settings.view.size), images_at_once(settings));
    if (context.finished != nullptr) run = fingerprint();
  }

  Workbench& workbench() {
    if (!bench) {
      if (context.finished != nullptr) context.finished->require_more_allowed(settings.scene);
      auto prepared = context.shared != nullptr ? context.shared->scene
                                                : std::make_shared<PreparedScene>(std::move(scene), settings);
      bench = std::make_unique<Workbench>(std::move(prepared), settings, folder, staging, progress,
                                          context.shared != nullptr ? &context.shared->references : nullptr,
                                          context.gpu_compiler);
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
    if (context.finished == nullptr) return;
    folder.attempt(part, [&] { context.finished->store(run + "/" + part, value, folder.path(), files); });
  }

  // The times that other processes took in a view; they take those of all views at once.
  [[nodiscard]] std::vector<DistanceTimes> further_times(std::size_t view) {
    if (!further) further = context.further_times ? context.further_times() : std::vector<FrameTimes>{};
    std::vector<DistanceTimes> own;
    for (const FrameTimes& process : *further) own.push_back(process.at(view));
    return own;
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
  RunFolder folder;
  const CompareContext& context;
  ProgressParts whole;
  Progress staging;
  std::unique_ptr<Workbench> bench;
  Scene scene;  // until the workbench takes it; empty if scenes are shared
  std::vector<RunView> views;
  ProgressParts progress;
  std::string run;  // fingerprint, if work is stored
  std::optional<std::vector<FrameTimes>> further{};
};

// The frame before, against which flicker is measured.
struct FrameBefore {
  ReferenceView target;
  std::vector<Image> images{};  // of each method; empty: it failed
};

// ---- finished views

std::string part_name(const Job& job, std::size_t i) {
  return is_animation(job.settings) ? frame_name(i) : fmt::format("distance_{}", job.views[i].distance);
}

// An animation has no images but those of its frames.
std::vector<std::string> files_of(const RunSettings& settings, const DistanceResult& result) {
  std::vector<std::string> files;
  const auto add = [&](const std::string& exr) {
    std::ranges::move(page_picture_files(exr), std::back_inserter(files));
  };
  add(result.reference);
  for (const Record& record : result.records) {
    if (!record.failure) add(record.images.color);
  }
  if (is_animation(settings)) return files;
  const RecordImages& shared = result.records.front().images;
  files.insert(files.end(), {shared.standard_error, shared.interior,
                             std::filesystem::path(shared.interior).replace_extension(".png").string()});
  for (const MethodPair& pair : result.pairs) files.push_back(pair.picture);
  return files;
}

std::vector<std::uint32_t> set_pixels(const Image& mask) {
  std::vector<std::uint32_t> pixels;
  for (std::size_t i = 0; i < mask.texels.size(); ++i) {
    if (mask.texels[i] > 0.0F) pixels.push_back(static_cast<std::uint32_t>(i));
  }
  return pixels;
}

// A view in which a method or an estimate failed is measured again, unless everything must be there.
std::optional<DistanceResult> finished_view(const Job& job, std::size_t i) {
  auto result = job.find<DistanceResult>(part_name(job, i));
  if (!result || result->records.size() != job.settings.methods.size()) return {};
  const bool any_failed = std::ranges::any_of(result->records, [](const Record& record) {
    return record.failure || std::ranges::any_of(record.gpu_costs, [](const GpuCost& cost) { return !!cost.failure; });
  });
  if (any_failed && !job.context.finished->is_complete()) return {};
  for (Record& record : result->records) record.frame = static_cast<int>(i);
  if (result->work.wanted_noise && job.context.shared != nullptr)
    job.context.shared->references.wanted_noise.emplace(job.views[i], *result->work.wanted_noise);
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

Image measure_method(Job& job, const ReferenceView& target, const StagedMethod& staged, std::size_t index,
                     float exposure, Record& record) {
  Workbench& bench = job.workbench();
  const std::string& text = job.settings.methods[index].text;
  const std::string prefix = fmt::format("{}: {}, ", view_words(job.settings, target.index, target.at), text);
  Image frame = bench.frames.render(index, job.views, target.index, target.view);
  std::optional<Image> finest;
  if (job.settings.reference.by_cause) finest = finest_level(job, target, staged, prefix);
  bench.stage.context().check("rendering " + text);
  record = bench.measurer.measure(staged, frame, finest, target, exposure);
  const std::string stem = view_stem(job.settings, target.index, target.at, method_stem(job.settings.methods, index));
  record.images.color = write_page_picture(job.folder, stem, frame, exposure);
  if (!is_animation(job.settings)) {
    bench.measurer.count_work(record, staged, target.view);
    if (bench.gpu_costs) record.gpu_costs = bench.gpu_costs->costs(staged, target.view, no_progress).gpus;
  }
  return frame;
}

// The same, or a record that says why the method failed. Errors: an animation has no frame without all its methods.
Image measure_or_fail(Job& job, const ReferenceView& target, std::size_t index, float exposure, Record& record) {
  Workbench& bench = job.workbench();
  const StagedMethod& staged = bench.stage.methods()[index];
  Image image;
  std::optional<Error> failure = staged.refusal();
  if (!failure)
    failure = failure_of(bench.stage.context(), job.settings.methods[index],
                         [&] { image = measure_method(job, target, staged, index, exposure, record); });
  if (!failure) return image;
  if (is_animation(job.settings)) throw *failure;
  record = bench.measurer.failed(staged, target, *failure);
  return {};
}

// ---- one view

// Records with nothing but the errors that the reference's noise alone causes.
std::vector<Record> noise_records(const RunSettings& settings, const ReferenceView& target) {
  Record record;
  record.distance = target.at.distance;
  record.frame = static_cast<int>(target.index);
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

DistanceTimes time_view(Job& job, std::size_t i) {
  const RunSettings& settings = job.settings;
  const double weight = static_cast<double>(settings.methods.size()) * settings.timing.repeats;
  Stage& stage = job.workbench().stage;
  return time_methods(stage, stage.move_to(job.views[i]), settings,
                      job.progress.next(weight, view_words(settings, i, job.views[i]) + ": "));
}

// The frame before again. finished: its images are read from there; null: they are rendered.
FrameBefore frame_again(Job& job, std::size_t index, float exposure, const DistanceResult* finished) {
  Workbench& bench = job.workbench();
  FrameBefore before{.target = bench.references.render(index, job.views[index], exposure)};
  for (std::size_t m = 0; m < job.settings.methods.size(); ++m) {
    Image& image = before.images.emplace_back();
    const StagedMethod& staged = bench.stage.methods()[m];
    if (finished != nullptr) {
      const Record& record = finished->records[m];
      if (!record.failure) image = read_image(job.folder / record.images.color, Transfer::linear);
    } else if (!staged.refusal()) {
      // A failure shows again where the method is measured.
      (void)failure_of(bench.stage.context(), job.settings.methods[m],
                       [&] { image = bench.frames.render(m, job.views, index, before.target.view); });
    }
  }
  return before;
}

void add_flicker(std::vector<Record>& records, const FrameBefore& before, const std::vector<Image>& images,
                 const ReferenceView& target, float exposure) {
  for (std::size_t m = 0; m < records.size(); ++m) {
    if (images[m].texels.empty() || before.images[m].texels.empty()) continue;
    std::optional<Flicker>& flicker = records[m].flicker;
    flicker = flicker_between(before.images[m], images[m], before.target.reference, target.reference, exposure);
    if (!flicker) continue;
    flicker->causes = flicker_causes(before.images[m], images[m], before.target, target, exposure);
    if (records[m].history) flicker->causes.filter = flicker->causes.method = {};  // it has no footprint filter
  }
}

// The largest error of the images, and every two of them compared.
void compare_methods(Job& job, DistanceResult& result, const std::vector<Image>& images, const ReferenceView& target) {
  const float exposure = result.exposure.factor;
  std::vector<std::string> names;
  for (std::size_t m = 0; m < images.size(); ++m) {
    names.push_back(method_stem(job.settings.methods, m));
    if (images[m].texels.empty()) continue;
    const Image error = error_map(images[m], target.reference.mean, exposure);
    result.largest_error = std::max(result.largest_error, error_percentile(error));
  }
  result.pairs = compare_pairs(job.folder, result.records, images, names, target, exposure);
}

// Everything but the times. On a path `before` becomes this frame.
DistanceResult measure_images(Job& job, std::size_t i, const Exposure& exposure, std::optional<FrameBefore>& before) {
  const RunSettings& settings = job.settings;
  ReferenceView target = job.workbench().references.find(i, job.views[i], exposure.factor);
  if (job.context.watch) job.context.watch(noise_records(settings, target));
  DistanceResult result{
      .distance = target.at.distance,
      .exposure = exposure,
      .work = {target.wanted_noise, relative_standard_error(target.reference), target.samples, target.seconds},
      .reference = target.files.reference,
      .unresolved = set_pixels(target.unresolved),
      .records = std::vector<Record>(settings.methods.size()),
      .curve = target.curve,
      .warnings = target.warnings};
  std::vector<Image> images;
  for (std::size_t m = 0; m < settings.methods.size(); ++m)
    images.push_back(measure_or_fail(job, target, m, exposure.factor, result.records[m]));
  if (!is_animation(settings)) compare_methods(job, result, images, target);
  if (settings.view.zoom.frames == 0) return result;
  if (before) add_flicker(result.records, *before, images, target, exposure.factor);
  before = FrameBefore{.target = std::move(target), .images = std::move(images)};
  return result;
}

Exposure exposure_of(Job& job) {
  const std::optional<Exposure>& given = job.settings.view.exposure;
  if (given || job.loaded().exposure) return choose_exposure(given, job.loaded(), {});
  return choose_exposure({}, job.loaded(), job.workbench().references.first_samples(job.views.front()));
}

class Views {
 public:
  explicit Views(Job& job) : job_(job) {}

  DistanceResult next(std::size_t i) {
    if (auto finished = finished_view(job_, i)) {
      exposure_ = finished->exposure;
      if (job_.context.watch) job_.context.watch(finished->records);
      last_ = {i, *finished};
      return std::move(*finished);
    }
    if (!exposure_) exposure_ = exposure_of(job_);
    if (i > 0 && job_.settings.view.zoom.frames > 0 && (!before_ || before_->target.index + 1 != i)) {
      const bool is_finished = last_ && last_->first + 1 == i;
      before_ = frame_again(job_, i - 1, exposure_->factor, is_finished ? &last_->second : nullptr);
    }
    DistanceResult result = measure_images(job_, i, *exposure_, before_);
    if (job_.context.watch) job_.context.watch(result.records);
    if (is_animation(job_.settings)) {
      for (Record& record : result.records) set_no_times(record);
    } else {
      std::vector<DistanceTimes> times = job_.further_times(i);
      times.push_back(time_view(job_, i));
      result.processes = static_cast<int>(times.size());
      set_times(result.records, job_.workbench().stage, times);
    }
    job_.store(part_name(job_, i), result, files_of(job_.settings, result));
    last_ = {i, result};
    return result;
  }

 private:
  Job& job_;
  std::optional<Exposure> exposure_;
  std::optional<FrameBefore> before_;                             // on a path
  std::optional<std::pair<std::size_t, DistanceResult>> last_{};  // the view before, with its index
};

// ---- the whole

void add_precompute_notes(const Stage& stage, std::size_t methods, std::vector<std::string>& warnings) {
  for (std::size_t m = 0; m < methods; ++m) {
    const BakedMethod& baked = stage.methods()[m].baked();
    for (std::size_t i = 0; i < baked.materials.size(); ++i) {
      for (const std::string& note : baked.materials[i].notes)
        warnings.push_back(
            fmt::format("{}, material {}: {}", stage.methods()[m].text(), stage.scene().materials[i].name, note));
    }
  }
}

std::optional<AnimationWay> way_of(const RunSettings& settings, const Scene& scene) {
  if (!is_animation(settings)) return {};
  AnimationWay way{.path = std::string(word_for(animation_paths, *settings.path.kind))};
  if (settings.path.kind != AnimationPath::orbit && settings.path.kind != AnimationPath::light) return way;
  const glm::dvec3 axis = turning_axis(settings.path, scene);
  way.axis = {axis.x, axis.y, axis.z};
  return way;
}

ReferenceInfo reference_of(const RunSettings& settings, const EffectSet& effects) {
  ReferenceInfo info;
  info.spp = settings.reference.spp;
  info.filter = word_for(reference_filters, settings.reference.filter);
  info.seed = settings.reference.seed;
  if (has(effects, Effect::environment_light))
    info.environment = word_for(reference_integrals, settings.reference.environment);
  return info;
}

ComparisonHead head_of(Job& job) {
  if (auto finished = job.find<ComparisonHead>("head")) return std::move(*finished);
  const Stage& stage = job.workbench().stage;
  const RunSettings& settings = job.settings;
  ComparisonHead head{.results = {},
                      .frames = static_cast<std::size_t>(settings.view.zoom.frames),
                      .error_scale = settings.view.error_scale};
  head.results.backend = backend_info(stage.context().info());
  head.results.scene = stage.info();
  head.results.reference = reference_of(settings, stage.effects());
  head.results.footprint = footprint_filter_text(footprint_filter_of(settings.footprint, job.loaded()));
  head.results.timing.frames = settings.timing.repeats;
  head.results.way = way_of(settings, stage.scene());
  std::ranges::copy(job.workbench().references.warnings(), std::back_inserter(head.results.scene.warnings));
  const EffectSet left_out = effects_on(stage.decisions()) & settings.without;
  if (left_out.any())
    head.last_warnings.push_back(fmt::format("left out of every image, the reference's too, as requested: {}",
                                             fmt::join(effect_names(left_out), ", ")));
  add_precompute_notes(stage, settings.methods.size(), head.last_warnings);
  job.store("head", head);
  return head;
}

}  // namespace

FrameTimes time_frames(const RunSettings& settings, const Progress& progress) {
  const CompareContext context;
  Job job(settings, std::filesystem::path(), progress, context);
  FrameTimes all;
  for (std::size_t i = 0; i < job.views.size(); ++i) all.push_back(time_view(job, i));
  return all;
}

Results run_compare(const RunSettings& settings, const RunFolder& folder, const Progress& progress,
                    const CompareContext& context) {
  Job job(settings, folder, progress, context);
  std::filesystem::create_directories(folder / "images");
  Views views(job);
  std::vector<DistanceResult> done;
  for (std::size_t i = 0; i < job.views.size(); ++i) {
    done.push_back(views.next(i));
    if (is_animation(settings)) continue;
    write_error_images(folder, done.back(), error_scale(done.back().largest_error, settings.view.error_scale));
    if (context.so_far && i + 1 < job.views.size()) context.so_far(results_of(head_of(job), done));
  }
  const Results own_scales = results_of(head_of(job), done);
  for (std::size_t i = 0; i < own_scales.error_scales.size(); ++i) {
    if (own_scales.error_scales[i].error != own_scales.error_scale)
      write_shared_error_images(folder, done[i], own_scales.error_scale);
  }
  return results_of(head_of(job), done);
}

std::string measure_views(const RunSettings& settings, std::span<const std::size_t> views, const RunFolder& folder,
                          const Progress& progress, const CompareContext& context) {
  Job job(settings, folder, progress, context);
  std::filesystem::create_directories(folder / "images");
  Views measured(job);
  for (const std::size_t i : views) (void)measured.next(i);
  (void)head_of(job);
  return job.run;
}

}  // namespace footprint
