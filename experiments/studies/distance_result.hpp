// Views of a run as plain values, which remain once their images are written, and the results that they make.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiments/settings/run_settings.hpp"
#include "experiments/studies/finished_work.hpp"
#include "results/report/record_fields.hpp"

namespace footprint {

/// Everything that was measured in one view.
struct DistanceResult {
  double distance = 1;
  Exposure exposure;
  std::optional<double> wanted_noise;     ///< noise floor that the reference was refined to; none: not refined
  std::optional<double> standard_error;   ///< of the reference, relative to its mean radiance
  double samples = 0;                     ///< of the reference per pixel, mean over the image
  double seconds = 0;                     ///< that the reference took
  std::string reference;                  ///< EXR, from the output folder
  std::vector<std::uint32_t> unresolved;  ///< indices of the pixels that no figure includes
  double largest_error = 0;               ///< 99th percentile of the error over pixels, the largest of all methods
  std::vector<Record> records;            ///< one per method
  std::vector<MethodPair> pairs;
  std::vector<SupersamplingPoint> curve;
  int processes = 1;  ///< that took times
  std::vector<std::string> warnings;
};

/// The part of a run's results that does not depend on its views.
struct ComparisonHead {
  BackendInfo backend;
  SceneInfo scene;
  ReferenceInfo reference;  ///< as requested
  std::string footprint;
  std::optional<AnimationWay> way;                         ///< none: not an animation
  std::size_t frames = 0;                                  ///< of a path; 0: no path
  int timed_frames = 0;                                    ///< as TimingInfo has it
  std::optional<double> error_scale;                       ///< of all error images; none: derived from the run
  std::vector<std::string> first_warnings, last_warnings;  ///< before and after those of the views
};

constexpr const auto& words_of(ExposureSource /*source*/) { return exposure_sources; }

void fields(auto& archive, Is<DistanceResult> auto& value) {
  archive("distance", value.distance);
  archive("exposure", std::tie(value.exposure.factor, value.exposure.source));
  archive("wanted_noise", value.wanted_noise);
  archive("standard_error", value.standard_error);
  archive("samples", value.samples);
  archive("seconds", value.seconds);
  archive("reference", value.reference);
  archive("unresolved", value.unresolved);
  archive("largest_error", value.largest_error);
  archive("records", value.records);
  archive("pairs", value.pairs);
  archive("curve", value.curve);
  archive("processes", value.processes);
  archive("warnings", value.warnings);
}

void fields(auto& archive, Is<ComparisonHead> auto& value) {
  archive("backend", value.backend);
  archive("scene", value.scene);
  archive("reference", value.reference);
  archive("footprint", value.footprint);
  archive("way", value.way);
  archive("frames", value.frames);
  archive("timed_frames", value.timed_frames);
  archive("error_scale", value.error_scale);
  archive("first_warnings", value.first_warnings);
  archive("last_warnings", value.last_warnings);
}

/// The name of a frame of an animation in finished work.
[[nodiscard]] std::string frame_name(std::size_t index);

/// The results of one view or more. They lack tool and backend.cpu.
[[nodiscard]] Results results_of(const ComparisonHead& head, const std::vector<DistanceResult>& views);

/// The results of an animation whose frames are all finished; its images go to FOLDER/images. They lack tool and
/// backend.cpu.
/// run: fingerprint of measure_views (compare.hpp).
/// Errors (usage): a frame is missing or damaged.
[[nodiscard]] Results joined_animation(const FinishedWork& finished, const std::string& run,
                                       const std::filesystem::path& folder);

}  // namespace footprint
