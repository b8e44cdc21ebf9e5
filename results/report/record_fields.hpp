// The structures of records.hpp taken apart, for archives that pack and unpack them (experiments/kept/packed.hpp). By
// structured bindings: a structure with a field more does not compile until that field is packed too.
#pragma once

#include "results/report/records.hpp"

namespace footprint {

template <class Archive>
void fields(Archive& archive, EquivalentSamples& value) {
  auto& [spp, side] = value;
  archive(spp, side);
}

template <class Archive>
void fields(Archive& archive, FrameBuildTime& value) {
  auto& [ms, timing] = value;
  archive(ms, timing);
}

template <class Archive>
void fields(Archive& archive, RecordWork& value) {
  auto& [fetches, lobes] = value;
  archive(fetches, lobes);
}

template <class Archive>
void fields(Archive& archive, FrameTime& value) {
  auto& [median, minimum, p90] = value;
  archive(median, minimum, p90);
}

template <class Archive>
void fields(Archive& archive, TimeRatio& value) {
  auto& [median, low, high] = value;
  archive(median, low, high);
}

template <class Archive>
void fields(Archive& archive, ErrorCauses& value) {
  auto& [shading, shading_floor, shading_noise, edges, filter, method, light] = value;
  archive(shading, shading_floor, shading_noise, edges, filter, method, light);
}

template <class Archive>
void fields(Archive& archive, PixelCounts& value) {
  auto& [object, unresolved, interior, minified, bound, light] = value;
  archive(object, unresolved, interior, minified, bound, light);
}

template <class Archive>
void fields(Archive& archive, RecordError& value) {
  auto& [normalized_color, relative_rmse, relmse, psnr, energy_bias, luminance_distance, luminances,
         reference_luminances, noise_floor, representation, filtering, causes] = value;
  archive(normalized_color, relative_rmse, relmse, psnr, energy_bias, luminance_distance, luminances,
          reference_luminances, noise_floor, representation, filtering, causes);
}

template <class Archive>
void fields(Archive& archive, Flicker& value) {
  auto& [mean, p99, noise_floor] = value;
  archive(mean, p99, noise_floor);
}

template <class Archive>
void fields(Archive& archive, OtherReference& value) {
  auto& [spp, normalized_color, noise_floor] = value;
  archive(spp, normalized_color, noise_floor);
}

template <class Archive>
void fields(Archive& archive, RecordImages& value) {
  auto& [color, reference, error, error_shared, interior, standard_error] = value;
  archive(color, reference, error, error_shared, interior, standard_error);
}

template <class Archive>
void fields(Archive& archive, MaterialError& value) {
  auto& [material, pixels, shading, noise, bytes] = value;
  archive(material, pixels, shading, noise, bytes);
}

template <class Archive>
void fields(Archive& archive, Record& value) {
  auto& [scene, method, options, distance, frame, width, height, failure, pixels, error, equivalent, other_references,
         flicker, node, frame_ms, frame_build, fps, ratio_to_direct, work, materials, precompute_seconds,
         precompute_bytes, precompute_bytes_per_texel, precompute_cached, effects_on, effects_left_out, images] = value;
  archive(scene, method, options, distance, frame, width, height, failure, pixels, error, equivalent, other_references,
          flicker, node, frame_ms, frame_build, fps, ratio_to_direct, work, materials, precompute_seconds,
          precompute_bytes, precompute_bytes_per_texel, precompute_cached, effects_on, effects_left_out, images);
}

template <class Archive>
void fields(Archive& archive, MethodPair& value) {
  auto& [distance, methods, closer, materials, picture] = value;
  archive(distance, methods, closer, materials, picture);
}

template <class Archive>
void fields(Archive& archive, SupersamplingPoint& value) {
  auto& [distance, spp, normalized_color, shading, ms, node] = value;
  archive(distance, spp, normalized_color, shading, ms, node);
}

template <class Archive>
void fields(Archive& archive, FootprintNdf& value) {
  auto& [footprint, method, l2, energy, peak, lobes, picture] = value;
  archive(footprint, method, l2, energy, peak, lobes, picture);
}

template <class Archive>
void fields(Archive& archive, QuantityFigure& value) {
  auto& [name, method, quantity, figure] = value;
  archive(name, method, quantity, figure);
}

template <class Archive>
void fields(Archive& archive, BackendInfo& value) {
  auto& [name, renderer, version, cpu] = value;
  archive(name, renderer, version, cpu);
}

template <class Archive>
void fields(Archive& archive, SceneInfo& value) {
  auto& [name, source, triangles, materials, lights, exposure, exposure_source, defaults, warnings] = value;
  archive(name, source, triangles, materials, lights, exposure, exposure_source, defaults, warnings);
}

}  // namespace footprint
