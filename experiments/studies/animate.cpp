// Each frame of a path: the reference, every method, and what changed since the frame before.
#include "experiments/studies/animate.hpp"

#include <fmt/format.h>

#include <iterator>
#include <memory>
#include <set>
#include <utility>

#include "experiments/studies/camera_path.hpp"
#include "experiments/studies/exposure.hpp"
#include "experiments/studies/flicker_causes.hpp"
#include "experiments/studies/picture_files.hpp"
#include "experiments/studies/reference_noise.hpp"
#include "experiments/studies/run_fingerprint.hpp"
#include "experiments/studies/run_info.hpp"
#include "experiments/studies/stage.hpp"
#include "renderer/image/metrics.hpp"
#include "renderer/pipeline/supersample.hpp"
#include "renderer/scene/assembly/load_scene.hpp"
#include "results/report/ranking.hpp"

namespace footprint {

/// Everything about an animation except its frames.
struct AnimationHead {
  BackendInfo backend;
  SceneInfo scene;
  ReferenceInfo reference;
  std::string footprint;
  std::string path;
  std::optional<std::array<double, 3>> axis;
  int width = 0, height = 0;
  std::size_t frames = 0;
};

/// One frame with its images.
struct FinishedFrame {
  AnimationFrame frame;
  std::vector<AnimationRecord> records;
};

template <class Archive>
void fields(Archive& archive, Is<AnimationHead> auto& value) {
  archive("backend", value.backend);
  archive("scene", value.scene);
  archive("reference", value.reference);
  archive("footprint", value.footprint);
  archive("path", value.path);
  archive("axis", value.axis);
  archive("size", std::tie(value.width, value.height));
  archive("frames", value.frames);
}

template <class Archive>
void fields(Archive& archive, Is<FinishedFrame> auto& value) {
  archive("frame", value.frame);
  archive("records", value.records);
}

namespace {

std::string head_key(const std::string& run) { return run + "/head"; }
std::string frame_key(const std::string& run, std::size_t frame) { return fmt::format("{}/frame_{:04}", run, frame); }

std::string path_text(const std::vector<PathFrame>& path) {
  std::string text;
  for (const PathFrame& frame : path) text += fmt::format("{} {} ", frame.distance, frame.degrees);
  return text;
}

std::vector<std::string> files_of(const FinishedFrame& frame) {
  std::vector<std::string> files;
  const auto add = [&](const std::string& exr) {
    files.push_back(exr);
    files.push_back(std::filesystem::path(exr).replace_extension(".png").string());
  };
  add(frame.frame.image);
  for (const AnimationRecord& record : frame.records) add(record.image);
  return files;
}

// Frames whose errors the reference's own noise mostly explains.
void add_noise_warning(Animation& animation) {
  std::set<int> noisy;
  for (const AnimationRecord& record : animation.records) {
    if (record.error && is_mostly_noise(record.error->normalized_color, record.error->noise_floor))
      noisy.insert(record.frame);
  }
  if (noisy.empty()) return;
  animation.scene.warnings.push_back(
      fmt::format("in {} of {} frames the reference has not converged: its noise floor is more than half of the least "
                  "error; raise --spp",
                  noisy.size(), animation.frames.size()));
}

constexpr double method_weight = 2.0;  // of a method's frame, in reference samples

// A frame until the next one has been compared with it.
struct RenderedFrame {
  std::size_t index = 0;
  FrameReference target;
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
    // Two frames are in memory, each with the reference, its halves, its error, its parts and the bound; and what is
    // worked on.
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
  Animator(const RunSettings& settings, std::filesystem::path folder, const FinishedWork& finished,
           const Progress& progress)
      : settings_(settings),
        folder_(std::move(folder)),
        finished_(finished),
        whole_(progress, 4),
        stage_progress_(whole_.next(1, "")),
        scene_(scene_for_path(settings, load_scene(settings.scene, settings.scene_library, settings.overrides))),
        path_(path_frames(settings, scene_)),
        run_(run_fingerprint(finished.maker(), settings, scene_, scene_content(scene_), {path_text(path_)})) {}

