// Errors by cause, what a method prepared, and what a pixel of it costs.
#include "experiments/studies/method_record.hpp"

#include "experiments/studies/reference_noise.hpp"
#include "renderer/core/error.hpp"
#include "renderer/image/metrics.hpp"
#include "renderer/pipeline/supersample.hpp"
#include "results/report/ranking.hpp"

namespace footprint {
namespace {

ErrorCauses causes_of(const ReferenceView& target, const Image& picture, float exposure) {
  ErrorCauses causes = error_causes({.method = picture,
                                     .reference = target.reference.mean,
                                     .bound = target.bound ? &target.bound->picture : nullptr,
                                     .bound_pixels = target.bound ? &target.bound->pixels : nullptr},
                                    target.parts, exposure);
  causes.shading_floor = target.shading_floor;
  if (target.reference.halves)
    causes.shading_noise = error_noise(picture, *target.reference.halves, exposure, target.parts.interior);
  return causes;
}

// Over interior pixels, where there are some: supersampling mends edges, and no method here does.
std::optional<EquivalentSamples> equivalent(const ReferenceView& target, const RecordError& error) {
  const std::optional<double>& shading = error.causes.shading;
  const auto curve = supersampling_curve(
      target.curve, target.at.distance, shading ? &SupersamplingPoint::shading : &SupersamplingPoint::normalized_color);
  return equivalent_samples(curve, shading.value_or(error.normalized_color));
}

std::vector<OtherReference> errors_against_others(const ReferenceView& target, const Image& picture, float exposure) {
  std::vector<OtherReference> errors;
  for (const OtherReferenceImage& other : target.others) {
    if (const auto error = normalized_color(picture, other.mean, exposure))
      errors.push_back({.spp = other.spp, .normalized_color = *error, .noise_floor = other.noise_floor});
  }
  return errors;
}

void set_error(Record& record, const ReferenceView& target, const MethodPictures& pictures, float exposure) {
  const std::optional<ErrorFigures> figures = compare_images(pictures.frame, target.reference.mean, exposure);
  if (!figures) return;
  record.error = RecordError{.normalized_color = figures->normalized_color,
                             .relative_rmse = figures->relative_rmse,
                             .relmse = figures->relmse,
                             .psnr = figures->psnr,
                             .energy_bias = figures->energy_bias,
                             .luminance_distance = figures->luminance_distance,
                             .luminances = figures->luminances,
                             .reference_luminances = figures->reference_luminances,
                             .noise_floor = target.noise_floor,
                             .causes = causes_of(target, pictures.frame, exposure)};
  if (pictures.finest) {
    record.error->representation = normalized_color(*pictures.finest, target.reference.mean, exposure);
    record.error->filtering = normalized_color(pictures.frame, *pictures.finest, exposure);
  }
  record.highlight_energy = highlight_energy(pictures.frame, target.reference.mean, exposure);
  record.reference_highlight_energy = target.highlight_energy;
  record.equivalent = equivalent(target, *record.error);
  record.other_references = errors_against_others(target, pictures.frame, exposure);
}

void name_reference(Record& record, const ReferenceView& target) {
  record.images.reference = target.files.reference;
  record.images.standard_error = target.files.standard_error;
  record.images.interior = target.files.interior;
}

}  // namespace

Record MethodMeasurer::failed(const StagedMethod& method, const ReferenceView& target, const Error& why) const {
  Record record = described(method, target);
  record.failure = why.what();
  name_reference(record, target);
  return record;
}

Record MethodMeasurer::measure(const StagedMethod& method, const MethodPictures& pictures, const ReferenceView& target,
                               float exposure) {
  Record record = described(method, target);
  set_error(record, target, pictures, exposure);
  if (record.equivalent && &method == &stage_.methods()[stage_.unit()])
    record.equivalent = EquivalentSamples{.spp = 1, .side = CurveSide::within};  // a sample is one of its frames
  if (pictures.finest) set_light_error(record, target, pictures.frame, method, exposure);
  set_material_errors(record, target, pictures.frame, method, exposure);
  name_reference(record, target);
  return record;
}

void MethodMeasurer::set_material_errors(Record& record, const ReferenceView& target, const Image& picture,
                                         const StagedMethod& method, float exposure) const {
  for (std::size_t i = 0; i < target.materials.size(); ++i) {
    const Image& mask = target.materials[i];
    const Image& reference = target.reference.mean;
    MaterialError& error = record.materials.emplace_back();
    error.material = stage_.scene().materials[i].name;
    error.pixels = pixel_count(mask);
    error.bytes = byte_count(method.baked().materials[i]);
    error.shading = error_between(picture, reference, reference, exposure, mask);
    if (target.reference.halves) error.noise = error_noise(picture, *target.reference.halves, exposure, mask);
  }
}

Record MethodMeasurer::described(const StagedMethod& method, const ReferenceView& target) const {
  const BakedMethod& baked = method.baked();
  const EffectSet& honours = baked.method->info().honours;
  Record record;
  record.scene = stage_.scene().name;
  record.method = baked.spec.text;
  record.options = {baked.options.all().begin(), baked.options.all().end()};
  record.distance = target.at.distance;
  record.degrees = target.at.degrees;
  record.frame = static_cast<int>(target.index);
  record.width = target.view.size.x;
  record.height = target.view.size.y;
  record.pixels = target.parts.counts;
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
void MethodMeasurer::set_light_error(Record& record, const ReferenceView& target, const Image& picture,
                                     const StagedMethod& method, float exposure) {
  const MethodInfo& info = method.baked().method->info();
  const bool is_lit = has(info.honours, Effect::environment_light) && !info.slow_frame;  // thousands of lights
  if (!record.error || target.light.tiles.empty() || !is_lit) return;
  if (!dense_frames_.contains(&method)) dense_frames_.emplace(&method, stage_.dense_frames(method));
  const Image lit = dense_frames_.at(&method).render(target.view, target.light.tiles);
  Image pixels = target.light.pixels;
  leave_out_infinite(lit, pixels);
  record.pixels.light = pixel_count(pixels);
  record.error->causes.light = error_between(picture, lit, target.reference.mean, exposure, pixels);
}

void MethodMeasurer::count_work(Record& record, const StagedMethod& method, const View& view) {
  if (method.baked().method->info().slow_frame) return;
  if (!counting_.contains(&method)) counting_.emplace(&method, stage_.counting_frames(method, Counting::work));
  const PixelWork work = pixel_work(counting_.at(&method), view);
  record.fetches = work.lookups;
  record.lobes = work.lobes;
}

}  // namespace footprint
