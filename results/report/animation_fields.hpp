// The structures of animation_report.hpp taken apart, for archives that pack and unpack them, as in record_fields.hpp.
#pragma once

#include "results/report/animation_report.hpp"
#include "results/report/record_fields.hpp"

namespace footprint {

template <class Archive>
void fields(Archive& archive, PartFlicker& value) {
  auto& [mean, p99] = value;
  archive(mean, p99);
}

template <class Archive>
void fields(Archive& archive, FlickerCauses& value) {
  auto& [shading, edges, filter, method] = value;
  archive(shading, edges, filter, method);
}

template <class Archive>
void fields(Archive& archive, AnimationRecord& value) {
  auto& [frame, method, normalized_color, noise_floor, causes, flicker, flicker_causes, highlight_energy, image] =
      value;
  archive(frame, method, normalized_color, noise_floor, causes, flicker, flicker_causes, highlight_energy, image);
}

template <class Archive>
void fields(Archive& archive, AnimationFrame& value) {
  auto& [frame, distance, degrees, pixels, standard_error, highlight_energy, image] = value;
  archive(frame, distance, degrees, pixels, standard_error, highlight_energy, image);
}

template <class Archive>
void fields(Archive& archive, AnimationWay& value) {
  auto& [path, axis] = value;
  archive(path, axis);
}

}  // namespace footprint
