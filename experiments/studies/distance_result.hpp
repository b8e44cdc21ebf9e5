// One distance of a comparison as plain values: what remains of it once its images are written.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiments/settings/run_settings.hpp"
#include "experiments/studies/finished_work.hpp"
#include "results/report/record_fields.hpp"

namespace footprint {

/// Everything that was measured at one distance.
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

/// What a comparison says of itself, whatever its distances.
struct ComparisonHead {
  BackendInfo backend;
  SceneInfo scene;
  std::string footprint;
  std::optional<std::string> environment;                  ///< how the reference integrates it; none: there is none
  std::vector<std::string> first_warnings, last_warnings;  ///< before and after those of the distances
};

constexpr const auto& words_of(ExposureSource /*source*/) { return exposure_sources; }

template <class Archive>
void fields(Archive& archive, Is<DistanceResult> auto& value) {
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

template <class Archive>
void fields(Archive& archive, Is<ComparisonHead> auto& value) {
  archive("backend", value.backend);
  archive("scene", value.scene);
  archive("footprint", value.footprint);
  archive("environment", value.environment);
  archive("first_warnings", value.first_warnings);
  archive("last_warnings", value.last_warnings);
}

}  // namespace footprint
