// Which settings enter the keys, and how frames become an animation again.
#include "experiments/studies/kept_animation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "experiments/studies/picture_files.hpp"
#include "experiments/studies/stage.hpp"
#include "renderer/core/error.hpp"
#include "renderer/scene/material_content.hpp"
#include "results/report/ranking.hpp"

namespace footprint {
namespace {

constexpr std::string_view head_kind = "animation", frame_kind = "frame";

std::string exposure_content(const RunSettings& settings) {
  const std::optional<Exposure>& given = settings.view.exposure;
  return given ? fmt::format("{} {}", given->factor, static_cast<int>(given->source)) : "the scene's, or automatic";
}

std::string content_of(const RunSettings& settings, const Scene& scene, const std::vector<PathFrame>& frames) {
  const glm::ivec2 size = frame_size(scene, settings.view.size);
  const ReferenceSettings& reference = settings.reference;
  ContentHash hash;
  add_content(hash, scene);
  hash.add(scene.source);
  hash.add(fmt::format("{}x{} {} {}", size.x, size.y, settings.backend.tile, exposure_content(settings)));
  hash.add(footprint_filter_text(footprint_filter_of(settings, scene)));
  hash.add(fmt::format("{} {} {} {} {}", reference.spp, reference.seed, static_cast<int>(reference.filter),
                       static_cast<int>(reference.environment), static_cast<int>(reference.bound)));
  hash.add(std::string(word_for(animation_paths, settings.path.kind)));
  if (const auto& axis = settings.path.axis) hash.add(fmt::format("{} {} {}", axis->x, axis->y, axis->z));
  for (const PathFrame& frame : frames) hash.add(fmt::format("{} {}", frame.distance, frame.degrees));
  for (std::size_t m = 0; m < settings.methods.size(); ++m) {
    hash.add(settings.methods[m].text);
    hash.add(method_stem(settings.methods, m));
  }
  return hash.hex();
}

// Frames whose errors the reference's own noise mostly explains.
void add_noise_warning(Animation& animation) {
  std::set<int> noisy;
  for (const AnimationRecord& record : animation.records) {
    if (record.normalized_color && is_mostly_noise(*record.normalized_color, record.noise_floor))
      noisy.insert(record.frame);
  }
  if (noisy.empty()) return;
  animation.scene.warnings.push_back(
      fmt::format("in {} of {} frames the reference has not converged: its noise floor is more than half of the least "
                  "error; raise --spp",
                  noisy.size(), animation.frames.size()));
}

Error damaged(const KeptWork& kept, const std::string& what) {
  return {ErrorKind::usage, kept.folder().string(), what, "run the parts of one animation, each once"};
}

}  // namespace

AnimationKeys::AnimationKeys(const KeptWork& work, const RunSettings& settings, const Scene& scene,
                             const std::vector<PathFrame>& frames)
    : work_(&work), content_(content_of(settings, scene, frames)) {}

std::string AnimationKeys::head() const { return work_->key(head_kind, std::vector{content_}); }

std::string AnimationKeys::frame(std::size_t index) const {
  return work_->key(frame_kind, std::vector{content_, fmt::format("{}", index)});
}

bool AnimationKeys::is_frame(const std::string& key) { return key.starts_with(fmt::format("{}-", frame_kind)); }

std::vector<std::string> files_of(const KeptFrame& frame) {
  std::vector<std::string> files;
  const auto add = [&](const std::string& exr) {
    files.push_back(exr);
    files.push_back(std::filesystem::path(exr).replace_extension(".png").string());
  };
  add(frame.frame.image);
  for (const AnimationRecord& record : frame.records) add(record.image);
  return files;
}

Animation joined_animation(const KeptWork& kept, const std::string& head, const std::vector<std::string>& keys,
                           const std::filesystem::path& folder) {
  const std::optional<KeptAnimation> known = kept.find<KeptAnimation>(head, folder);
  if (!known) throw damaged(kept, "what the animation says of itself is missing or damaged");
  std::map<int, KeptFrame> frames;
  for (const std::string& key : keys) {
    if (!AnimationKeys::is_frame(key)) continue;
    std::optional<KeptFrame> frame = kept.find<KeptFrame>(key, folder);
    if (!frame) throw damaged(kept, "a frame is damaged");
    const int number = frame->frame.frame;
    if (!frames.emplace(number, std::move(*frame)).second)
      throw damaged(kept, fmt::format("frame {} is there twice", number));
  }
  if (frames.size() != known->frames)
    throw damaged(kept, fmt::format("{} of {} frames are there", frames.size(), known->frames));
  Animation animation{.tool = {},
                      .backend = known->backend,
                      .scene = known->scene,
                      .reference = known->reference,
                      .footprint = known->footprint,
                      .way = known->way,
                      .width = known->width,
                      .height = known->height,
                      .film = {},
                      .frames = {},
                      .records = {}};
  for (auto& [number, frame] : frames) {
    animation.reference.standard_errors.push_back(frame.frame.standard_error);
    animation.frames.push_back(std::move(frame.frame));
    std::ranges::move(frame.records, std::back_inserter(animation.records));
  }
  add_noise_warning(animation);
  return animation;
}

}  // namespace footprint
