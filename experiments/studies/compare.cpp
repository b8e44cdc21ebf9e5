// The views of a run, one after the other: reference, methods, files, times. Finished views are read back.
#include "experiments/studies/compare.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "experiments/settings/setting.hpp"
#include "experiments/studies/exposure.hpp"
#include "experiments/studies/flicker.hpp"
#include "experiments/studies/measured_view.hpp"
#include "experiments/studies/picture_files.hpp"
#include "experiments/studies/report_facts.hpp"
#include "experiments/studies/view_files.hpp"
#include "renderer/image/image_io.hpp"

namespace footprint {
namespace {

// Images of a frame's size at once: each method's image and its strips, and those of the reference. An animation has
// no strips, but two frames.
int images_at_once(RunKind kind, std::size_t all_methods, std::size_t with_history) {
  const int methods = static_cast<int>(all_methods);
  const int histories = 3 * static_cast<int>(with_history);  // two targets and their depths
  return histories + (kind == RunKind::animation ? 2 * methods + 28 : 6 * methods + 15);
}

// ---- what draws

// What a run draws with. Pinned: the parts keep the stage's address.
struct Tools {
  Tools(std::shared_ptr<PreparedScene> scene, const RunSettings& settings, const std::vector<PlannedView>& views,
        const GpuCompiler& compiler, const Progress& progress)
      : stage(std::move(scene), settings, progress, options_of(kind_of(settings.view))),
        reference(reference_tools(
            stage, has_only_histories(settings.methods, settings.history) ? BoundUse::off : settings.reference.bound)),
        methods{.frames = MethodFrames(stage, views)} {
    if (!settings.gpus.empty()) methods.gpu_costs.emplace(stage, settings.gpus, compiler);
  }

  static StageOptions options_of(RunKind kind) {
    return {.has_unit = kind != RunKind::animation, .records_refusals = kind != RunKind::animation};
  }

  // Histories have no footprint filter, so the bound of one says nothing of them.
  static bool has_only_histories(std::span<const MethodSpec> methods, const HistorySettings& common) {
    return count_histories(methods, common) == methods.size();
  }

  Stage stage;
  ReferenceTools reference;
  MethodTools methods;
};

// ---- the head of the results

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

std::optional<AnimationInfo> animation_info(const PathSettings& path, const Scene& scene) {
  if (!path.kind) return {};
  AnimationInfo info{.path = std::string(word_for(animation_paths, *path.kind))};
  if (path.kind != AnimationPath::orbit && path.kind != AnimationPath::light) return info;
  const glm::dvec3 axis = turning_axis(path, scene);
  info.axis = {axis.x, axis.y, axis.z};
  return info;
}

ReferenceInfo reference_info(const ReferenceSettings& reference, const EffectSet& effects) {
  ReferenceInfo info;
  info.spp = reference.spp;
  info.filter = word_for(reference_filters, reference.filter);
  info.seed = reference.seed;
  if (has(effects, Effect::environment_light)) info.environment = word_for(reference_integrals, reference.environment);
  return info;
}

// ---- the run

// The scene of a run and its views; with the first image what draws them, because a run whose views are all finished
// needs no OpenGL.
class Workbench {
 public:
  Workbench(const RunSettings& settings, const CompareContext& context, Progress progress)
      : settings_(settings),
        context_(context),
        progress_(std::move(progress)),
        poses_(std::make_shared<ScenePoses>(settings.scene, settings.scene_library, settings.overrides)),
        scene_(context.shared != nullptr ? Scene{}
                                         : scene_for_path(settings.view, scene_of_run(settings.view, *poses_))),
        views_(plan_views(settings.view, poses_->first_time(), scene())) {
    require_pictures(frame_size(scene(), settings.view.size),
                     images_at_once(kind_of(settings.view), settings.methods.size(),
                                    count_histories(settings.methods, settings.history)));
  }

  // The scene as it was loaded, and from the first image on as the stage has it.
  [[nodiscard]] const Scene& scene() const {
    if (tools_) return tools_->stage.scene();
    return context_.shared != nullptr ? context_.shared->scene->scene : scene_;
  }

  [[nodiscard]] const RunSettings& settings() const { return settings_; }
  [[nodiscard]] const std::vector<PlannedView>& views() const { return views_; }

