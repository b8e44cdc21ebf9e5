// Each frame of a path: the reference, every method, and what changed since the frame before.
#include "experiments/studies/animate.hpp"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "experiments/studies/camera_path.hpp"
#include "experiments/studies/exposure.hpp"
#include "experiments/studies/flicker_causes.hpp"
#include "experiments/studies/kept_animation.hpp"
#include "experiments/studies/picture_files.hpp"
#include "experiments/studies/reference_noise.hpp"
#include "experiments/studies/run_info.hpp"
#include "experiments/studies/stage.hpp"
#include "renderer/image/metrics.hpp"
#include "renderer/pipeline/unresolved.hpp"
#include "renderer/scene/assembly/load_scene.hpp"

namespace footprint {
namespace {

constexpr double method_weight = 2.0;  // of a method's frame, in reference samples

// A frame as it is held until the next one has been compared with it.
struct HeldFrame {
  std::size_t index = 0;
  FrameTruth truth;
  Image whole;                  // the reference with its unresolved pixels
  std::vector<Image> pictures;  // one a method
};

// What is on the GPU, made when the first frame is drawn.
class Drawing {
 public:
  Drawing(const Scene& scene, const RunSettings& settings, const Progress& progress)
      : stage(scene, settings, progress),
        interior(stage.interior_finder()),
        bound(stage_bound(stage, settings.reference.bound, warnings)) {
    // Two frames are held, each with the reference, its halves, its error, its parts and the bound; and what is worked
    // on.
    constexpr int of_the_reference = 10, worked_on = 6;
    require_pictures(stage.view(1.0).size, 2 * static_cast<int>(stage.methods().size()) + of_the_reference + worked_on);
  }

  Stage stage;
  InteriorFinder interior;
  std::vector<std::string> warnings;
  std::optional<StagedMethod> bound;
};

class Animator {
 public:
  Animator(const RunSettings& settings, std::filesystem::path folder, const KeptWork& kept, const Progress& progress)
      : settings_(settings),
        folder_(std::move(folder)),
        kept_(kept),
        whole_(progress, 4),
        stage_progress_(whole_.next(1, "")),
        scene_(scene_for_path(settings, load_scene(settings.scene, settings.scene_library, settings.overrides))),
        path_(path_frames(settings, scene_)),
        keys_(kept, settings, scene_, path_) {}

  MeasuredFrames measure(const FrameRange& range) {
    const auto [first, last] = range(path_.size());
    MeasuredFrames measured{.head = keys_.head(), .frames = {}};
    ProgressParts parts(whole_.next(3, ""), static_cast<double>(last - first) + 1.0);
    std::filesystem::create_directories(folder_ / "images");
    for (std::size_t frame = first; frame < last; ++frame) {
      measured.frames.push_back(keys_.frame(frame));
      const Progress progress = parts.next(1, fmt::format("frame {} of {}: ", frame + 1, path_.size()));
      if (!kept_.find<KeptFrame>(measured.frames.back(), folder_)) add_frame(frame, progress);
    }
    if (!kept_.find<KeptAnimation>(measured.head, folder_)) kept_.keep(measured.head, head(), folder_);
    return measured;
  }

 private:
  Drawing& drawing() {
    if (!drawing_) drawing_ = std::make_unique<Drawing>(scene_, settings_, stage_progress_);
    return *drawing_;
  }

  // The exposure is that of the first frame, whichever is drawn first.
  float exposure() {
    if (exposure_) return exposure_->factor;
    const bool known = settings_.view.exposure || scene_.exposure;
    const Image first = known ? Image() : reference_at(0, stage_progress_).mean;
    exposure_ = choose_exposure(settings_.view.exposure, scene_, first);
    return exposure_->factor;
  }

  // Moves what moves, and looks at it.
  View view_at(std::size_t frame) {
    const PathFrame& at = path_[frame];
    Stage& stage = drawing().stage;
    if (settings_.path.kind == AnimationPath::light) stage.move_lights(lights_on_path(settings_.path, scene_, at));
    return {.size = stage.view(1.0).size, .camera = camera_on_path(settings_.path, stage.scene(), at)};
  }

  Supersampled reference_at(std::size_t frame, const Progress& progress) {
    const ReferenceSettings& asked = settings_.reference;
    const View view = view_at(frame);
    return drawing().stage.reference().render(view, asked.spp, asked.seed, progress);
  }

  HeldFrame draw(std::size_t frame, const Progress& progress) {
    Drawing& drawing = this->drawing();
    const float exposed = exposure();
    const std::size_t methods = drawing.stage.methods().size();
    const double spp = settings_.reference.spp;
    ProgressParts parts(progress, spp + method_weight * static_cast<double>(methods));
    HeldFrame now{.index = frame, .truth = {}, .whole = {}, .pictures = {}};
    now.truth.reference = reference_at(frame, parts.next(spp, "reference, "));
    now.whole = now.truth.reference.mean;
    leave_out(now.truth.reference, unresolved(now.truth.reference, exposed));  // as a comparison does
    const View view = view_at(frame);
    find_parts(now, view);
    const Progress drawn = parts.next(method_weight * static_cast<double>(methods), "");
    for (std::size_t m = 0; m < methods; ++m) {
      drawn(settings_.methods[m].text, static_cast<double>(m) / static_cast<double>(methods));
      now.pictures.push_back(drawing.stage.methods()[m].frames().render(view));
      drawing.stage.context().check("rendering " + settings_.methods[m].text);
    }
    return now;
  }

