// Each frame of a zoom: the reference, every method, and what changed since the frame before.
#include "experiments/studies/animate.hpp"

#include <fmt/format.h>

#include <set>
#include <utility>

#include "experiments/studies/exposure.hpp"
#include "experiments/studies/picture_files.hpp"
#include "experiments/studies/reference_noise.hpp"
#include "experiments/studies/run_info.hpp"
#include "experiments/studies/stage.hpp"
#include "experiments/studies/zoom.hpp"
#include "renderer/image/metrics.hpp"
#include "renderer/pipeline/unresolved.hpp"
#include "renderer/scene/assembly/load_scene.hpp"
#include "results/report/ranking.hpp"

namespace footprint {
namespace {

constexpr double method_weight = 2.0;  // of a method's frame, in reference samples

// A frame as it is held until the next one has been compared with it.
struct HeldFrame {
  Supersampled reference;
  std::vector<Image> pictures;  // one a method
};

class Animator {
 public:
  Animator(const RunSettings& settings, std::filesystem::path folder, const Progress& progress)
      : settings_(settings),
        folder_(std::move(folder)),
        whole_(progress, 4),
        stage_(load_scene(settings.scene, settings.scene_library, settings.overrides), settings, whole_.next(1, "")),
        distances_(run_distances(settings.view, stage_.scene())),
        parts_(whole_.next(3, ""),
               static_cast<double>(distances_.size()) * (settings.reference.spp + methods_weight())) {
    // Two frames are held, each with the reference, its halves and its error; and what is worked on.
    constexpr int of_the_reference = 8, worked_on = 6;
    require_pictures(stage_.view(1.0).size,
                     2 * static_cast<int>(stage_.methods().size()) + of_the_reference + worked_on);
  }

  Animation run() {
    std::filesystem::create_directories(folder_ / "images");
    std::optional<HeldFrame> before;
    for (std::size_t frame = 0; frame < distances_.size(); ++frame) before = add_frame(frame, before);
    animation_.backend = backend_info(stage_.context().info());
    animation_.scene = scene_info(stage_.scene(), exposure_);
    add_noise_warning();
    const glm::ivec2 size = stage_.view(1.0).size;
    animation_.width = size.x;
    animation_.height = size.y;
    return std::move(animation_);
  }

 private:
  void add_noise_warning() {
    std::set<int> noisy;
    for (const AnimationRecord& record : animation_.records) {
      if (record.normalized_color && is_mostly_noise(*record.normalized_color, record.noise_floor))
        noisy.insert(record.frame);
    }
    if (noisy.empty()) return;
    animation_.scene.warnings.push_back(fmt::format(
        "in {} of {} frames the reference has not converged: its noise floor is more than half of the least "
        "error; raise --spp",
        noisy.size(), distances_.size()));
  }

  [[nodiscard]] double methods_weight() const { return method_weight * static_cast<double>(stage_.methods().size()); }

  HeldFrame add_frame(std::size_t frame, const std::optional<HeldFrame>& before) {
    const View view = stage_.view(distances_[frame]);
    const std::string prefix = fmt::format("frame {} of {}: ", frame + 1, distances_.size());
    const ReferenceSettings& asked = settings_.reference;
    const Progress sampling = parts_.next(asked.spp, prefix + "reference, ");
    HeldFrame now{.reference = stage_.reference().render(view, asked.spp, asked.seed, sampling), .pictures = {}};
    if (frame == 0) describe_reference(now.reference);
    animation_.reference_images.push_back(
        write_picture(folder_, fmt::format("reference_{:04}", frame), now.reference.mean, exposure_.factor));
    leave_out(now.reference, unresolved(now.reference, exposure_.factor));  // as a comparison does
    const Progress drawing = parts_.next(methods_weight(), prefix);
    for (std::size_t m = 0; m < stage_.methods().size(); ++m) {
      drawing(settings_.methods[m].text, static_cast<double>(m) / static_cast<double>(stage_.methods().size()));
      add_picture(frame, m, view, before, now);
    }
    return now;
  }

  void describe_reference(const Supersampled& first) {
    exposure_ = choose_exposure(settings_.view.exposure, stage_.scene(), first.mean);
    const ReferenceSettings& reference = settings_.reference;
    animation_.reference = {.spp = reference.spp,
                            .filter = std::string(word_for(reference_filters, reference.filter)),
                            .seed = reference.seed,
                            .standard_error = relative_standard_error(first),
                            .environment = {}};
    if (has(stage_.effects(), Effect::environment_light))
      animation_.reference.environment = word_for(reference_integrals, reference.environment);
  }

  void add_picture(std::size_t frame, std::size_t method, const View& view, const std::optional<HeldFrame>& before,
                   HeldFrame& now) {
    const std::string& text = settings_.methods[method].text;
    Image picture = stage_.methods()[method].frames().render(view);
    stage_.context().check("rendering " + text);
    AnimationRecord record{.frame = static_cast<int>(frame),
                           .distance = distances_[frame],
                           .method = text,
                           .normalized_color = {},
                           .noise_floor = {},
                           .flicker = {},
                           .image = {}};
    if (const auto figures = compare_images(picture, now.reference.mean, exposure_.factor)) {
      record.normalized_color = figures->normalized_color;
      record.noise_floor = noise_floor(now.reference, exposure_.factor);
    }
    if (before) {
      record.flicker =
          flicker_between(before->pictures[method], picture, before->reference, now.reference, exposure_.factor);
    }
    const std::string stem = method_stem(settings_.methods, method);
    record.image = write_picture(folder_, fmt::format("{}_{:04}", stem, frame), picture, exposure_.factor);
    animation_.records.push_back(std::move(record));
    now.pictures.push_back(std::move(picture));
  }

  const RunSettings& settings_;
  std::filesystem::path folder_;
  ProgressParts whole_;
  Stage stage_;
  std::vector<double> distances_;
  ProgressParts parts_;
  Exposure exposure_;
  Animation animation_;
};

}  // namespace

Animation run_animation(const RunSettings& settings, const std::filesystem::path& folder, const Progress& progress) {
  return Animator(settings, folder, progress).run();
}

}  // namespace footprint