  Tools& tools() {
    if (tools_) return *tools_;
    if (context_.finished != nullptr) context_.finished->require_more_allowed(settings_.scene);
    auto prepared = context_.shared != nullptr ? context_.shared->scene
                                               : std::make_shared<PreparedScene>(std::move(scene_), settings_, poses_);
    tools_ = std::make_unique<Tools>(std::move(prepared), settings_, views_, context_.gpu_compiler, progress_);
    return *tools_;
  }

  // The run's finished work, in `folder` once it is taken. To be asked for before the tools.
  [[nodiscard]] KeptParts kept_parts(const RunFolder& folder) const {
    if (context_.finished == nullptr) return {nullptr, "", folder};
    SharedWork* const shared = context_.shared;
    const std::string content = shared != nullptr ? shared->content : scene_content(scene());
    std::vector<std::string> more;
    if (shared != nullptr && !shared->first.empty()) more.push_back(shared->first);
    std::string run = run_fingerprint(context_.finished->maker(), settings_, scene(), content, more);
    if (shared != nullptr && shared->first.empty()) shared->first = run;
    return {context_.finished, std::move(run), folder};
  }

  // The head of the results, from the finished work or from what draws.
  [[nodiscard]] ComparisonHead head(const KeptParts& kept) {
    return kept.kept("head", [&] { return make_head(); });
  }

 private:
  ComparisonHead make_head() {
    const Stage& stage = tools().stage;
    ComparisonHead head{.results = {},
                        .frames = static_cast<std::size_t>(settings_.view.zoom.frames),
                        .error_scale = settings_.view.error_scale};
    head.results.backend = backend_info(stage.context().info());
    head.results.scene = stage.info();
    head.results.reference = reference_info(settings_.reference, stage.effects());
    head.results.footprint = footprint_filter_text(footprint_filter_of(settings_.footprint, stage.scene()));
    head.results.timing.frames = settings_.timing.repeats;
    head.results.animation = animation_info(settings_.view.path, stage.scene());
    std::ranges::copy(tools().reference.warnings, std::back_inserter(head.results.scene.warnings));
    const EffectSet left_out = effects_on(stage.decisions()) & settings_.without;
    if (left_out.any())
      head.last_warnings.push_back(fmt::format("left out of every image, the reference's too, as requested: {}",
                                               fmt::join(effect_names(left_out), ", ")));
    add_precompute_notes(stage, settings_.methods.size(), head.last_warnings);
    return head;
  }

  const RunSettings& settings_;
  const CompareContext& context_;
  Progress progress_;  // of staging
  std::unique_ptr<Tools> tools_;
  std::shared_ptr<ScenePoses> poses_;
  Scene scene_;  // until the tools take it; empty if scenes are shared
  std::vector<PlannedView> views_;
};

// ---- finished views

std::string part_name(const PlannedView& place) {
  return place.kind == RunKind::animation ? frame_name(place.index) : fmt::format("distance_{}", place.at.distance);
}

bool has_failure(const Record& record) {
  return record.failure || std::ranges::any_of(record.gpu_costs, [](const GpuCost& cost) { return !!cost.failure; });
}

// A view in which a method or an estimate failed is measured again, unless everything must be there.
std::optional<DistanceResult> finished_view(const KeptParts& kept, const PlannedView& place, std::size_t methods) {
  auto result = kept.find<DistanceResult>(part_name(place));
  if (!result || result->records.size() != methods) return {};
  if (!kept.is_complete() && std::ranges::any_of(result->records, has_failure)) return {};
  for (Record& record : result->records) record.frame = static_cast<int>(place.index);
  return result;
}

// ---- one view

std::vector<std::uint32_t> set_pixels(const Image& mask) {
  std::vector<std::uint32_t> pixels;
  for (std::size_t i = 0; i < mask.texels.size(); ++i) {
    if (mask.texels[i] > 0.0F) pixels.push_back(static_cast<std::uint32_t>(i));
  }
  return pixels;
}

DistanceResult make_result(const Reference& reference, const MeasuredView& measured, const Exposure& exposure) {
  return {.distance = reference.place.at.distance,
          .exposure = exposure,
          .work = {reference.wanted_noise, relative_standard_error(reference.reference), reference.samples,
                   reference.seconds},
          .reference = measured.records.front().images.reference,
          .unresolved = set_pixels(reference.unresolved),
          .largest_error = measured.largest_error,
          .records = measured.records,
          .curve = reference.curve,
          .warnings = reference.warnings};
}

std::vector<Image> read_methods(const RunFolder& folder, const std::vector<Record>& records) {
  std::vector<Image> images;
  for (const Record& record : records)
    images.push_back(record.failure ? Image{} : read_image(folder / record.images.color, Transfer::linear));
  return images;
}

// The times of all processes at one distance. The others take theirs of all distances at once.
class ProcessTimes {
 public:
  explicit ProcessTimes(FurtherTimes further) : further_(std::move(further)) {}

