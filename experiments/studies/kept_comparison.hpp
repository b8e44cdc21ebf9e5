// What a comparison keeps between runs, part by part, and the keys that it is kept under.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/kept/kept_work.hpp"
#include "experiments/settings/run_settings.hpp"
#include "experiments/studies/exposure.hpp"
#include "experiments/studies/frame_times.hpp"
#include "experiments/studies/truth.hpp"
#include "results/report/record_fields.hpp"

namespace footprint {

/// Of one distance's truth what outlives it.
struct KeptTruth {
  Exposure exposure;
  std::optional<double> standard_error;  ///< relative
  double samples = 0, seconds = 0;
  std::vector<std::uint32_t> unresolved;  ///< the pixels that are left out of every figure, by their index
  TruthFiles files;
  std::vector<SupersamplingPoint> curve;
  std::vector<std::string> warnings;
};

/// One method at one distance, but for its times.
struct KeptRecord {
  Record record;
  std::string stem, name;  ///< as Draft has them
};

/// Frame times of one distance, of all methods in turn.
struct KeptTimes {
  std::vector<DistanceTimes> processes;
  std::vector<std::optional<BuildTiming>> builds;  ///< of each method; none: it rebuilds nothing
  std::size_t unit = 0;                            ///< the method that ratios are to
  std::string node;                                ///< that they were taken on
};

/// What a comparison says of itself.
struct KeptHead {
  BackendInfo backend;
  SceneInfo scene;
  std::string footprint;
  bool lit_by_environment = false;
  std::vector<std::string> first_warnings, last_warnings;  ///< before those of the distances and after them
};

template <class Archive>
void fields(Archive& archive, Exposure& value) {
  auto& [factor, source] = value;
  archive(factor, source);
}

template <class Archive>
void fields(Archive& archive, TruthFiles& value) {
  auto& [reference, standard_error, interior] = value;
  archive(reference, standard_error, interior);
}

template <class Archive>
void fields(Archive& archive, Image& value) {
  auto& [width, height, channels, texels] = value;
  archive(width, height, channels, texels);
}

template <class Archive>
void fields(Archive& archive, Interior& value) {
  auto& [mask, texels] = value;
  archive(mask, texels);
}

template <class Archive>
void fields(Archive& archive, Supersampled& value) {
  auto& [spp, mean, standard_error, halves] = value;
  archive(spp, mean, standard_error, halves);
}

template <class Archive>
void fields(Archive& archive, SharedTruth::AtDistance& value) {
  auto& [distance, reference, begun, first, samples, seconds, interior] = value;
  archive(distance, reference, begun, first, samples, seconds, interior);
}

template <class Archive>
void fields(Archive& archive, KeptTruth& value) {
  auto& [exposure, standard_error, samples, seconds, unresolved, files, curve, warnings] = value;
  archive(exposure, standard_error, samples, seconds, unresolved, files, curve, warnings);
}

template <class Archive>
void fields(Archive& archive, KeptRecord& value) {
  auto& [record, stem, name] = value;
  archive(record, stem, name);
}

template <class Archive>
void fields(Archive& archive, KeptTimes& value) {
  auto& [processes, builds, unit, node] = value;
  archive(processes, builds, unit, node);
}

template <class Archive>
void fields(Archive& archive, KeptHead& value) {
  auto& [backend, scene, footprint, lit_by_environment, first_warnings, last_warnings] = value;
  archive(backend, scene, footprint, lit_by_environment, first_warnings, last_warnings);
}

/// A hash of all that a scene is, as it was loaded.
[[nodiscard]] std::string scene_content(const Scene& scene);

/// The keys of the parts of one comparison: each hashes what its part depends on and nothing else, so that a change
/// leaves the other parts as they are.
class ComparisonKeys {
 public:
  /// `scene` is the settings' own, `content` its scene_content, `distances` all of the comparison.
  ComparisonKeys(const KeptWork& work, const RunSettings& settings, const Scene& scene, const std::string& content,
                 std::vector<double> distances);

  [[nodiscard]] std::string truth(std::size_t distance) const;
  [[nodiscard]] std::string record(std::size_t distance, std::size_t method) const;
  [[nodiscard]] std::string pairs(std::size_t distance) const;
  [[nodiscard]] std::string times(std::size_t distance) const;
  [[nodiscard]] std::string head() const;
  /// Of a truth that comparisons share: `first` is what that of the first of them depends on.
  [[nodiscard]] std::string shared_truth(const std::string& first, std::size_t distance) const;
  [[nodiscard]] std::string truth_content() const { return scene_ + reference_; }
  /// Of anything else that depends on the scene, the methods and `more` alone.
  [[nodiscard]] std::string of_scene(std::string_view kind, const std::vector<std::string>& more) const;

  /// All that are needed of one distance.
  [[nodiscard]] std::vector<std::string> all_of(std::size_t distance) const;

 private:
  [[nodiscard]] std::vector<std::string> with_methods(std::vector<std::string> fields) const;

  const KeptWork* work_;
  const RunSettings* settings_;
  std::vector<double> distances_;
  std::string scene_, reference_, source_;  // hashes of what all parts, and what all of the pictures depend on
};

/// The files that write_exposable_picture makes of "images/STEM.exr".
[[nodiscard]] std::vector<std::string> exposable_files(const std::string& exr);

/// The files of one distance's truth.
[[nodiscard]] std::vector<std::string> files_of(const TruthFiles& files);

/// The places in a mask that are set, and a mask of them.
[[nodiscard]] std::vector<std::uint32_t> set_pixels(const Image& mask);
[[nodiscard]] Image mask_of(std::span<const std::uint32_t> pixels, int width, int height);

}  // namespace footprint