  void find_parts(HeldFrame& now, const View& view) {
    Drawing& drawing = this->drawing();
    const ReferenceSettings& asked = settings_.reference;
    const Tile all{.origin = {0, 0}, .size = view.size};
    const Interior interior = drawing.interior.render(view, all, asked.spp, asked.seed, no_progress);
    const std::size_t whole = object_pixel_count(now.whole);
    now.truth.parts = pixel_parts(now.truth.reference.mean, interior);
    now.truth.parts.counts.unresolved = whole - now.truth.parts.counts.object;
    if (!drawing.bound) return;
    now.truth.bound = draw_bound(drawing.stage, *drawing.bound, asked.bound, view, now.truth.parts, interior.texels);
    now.truth.parts.counts.bound = pixel_count(now.truth.bound->pixels);
    drawing.stage.context().check("drawing the bound");
  }

  void add_frame(std::size_t frame, const Progress& progress) {
    ProgressParts parts(progress, 2);
    const Progress before = parts.next(1, "the frame before, ");
    if (frame > 0 && (!held_ || held_->index + 1 != frame)) held_ = draw(frame - 1, before);
    HeldFrame now = draw(frame, parts.next(1, ""));
    KeptFrame kept{.frame = described(now), .records = {}};
    for (std::size_t m = 0; m < settings_.methods.size(); ++m) kept.records.push_back(record_of(now, m));
    held_ = std::move(now);
    const std::vector<std::string> files = files_of(kept);
    kept_.keep(keys_.frame(frame), std::move(kept), folder_, files);
  }

  AnimationFrame described(const HeldFrame& now) {
    const Image& reference = now.truth.reference.mean;
    const PathFrame& at = path_[now.index];
    return {.frame = static_cast<int>(now.index),
            .distance = at.distance,
            .degrees = at.degrees,
            .pixels = now.truth.parts.counts,
            .standard_error = relative_standard_error(now.truth.reference),
            .highlight_energy = highlight_energy(reference, reference, exposure()),
            .image = write_picture(folder_, fmt::format("reference_{:04}", now.index), now.whole, exposure())};
  }

  AnimationRecord record_of(const HeldFrame& now, std::size_t method) {
    const Image& picture = now.pictures[method];
    const FrameTruth& truth = now.truth;
    AnimationRecord record;
    record.frame = static_cast<int>(now.index);
    record.method = settings_.methods[method].text;
    if (const auto error = normalized_color(picture, truth.reference.mean, exposure())) {
      record.normalized_color = *error;
      record.noise_floor = noise_floor(truth.reference, exposure());
      record.causes = error_causes({.method = picture,
                                    .reference = truth.reference.mean,
                                    .bound = truth.bound ? &truth.bound->picture : nullptr,
                                    .bound_pixels = truth.bound ? &truth.bound->pixels : nullptr},
                                   truth.parts, exposure());
      record.causes.shading_floor = noise_floor_over(truth.reference, exposure(), truth.parts.interior);
      record.highlight_energy = highlight_energy(picture, truth.reference.mean, exposure());
    }
    if (now.index > 0) {
      const Image& before = held_->pictures[method];
      record.flicker = flicker_between(before, picture, held_->truth.reference, truth.reference, exposure());
      record.flicker_causes = flicker_causes(before, picture, held_->truth, truth, exposure());
    }
    const std::string stem = method_stem(settings_.methods, method);
    record.image = write_picture(folder_, fmt::format("{}_{:04}", stem, now.index), picture, exposure());
    return record;
  }

  KeptAnimation head() {
    Drawing& drawing = this->drawing();
    (void)exposure();
    KeptAnimation head;
    head.backend = backend_info(drawing.stage.context().info());
    head.scene = drawing.stage.info(*exposure_);
    head.scene.warnings.insert(head.scene.warnings.end(), drawing.warnings.begin(), drawing.warnings.end());
    const ReferenceSettings& reference = settings_.reference;
    head.reference.spp = reference.spp;
    head.reference.filter = word_for(reference_filters, reference.filter);
    head.reference.seed = reference.seed;
    if (has(drawing.stage.effects(), Effect::environment_light))
      head.reference.environment = word_for(reference_integrals, reference.environment);
    head.footprint = footprint_filter_text(footprint_filter_of(settings_, scene_));
    head.way = way_of(settings_.path, scene_);
    const glm::ivec2 size = drawing.stage.view(1.0).size;
    head.width = size.x;
    head.height = size.y;
    head.frames = path_.size();
    return head;
  }

  static AnimationWay way_of(const PathSettings& path, const Scene& scene) {
    AnimationWay way{.path = std::string(word_for(animation_paths, path.kind)), .axis = {}};
    if (path.kind == AnimationPath::zoom) return way;
    const glm::dvec3 axis = turning_axis(path, scene);
    way.axis = {axis.x, axis.y, axis.z};
    return way;
  }

  const RunSettings& settings_;
  std::filesystem::path folder_;
  const KeptWork& kept_;
  ProgressParts whole_;
  Progress stage_progress_;
  Scene scene_;
  std::vector<PathFrame> path_;
  AnimationKeys keys_;
  std::unique_ptr<Drawing> drawing_;
  std::optional<Exposure> exposure_;
  std::optional<HeldFrame> held_;
};

}  // namespace

MeasuredFrames measure_animation(const RunSettings& settings, const FrameRange& range,
                                 const std::filesystem::path& folder, const KeptWork& kept, const Progress& progress) {
  return Animator(settings, folder, kept, progress).measure(range);
}

Animation run_animation(const RunSettings& settings, const std::filesystem::path& folder, const KeptWork& kept,
                        const Progress& progress) {
  const auto all = [](std::size_t frames) { return std::pair<std::size_t, std::size_t>(0, frames); };
  const MeasuredFrames measured = measure_animation(settings, all, folder, kept, progress);
  return joined_animation(kept, measured.head, measured.frames, folder);
}

}  // namespace footprint