  [[nodiscard]] std::vector<DistanceTimes> of_others(std::size_t view) {
    if (!all_) all_ = further_ ? further_() : std::vector<FrameTimes>{};
    std::vector<DistanceTimes> times;
    for (const FrameTimes& process : *all_) times.push_back(process.at(view));
    return times;
  }

 private:
  FurtherTimes further_;
  std::optional<std::vector<FrameTimes>> all_;
};

// The parts of a view's work.
struct ViewWeights {
  double reference, methods, times;

  [[nodiscard]] double all() const { return reference + methods + times; }
};

ViewWeights view_weights(const ReferenceSettings& reference, std::size_t methods, int repeats) {
  return {.reference = reference_weight(reference),
          .methods = methods_weight(methods, reference),
          .times = static_cast<double>(methods) * repeats};
}

DistanceTimes time_view(Tools& tools, const PlannedView& place, int repeats, const Progress& progress) {
  return time_methods(tools.stage, tools.stage.move_to(place.at), repeats, progress);
}

// The views of a run, each measured or read back. The first one decides the exposure, and each leaves its images for
// the flicker of the next.
class ViewSequence {
 public:
  ViewSequence(const CompareContext& context, Workbench& bench, const KeptParts& kept, RunFolder folder,
               const Progress& progress)
      : settings_(bench.settings()),
        context_(context),
        bench_(bench),
        kept_(kept),
        folder_(std::move(folder)),
        weights_(view_weights(settings_.reference, settings_.methods.size(), settings_.timing.repeats)),
        progress_(progress, static_cast<double>(bench.views().size()) * weights_.all() + settings_.reference.spp),
        references_(context.shared != nullptr ? context.shared->references : own_references_),
        times_(context.further_times) {}

  DistanceResult next(const PlannedView& place) {
    auto finished = finished_view(kept_, place, settings_.methods.size());
    DistanceResult result = finished ? taken(place, *std::move(finished)) : measured(place);
    last_ = {place.index, result};
    return result;
  }

 private:
  DistanceResult taken(const PlannedView& place, DistanceResult result) {
    exposure_ = result.exposure;
    if (result.work.wanted_noise && context_.shared != nullptr)
      references_.wanted_noise.emplace(place.at, *result.work.wanted_noise);
    watch(result.records);
    return result;
  }

  DistanceResult measured(const PlannedView& place) {
    const Exposure exposure = run_exposure();
    Tools& tools = bench_.tools();
    ProgressParts parts(progress_.next(weights_.all(), ""), weights_.all());
    find_frame_before(place);
    Reference reference = render_reference(tools.stage, tools.reference, place, wanted(), references_,
                                           parts.next(weights_.reference, ""));
    own_references_ = {};
    watch(noise_records(texts_of(settings_.methods), reference));
    const MethodsWanted of_methods{.reference = settings_.reference, .exposure = exposure.factor};
    MeasuredView view =
        measure_view(tools.stage, tools.methods, reference, of_methods, parts.next(weights_.methods, ""));
    write_view(folder_, settings_.methods, reference, exposure.factor, view);
    if (before_) add_flicker(view.records, *before_, view.images, reference, exposure.factor);
    DistanceResult result = make_result(reference, view, exposure);
    if (place.kind != RunKind::animation)
      result.pairs = write_pairs(folder_, settings_.methods, view, reference, exposure.factor);
    if (place.kind != RunKind::comparison)
      before_ = FrameBefore{.reference = std::move(reference), .images = std::move(view.images)};
    watch(result.records);
    set_all_times(place, result, parts.next(weights_.times, place.words() + ": "));
    kept_.store(part_name(place), result, files_of_view(result));
    return result;
  }

  // The given exposure, else the scene's own, else the automatic one of the first view.
  Exposure run_exposure() {
    if (exposure_) return *exposure_;
    const std::optional<Exposure>& given = settings_.view.exposure;
    Image first;
    if (!given && !bench_.scene().exposure)
      first = begin_reference(bench_.tools().stage, bench_.views().front(), settings_.reference, references_,
                              progress_.next(settings_.reference.spp, ""))
                  .begun;
    exposure_ = choose_exposure(given, bench_.scene(), first);
    return *exposure_;
  }