  std::string measure(const FrameRange& range) {
    const auto [first, last] = range(path_.size());
    ProgressParts parts(whole_.next(3, ""), static_cast<double>(last - first) + 1.0);
    std::filesystem::create_directories(folder_ / "images");
    for (std::size_t frame = first; frame < last; ++frame) {
      const Progress progress = parts.next(1, fmt::format("frame {} of {}: ", frame + 1, path_.size()));
      if (!finished_.find<FinishedFrame>(frame_key(run_, frame), folder_)) add_frame(frame, progress);
    }
    if (!finished_.find<AnimationHead>(head_key(run_), folder_)) finished_.store(head_key(run_), head(), folder_);
    return run_;
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

  RenderedFrame draw(std::size_t frame, const Progress& progress) {
    Drawing& drawing = this->drawing();
    const float exposed = exposure();
    const std::size_t methods = drawing.stage.methods().size();
    const double spp = settings_.reference.spp;
    ProgressParts parts(progress, spp + method_weight * static_cast<double>(methods));
    RenderedFrame now{.index = frame, .target = {}, .whole = {}, .pictures = {}};
    now.target.reference = reference_at(frame, parts.next(spp, "reference, "));
    now.whole = now.target.reference.mean;
    leave_out(now.target.reference, unresolved(now.target.reference, exposed));  // as a comparison does
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

  void find_parts(RenderedFrame& now, const View& view) {
    Drawing& drawing = this->drawing();
    const ReferenceSettings& asked = settings_.reference;
    const Tile all{.origin = {0, 0}, .size = view.size};
    const Interior interior = drawing.interior.render(view, all, asked.spp, asked.seed, no_progress);
    const std::size_t whole = object_pixel_count(now.whole);
    now.target.parts = pixel_parts(now.target.reference.mean, interior);
    now.target.parts.counts.unresolved = whole - now.target.parts.counts.object;
    if (!drawing.bound) return;
    now.target.bound = draw_bound(drawing.stage, *drawing.bound, asked.bound, view, now.target.parts, interior.texels);
    now.target.parts.counts.bound = pixel_count(now.target.bound->pixels);
    drawing.stage.context().check("drawing the bound");
  }

  void add_frame(std::size_t frame, const Progress& progress) {
    ProgressParts parts(progress, 2);
    const Progress before = parts.next(1, "the frame before, ");
    if (frame > 0 && (!before_ || before_->index + 1 != frame)) before_ = draw(frame - 1, before);
    RenderedFrame now = draw(frame, parts.next(1, ""));
    FinishedFrame finished{.frame = described(now), .records = {}};
    for (std::size_t m = 0; m < settings_.methods.size(); ++m) finished.records.push_back(record_of(now, m));
    before_ = std::move(now);
    finished_.store(frame_key(run_, frame), finished, folder_, files_of(finished));
  }

  AnimationFrame described(const RenderedFrame& now) {
    const Image& reference = now.target.reference.mean;
    const PathFrame& at = path_[now.index];
    return {.frame = static_cast<int>(now.index),
            .distance = at.distance,
            .degrees = at.degrees,
            .pixels = now.target.parts.counts,
            .standard_error = relative_standard_error(now.target.reference),
            .highlight_energy = highlight_energy(reference, reference, exposure()),
            .image = write_picture(folder_, fmt::format("reference_{:04}", now.index), now.whole, exposure())};
  }

  AnimationRecord record_of(const RenderedFrame& now, std::size_t method) {
    const Image& picture = now.pictures[method];
    const FrameReference& target = now.target;
    AnimationRecord record;
    record.frame = static_cast<int>(now.index);
    record.method = settings_.methods[method].text;
    if (const auto error = normalized_color(picture, target.reference.mean, exposure())) {
      FrameError& own = record.error.emplace();
      own.normalized_color = *error;
      own.noise_floor = noise_floor(target.reference, exposure());
      own.causes = error_causes({.method = picture,
                                 .reference = target.reference.mean,
                                 .bound = target.bound ? &target.bound->picture : nullptr,
                                 .bound_pixels = target.bound ? &target.bound->pixels : nullptr},
                                target.parts, exposure());
      own.causes.shading_floor = noise_floor_over(target.reference, exposure(), target.parts.interior);
      record.highlight_energy = highlight_energy(picture, target.reference.mean, exposure());
    }
    if (now.index > 0) {
      const Image& before = before_->pictures[method];
      const std::optional<Flicker> flicker =
          flicker_between(before, picture, before_->target.reference, target.reference, exposure());
      if (flicker)
        record.flicker = FrameFlicker{.whole = *flicker,
                                      .causes = flicker_causes(before, picture, before_->target, target, exposure())};
    }
    const std::string stem = method_stem(settings_.methods, method);
    record.image = write_picture(folder_, fmt::format("{}_{:04}", stem, now.index), picture, exposure());
    return record;
  }

  AnimationHead head() {
    Drawing& drawing = this->drawing();
    (void)exposure();
    AnimationHead head;
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
    head.path = word_for(animation_paths, settings_.path.kind);
    if (settings_.path.kind != AnimationPath::zoom) {
      const glm::dvec3 axis = turning_axis(settings_.path, scene_);
      head.axis = {axis.x, axis.y, axis.z};
    }
    const glm::ivec2 size = drawing.stage.view(1.0).size;
    head.width = size.x;
    head.height = size.y;
    head.frames = path_.size();
    return head;
  }

  const RunSettings& settings_;
  std::filesystem::path folder_;
  const FinishedWork& finished_;
  ProgressParts whole_;
  Progress stage_progress_;
  Scene scene_;
  std::vector<PathFrame> path_;
  std::string run_;
  std::unique_ptr<Drawing> drawing_;
  std::optional<Exposure> exposure_;
  std::optional<RenderedFrame> before_;
};

}  // namespace

std::string measure_animation(const RunSettings& settings, const FrameRange& range, const std::filesystem::path& folder,
                              const FinishedWork& finished, const Progress& progress) {
  return Animator(settings, folder, finished, progress).measure(range);
}

Animation joined_animation(const FinishedWork& finished, const std::string& run, const std::filesystem::path& folder) {
  const auto damaged = [&](const std::string& what) {
    return Error(ErrorKind::usage, finished.folder().string(), what + " is missing or damaged",
                 "run the part that has it again");
  };
  const std::optional<AnimationHead> head = finished.find<AnimationHead>(head_key(run), folder);
  if (!head) throw damaged("the description of the animation");
  Animation animation{.tool = {},
                      .backend = head->backend,
                      .scene = head->scene,
                      .reference = head->reference,
                      .footprint = head->footprint,
                      .way = {.path = head->path, .axis = head->axis},
                      .width = head->width,
                      .height = head->height,
                      .film = {},
                      .frames = {},
                      .records = {}};
  for (std::size_t i = 0; i < head->frames; ++i) {
    std::optional<FinishedFrame> frame = finished.find<FinishedFrame>(frame_key(run, i), folder);
    if (!frame) throw damaged(fmt::format("frame {} of {}", i + 1, head->frames));
    animation.reference.standard_errors.push_back(frame->frame.standard_error);
    animation.frames.push_back(std::move(frame->frame));
    std::ranges::move(frame->records, std::back_inserter(animation.records));
  }
  add_noise_warning(animation);
  return animation;
}

Animation run_animation(const RunSettings& settings, const std::filesystem::path& folder, const FinishedWork& finished,
                        const Progress& progress) {
  const auto all = [](std::size_t frames) { return std::pair<std::size_t, std::size_t>(0, frames); };
  return joined_animation(finished, measure_animation(settings, all, folder, finished, progress), folder);
}

}  // namespace footprint
