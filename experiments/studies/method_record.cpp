// Errors and flicker by cause, what a method prepared, what a pixel of it costs, and a picture of verdicts for each two
// methods.
#include "experiments/studies/method_record.hpp"

#include <fmt/format.h>

#include "experiments/studies/picture_files.hpp"
#include "experiments/studies/reference_view.hpp"
#include "experiments/studies/score.hpp"
#include "renderer/core/error.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/image/metrics.hpp"
#include "renderer/pipeline/supersample.hpp"
#include "results/report/ranking.hpp"

namespace footprint {
namespace {

// bound: of the footprint filter; null where there is none, as of a history.
ErrorCauses causes_of(const ReferenceView& target, const BoundPicture* bound, const Image& picture, float exposure) {
  ErrorCauses causes = error_causes({.method = picture,
                                     .reference = target.reference.mean,
                                     .bound = bound != nullptr ? &bound->picture : nullptr,
                                     .bound_pixels = bound != nullptr ? &bound->pixels : nullptr},
                                    target.parts, exposure);
  causes.shading_floor = target.shading_floor;
  if (target.reference.halves)
    causes.shading_noise = error_noise(picture, *target.reference.halves, exposure, target.parts.interior);
  return causes;
}

// Over interior pixels, where there are some: supersampling corrects edges, and no method here does.
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
  const BoundPicture* const bound = target.bound && !record.history ? &*target.bound : nullptr;
  record.error = RecordError{.normalized_color = figures->normalized_color,
                             .relative_rmse = figures->relative_rmse,
                             .relmse = figures->relmse,
                             .psnr = figures->psnr,
                             .energy_bias = figures->energy_bias,
                             .luminance_distance = figures->luminance_distance,
                             .luminances = figures->luminances,
                             .reference_luminances = figures->reference_luminances,
                             .noise_floor = target.noise_floor,
                             .causes = causes_of(target, bound, pictures.frame, exposure)};
  if (pictures.finest) {
    record.error->representation = normalized_color(*pictures.finest, target.reference.mean, exposure);
    record.error->filtering = normalized_color(pictures.frame, *pictures.finest, exposure);
  }
  record.highlight_energy = highlight_energy(pictures.frame, target.reference.mean, exposure);
  record.reference_highlight_energy = target.highlight_energy;
  record.equivalent = equivalent(target, *record.error);
  record.other_references = errors_against_others(target, pictures.frame, exposure);
}

std::optional<HistoryInfo> info_of(const HistorySettings& history) {
  if (history.frames == 0) return {};
  return HistoryInfo{.frames = history.frames,
                     .alpha = history.alpha,
                     .clamp = std::string(word_for(history_clamps, history.clamp)),
                     .jitter = history.jitter};
}

void name_reference(Record& record, const ReferenceView& target) {
  record.images.reference = target.files.reference;
  record.images.standard_error = target.files.standard_error;
  record.images.interior = target.files.interior;
}

Image in_both(const Image& first, const Image& second) {
  Image both = first;
  for (std::size_t i = 0; i < both.texels.size(); ++i) {
    if (second.texels[i] <= 0.0F) both.texels[i] = 0.0F;
  }
  return both;
}

Image without(const Image& mask, const Image& left_out) {
  Image rest = mask;
  for (std::size_t i = 0; i < rest.texels.size(); ++i) {
    if (left_out.texels[i] > 0.0F) rest.texels[i] = 0.0F;
  }
  return rest;
}

std::optional<PartFlicker> part_of(const std::optional<FlickerFigures>& figures) {
  if (!figures) return {};
  return PartFlicker{.mean = figures->mean, .p99 = figures->p99};
}

std::string write_verdicts(const std::filesystem::path& folder, const std::string& stem, const Image& verdicts,
                           const Image& object) {
  std::string file = fmt::format("images/{}.png", stem);
  write_png(folder / file, verdict_picture(verdicts, object));
  return file;
}

std::vector<std::array<double, 2>> shares_by_material(const Image& verdicts, const ReferenceView& target) {
  std::vector<std::array<double, 2>> shares;
  for (const Image& mask : target.materials) {
    const CloserShares own = closer_shares(verdicts, mask).value_or(CloserShares{});
    shares.push_back({own.a, own.b});
  }
  return shares;
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
  const EffectSet& honours = baked.method->info.honours;
  Record record;
  record.scene = stage_.scene().name;
  record.method = method.text();
  record.options = {baked.options.all().begin(), baked.options.all().end()};
  record.history = info_of(method.history());
  record.distance = target.at.distance;
  record.degrees = target.at.degrees;
  record.seconds = target.at.seconds;
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
  const MethodInfo& info = method.baked().method->info;
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
  if (method.baked().method->info.slow_frame) return;
  if (!counting_.contains(&method)) counting_.emplace(&method, stage_.counting_frames(method, Counting::work));
  const PixelWork work = pixel_work(counting_.at(&method), view);
  record.fetches = work.lookups;
  record.lobes = work.lobes;
}

FlickerCauses flicker_causes(const Image& before, const Image& picture, const ReferenceView& target_before,
                             const ReferenceView& target, float exposure) {
  const Image& old_reference = target_before.reference.mean;
  const Image& reference = target.reference.mean;
  const Image interior = in_both(target_before.parts.interior, target.parts.interior);
  const Image edges = without(object_pixels(reference), interior);
  const auto over = [&](const Image& mask) {
    return part_of(compare_changes_over(before, picture, old_reference, reference, exposure, mask));
  };
  FlickerCauses causes{.shading = over(interior), .edges = over(edges), .filter = {}, .method = {}};
  if (!target_before.bound || !target.bound) return causes;
  const Image pixels = in_both(target_before.bound->pixels, target.bound->pixels);
  const Image& old_bound = target_before.bound->picture;
  const Image& bound = target.bound->picture;
  causes.filter = part_of(compare_changes_over(old_bound, bound, old_reference, reference, exposure, pixels));
  causes.method = part_of(compare_changes_over(before, picture, as_reference(old_bound, old_reference),
                                               as_reference(bound, reference), exposure, pixels));
  return causes;
}

std::vector<MethodPair> compare_pairs(const std::filesystem::path& folder, std::span<const Record> records,
                                      std::span<const Image> images, std::span<const std::string> names,
                                      const ReferenceView& target, float exposure) {
  if (records.size() > most_methods_in_pairs) return {};
  const Image object = object_pixels(target.reference.mean);
  std::vector<MethodPair> pairs;
  for (std::size_t i = 0; i < records.size(); ++i) {
    for (std::size_t j = i + 1; j < records.size(); ++j) {
      if (records[i].failure || records[j].failure) continue;
      const std::optional<Image> verdicts = closer_beyond_noise(images[i], images[j], target.reference, exposure);
      const auto shares = verdicts ? closer_shares(*verdicts, target.parts.interior) : std::nullopt;
      if (!shares) continue;
      const std::string stem = fmt::format("{}_or_{}", distance_stem(target.at.distance, names[i]), names[j]);
      pairs.push_back({.distance = target.at.distance,
                       .methods = {records[i].method, records[j].method},
                       .closer = {shares->a, shares->b},
                       .materials = shares_by_material(*verdicts, target),
                       .picture = write_verdicts(folder, stem, *verdicts, object)});
    }
  }
  return pairs;
}

}  // namespace footprint