  [[nodiscard]] ReferenceWanted wanted() const {
    return {.settings = settings_.reference, .by_material = settings_.by_material, .exposure = exposure_->factor};
  }

  // On a path: the view before, unless it is there. Its images are read where it was finished, or else rendered again.
  void find_frame_before(const PlannedView& place) {
    if (place.kind == RunKind::comparison || place.index == 0) return;
    if (before_ && before_->reference.place.index + 1 == place.index) return;
    Tools& tools = bench_.tools();
    before_ = FrameBefore{.reference = render_reference(tools.stage, tools.reference, bench_.views()[place.index - 1],
                                                        wanted().for_flicker(), references_, progress_.next(0.0, ""))};
    const bool is_finished = last_ && last_->first + 1 == place.index;
    before_->images = is_finished ? read_methods(folder_, last_->second.records)
                                  : render_methods(tools.stage, tools.methods, before_->reference);
  }

  void set_all_times(const PlannedView& place, DistanceResult& result, const Progress& progress) {
    if (place.kind == RunKind::animation) {
      std::ranges::for_each(result.records, set_no_times);
      return;
    }
    std::vector<DistanceTimes> times = times_.of_others(place.index);
    times.push_back(time_view(bench_.tools(), place, settings_.timing.repeats, progress));
    result.processes = static_cast<int>(times.size());
    set_times(result.records, bench_.tools().stage, times);
  }

  void watch(std::span<const Record> records) const {
    if (context_.watch) context_.watch(records);
  }

  const RunSettings& settings_;
  const CompareContext& context_;
  Workbench& bench_;
  const KeptParts& kept_;
  RunFolder folder_;
  ViewWeights weights_;
  ProgressParts progress_;
  SharedReferences own_references_;  // of the view that is measured, if nothing is shared
  SharedReferences& references_;
  ProcessTimes times_;
  std::optional<Exposure> exposure_;
  std::optional<FrameBefore> before_;                             // on a path
  std::optional<std::pair<std::size_t, DistanceResult>> last_{};  // the view before, with its index
};

}  // namespace

FrameTimes time_frames(const RunSettings& settings, const Progress& progress) {
  const CompareContext context;
  ProgressParts parts(progress, 4);
  Workbench bench(settings, context, parts.next(1, ""));
  ProgressParts of_views(parts.next(3, ""), static_cast<double>(bench.views().size()));
  FrameTimes all;
  for (const PlannedView& view : bench.views())
    all.push_back(time_view(bench.tools(), view, settings.timing.repeats, of_views.next(1, view.words() + ": ")));
  return all;
}

Results run_compare(const RunSettings& settings, const RunFolder& folder, const Progress& progress,
                    const CompareContext& context) {
  ProgressParts parts(progress, 4);
  Workbench bench(settings, context, parts.next(1, ""));
  const KeptParts kept = bench.kept_parts(folder);
  std::filesystem::create_directories(folder / "images");
  ViewSequence views(context, bench, kept, folder, parts.next(3, ""));
  std::vector<DistanceResult> done;
  for (const PlannedView& view : bench.views()) {
    done.push_back(views.next(view));
    if (view.kind == RunKind::animation) continue;
    write_error_images(folder, done.back(), error_scale(done.back().largest_error, settings.view.error_scale));
    if (context.so_far && view.index + 1 < view.count) context.so_far(assemble_results(bench.head(kept), done));
  }
  const Results own_scales = assemble_results(bench.head(kept), done);
  for (std::size_t i = 0; i < own_scales.error_scales.size(); ++i) {
    if (own_scales.error_scales[i].error != own_scales.error_scale)
      write_shared_error_images(folder, done[i], own_scales.error_scale);
  }
  return assemble_results(bench.head(kept), done);
}

std::string measure_views(const RunSettings& settings, std::span<const std::size_t> views, const RunFolder& folder,
                          const Progress& progress, const CompareContext& context) {
  ProgressParts parts(progress, 4);
  Workbench bench(settings, context, parts.next(1, ""));
  const KeptParts kept = bench.kept_parts(folder);
  std::filesystem::create_directories(folder / "images");
  ViewSequence measured(context, bench, kept, folder, parts.next(3, ""));
  for (const std::size_t i : views) (void)measured.next(bench.views()[i]);
  (void)bench.head(kept);
  return kept.run();
}

}  // namespace footprint
