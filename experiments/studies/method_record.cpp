// Errors by cause, what a method prepared, and what a pixel of it costs.
#include "experiments/studies/method_record.hpp"

#include "experiments/studies/reference_noise.hpp"
#include "renderer/core/error.hpp"
#include "renderer/image/metrics.hpp"
#include "renderer/pipeline/unresolved.hpp"
#include "results/report/equivalent_spp.hpp"

namespace footprint {
namespace {

ErrorCauses causes_of(const Truth& truth, const Image& picture, float exposure) {
  ErrorCauses causes = error_causes({.method = picture,
                                     .reference = truth.reference.mean,
                                     .bound = truth.bound ? &truth.bound->picture : nullptr,
                                     .bound_pixels = truth.bound ? &truth.bound->pixels : nullptr},
                                    truth.parts, exposure);
  causes.shading_floor = truth.shading_floor;
  if (truth.reference.halves)
    causes.shading_noise = error_noise(picture, *truth.reference.halves, exposure, truth.parts.interior);
  return causes;
}

// Over interior pixels, where there are some: supersampling mends edges, and no method here does.
std::optional<EquivalentSamples> equivalent(const Truth& truth, const RecordError& error) {
  const std::optional<double>& shading = error.causes.shading;
  const auto curve = supersampling_curve(
      truth.curve, truth.distance, shading ? &SupersamplingPoint::shading : &SupersamplingPoint::normalized_color);
  return equivalent_samples(curve, shading.value_or(error.normalized_color));
}

std::vector<OtherReference> errors_against_others(const Truth& truth, const Image& picture, float exposure) {
  std::vector<OtherReference> errors;
  for (const OtherTruth& other : truth.others) {
    if (const auto error = normalized_color(picture, other.mean, exposure))
      errors.push_back({.spp = other.spp, .normalized_color = *error, .noise_floor = other.noise_floor});
  }
  return errors;
}

void set_error(Record& record, const Truth& truth, const MethodPictures& pictures, float exposure) {
  const std::optional<ErrorFigures> figures = compare_images(pictures.frame, truth.reference.mean, exposure);
  if (!figures) return;
  record.error = RecordError{.normalized_color = figures->normalized_color,
                             .relative_rmse = figures->relative_rmse,
                             .relmse = figures->relmse,
                             .psnr = figures->psnr,
                             .energy_bias = figures->energy_bias,
                             .luminance_distance = figures->luminance_distance,
                             .luminances = figures->luminances,
                             .reference_luminances = figures->reference_luminances,
                             .noise_floor = truth.noise_floor,
                             .causes = causes_of(truth, pictures.frame, exposure)};
  if (pictures.finest) {
    record.error->representation = normalized_color(*pictures.finest, truth.reference.mean, exposure);
    record.error->filtering = normalized_color(pictures.frame, *pictures.finest, exposure);
  }
  record.equivalent = equivalent(truth, *record.error);
  record.other_references = errors_against_others(truth, pictures.frame, exposure);
}

void name_reference(Record& record, const Truth& truth) {
  record.images.reference = truth.files.reference;
  record.images.standard_error = truth.files.standard_error;
  record.images.interior = truth.files.interior;
}

}  // namespace

Record MethodMeasurer::failed(const StagedMethod& method, const Truth& truth, const Error& why) const {
  Record record = described(method, truth);
  record.failure = why.what();
  name_reference(record, truth);
  return record;
}

Record MethodMeasurer::measure(const StagedMethod& method, const MethodPictures& pictures, const Truth& truth,
                               float exposure) {
  Record record = described(method, truth);
  set_error(record, truth, pictures, exposure);
  if (record.equivalent && &method == &stage_.methods()[stage_.unit()])
    record.equivalent = EquivalentSamples{.spp = 1, .side = CurveSide::within};  // a sample is one of its frames
  if (pictures.finest) set_light_error(record, truth, pictures.frame, method, exposure);
  set_material_errors(record, truth, pictures.frame, method, exposure);
  name_reference(record, truth);
  return record;
}

void MethodMeasurer::set_material_errors(Record& record, const Truth& truth, const Image& picture,
                                         const StagedMethod& method, float exposure) const {
  for (std::size_t i = 0; i < truth.materials.size(); ++i) {
    const Image& mask = truth.materials[i];
    const Image& reference = truth.reference.mean;
    MaterialError& error = record.materials.emplace_back();
    error.material = stage_.scene().materials[i].name;
    error.pixels = pixel_count(mask);
    error.bytes = byte_count(method.baked().materials[i]);
    error.shading = error_between(picture, reference, reference, exposure, mask);
    if (truth.reference.halves) error.noise = error_noise(picture, *truth.reference.halves, exposure, mask);
  }
}

Record MethodMeasurer::described(const StagedMethod& method, const Truth& truth) const {
  const BakedMethod& baked = method.baked();
  const EffectSet& honours = baked.method->info().honours;
  Record record;
  record.scene = stage_.scene().name;
  record.method = baked.spec.text;
  record.options = {baked.options.all().begin(), baked.options.all().end()};
  record.distance = truth.distance;
  record.frame = static_cast<int>(truth.frame);
  record.width = truth.view.size.x;
  record.height = truth.view.size.y;
  record.pixels = truth.parts.counts;
  record.precompute_seconds = baked.seconds;
  record.precompute_bytes = baked.bytes;
  if (baked.texels > 0)
    record.precompute_bytes_per_texel = static_cast<double>(baked.bytes) / static_cast<double>(baked.texels);
  record.precompute_cached = baked.cached;
  record.effects_on = effect_names(stage_.effects() & honours);
  record.effects_left_out = effect_names(stage_.effects() & ~honours);
  return record;
}

// The lookup of an environment by the method's lobes against all of its light shaded by the method.
void MethodMeasurer::set_light_error(Record& record, const Truth& truth, const Image& picture,
                                     const StagedMethod& method, float exposure) {
  const MethodInfo& info = method.baked().method->info();
  const bool is_lit = has(info.honours, Effect::environment_light) && !info.slow_frame;  // thousands of lights
  if (!record.error || truth.light.tiles.empty() || !is_lit) return;
  if (!dense_frames_.contains(&method)) dense_frames_.emplace(&method, stage_.dense_frames(method));
  const Image lit = dense_frames_.at(&method).render(truth.view, truth.light.tiles);
  Image pixels = truth.light.pixels;
  leave_out_infinite(lit, pixels);
  record.pixels.light = pixel_count(pixels);
  record.error->causes.light = error_between(picture, lit, truth.reference.mean, exposure, pixels);
}

std::optional<RecordWork> MethodMeasurer::work_of(const StagedMethod& method, const View& view) {
  if (method.baked().method->info().slow_frame) return {};
  if (!counting_.contains(&method)) counting_.emplace(&method, stage_.counting_frames(method));
  const PixelWork work = pixel_work(counting_.at(&method), view);
  return RecordWork{.fetches = work.lookups, .lobes = work.lobes};
}

}  // namespace footprint
