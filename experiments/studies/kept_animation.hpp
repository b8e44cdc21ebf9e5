// What an animation keeps between runs, frame by frame, and the keys that it is kept under.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "experiments/kept/kept_work.hpp"
#include "experiments/settings/run_settings.hpp"
#include "experiments/studies/camera_path.hpp"
#include "results/report/animation_fields.hpp"

namespace footprint {

/// What an animation says of itself, whatever its frames show.
struct KeptAnimation {
  BackendInfo backend;
  SceneInfo scene;
  ReferenceInfo reference;
  std::string footprint;
  AnimationWay way;
  int width = 0, height = 0;
  std::size_t frames = 0;
};

/// One frame with its pictures.
struct KeptFrame {
  AnimationFrame frame;
  std::vector<AnimationRecord> records;
};

template <class Archive>
void fields(Archive& archive, ReferenceInfo& value) {
  auto& [spp, filter, seed, standard_errors, environment, samples, seconds] = value;
  archive(spp, filter, seed, standard_errors, environment, samples, seconds);
}

template <class Archive>
void fields(Archive& archive, KeptAnimation& value) {
  auto& [backend, scene, reference, footprint, way, width, height, frames] = value;
  archive(backend, scene, reference, footprint, way, width, height, frames);
}

template <class Archive>
void fields(Archive& archive, KeptFrame& value) {
  auto& [frame, records] = value;
  archive(frame, records);
}

/// The keys of an animation's parts: each hashes everything that the pictures depend on.
class AnimationKeys {
 public:
  AnimationKeys(const KeptWork& work, const RunSettings& settings, const Scene& scene,
                const std::vector<PathFrame>& frames);

  [[nodiscard]] std::string head() const;
  [[nodiscard]] std::string frame(std::size_t index) const;
  /// Whether a key is that of a frame of some animation.
  [[nodiscard]] static bool is_frame(const std::string& key);

 private:
  const KeptWork* work_;
  std::string content_;
};

/// The files of a kept frame, from the folder of a run.
[[nodiscard]] std::vector<std::string> files_of(const KeptFrame& frame);

/// The animation of what is kept. Errors (usage): the head or a frame is missing, or is there twice, naming the folder.
[[nodiscard]] Animation joined_animation(const KeptWork& kept, const std::string& head,
                                         const std::vector<std::string>& keys, const std::filesystem::path& folder);

}  // namespace footprint
