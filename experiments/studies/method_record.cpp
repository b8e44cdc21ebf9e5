// Errors and flicker by cause, what a method prepared, what a pixel of it costs, and a picture of verdicts for each two
// methods.
#include "experiments/studies/reference_view.hpp"

#include <fmt/format.h>

#include "experiments/studies/picture_files.hpp"
#include "experiments/studies/score.hpp"
#include "renderer/core/error.hpp"
#include "renderer/image/image_io.hpp"
#include "results/report/figures.hpp"

namespace footprint {
namespace {

// More methods have no pairs: 861 images of 42 methods took longer than all that a distance measures.
constexpr std::size_t most_methods_in_pairs = 24;

// bound: of the footprint filter; null where there is none, as of a history.
ErrorCauses causes_of(const ReferenceView& target, const BoundPicture* bound, const Image& picture, float exposure) {
  ErrorCauses causes = error_causes(picture, target.reference.mean, bound, target.parts, exposure);
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

void set_error(Record& record, const ReferenceView& target, const Image& frame, const std::optional<Image>& finest,
               float exposure) {
  const std::optional<ErrorFigures> figures =
      compare_images(frame, target.reference.mean, exposure, target.parts.interior);
  if (!figures) return;
  const BoundPicture* const bound = target.bound && !record.history ? &*target.bound : nullptr;
  record.error = RecordError{*figures, target.noise_floor};
  record.error->causes = causes_of(target, bound, frame, exposure);
  if (finest) {
    record.error->representation = normalized_color(*finest, target.reference.mean, exposure);
    record.error->filtering = normalized_color(frame, *finest, exposure);
  }
  record.highlight_energy = highlight_energy(frame, target.reference.mean, exposure);
  record.reference_highlight_energy = target.highlight_energy;
  record.equivalent = equivalent(target, *record.error);
  record.other_references = errors_against_others(target, frame, exposure);
}

Image in_both(Image first, const Image& second) {
  std::ranges::transform(first.texels, second.texels, first.texels.begin(), std::multiplies<>());
  return first;
}

Image without(Image mask, const Image& left_out) {
  std::ranges::transform(mask.texels, left_out.texels, mask.texels.begin(), std::minus<>());
  return mask;
}

std::vector<std::array<double, 2>> shares_by_material(const Image& verdicts, const ReferenceView& target) {
  std::vector<std::array<double, 2>> shares;
  for (const Image& mask : target.materials)
    shares.push_back(closer_shares(verdicts, mask).value_or(std::array<double, 2>{}));
  return shares;
}

void set_material_errors(Record& record, const Stage& stage, const ReferenceView& target, const Image& picture,
                         const StagedMethod& method, float exposure) {
  for (std::size_t i = 0; i < target.materials.size(); ++i) {
    const Image& mask = target.materials[i];
    const Image& reference = target.reference.mean;
    MaterialError& error = record.materials.emplace_back();
    error.material = stage.scene().materials[i].name;
    error.pixels = pixel_count(mask);
    error.bytes = byte_count(method.baked().materials[i]);
    error.shading = error_between(picture, reference, reference, exposure, mask);
    if (target.reference.halves) error.noise = error_noise(picture, *target.reference.halves, exposure, mask);
  }
}

Record described(const Stage& stage, const StagedMethod& method, const ReferenceView& target) {
  const BakedMethod& baked = method.baked();
  const EffectSet& honours = baked.method->info.honours;
  Record record;
  record.scene = stage.scene().name;
  record.method = method.text();
  record.options = {baked.options.all().begin(), baked.options.all().end()};
  if (method.history().frames > 0) record.history = method.history();
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
  record.effects_on = effect_names(stage.effects() & honours);
  record.effects_left_out = effect_names(stage.effects() & ~honours);
  record.images = target.files;
  return record;
}

}  // namespace

Record MethodMeasurer::failed(const StagedMethod& method, const ReferenceView& target, const Error& why) const {
  Record record = described(stage_, method, target);
  record.failure = why.what();
  return record;
}

Record MethodMeasurer::measure(const StagedMethod& method, const Image& frame, const std::optional<Image>& finest,
                               const ReferenceView& target, float exposure) {
  Record record = described(stage_, method, target);
  set_error(record, target, frame, finest, exposure);
  if (record.equivalent && &method == &stage_.methods()[stage_.unit()])
    record.equivalent = EquivalentSamples{.spp = 1, .side = CurveSide::within};  // a sample is one of its frames
  if (finest) set_light_error(record, target, frame, method, exposure);
  set_material_errors(record, stage_, target, frame, method, exposure);
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
    return compare_changes(before, picture, old_reference, reference, exposure, mask);
  };
  FlickerCauses causes{.shading = over(interior), .edges = over(edges)};
  if (!target_before.bound || !target.bound) return causes;
  const Image pixels = in_both(target_before.bound->pixels, target.bound->pixels);
  const Image& old_bound = target_before.bound->picture;
  const Image& bound = target.bound->picture;
  causes.filter = compare_changes(old_bound, bound, old_reference, reference, exposure, pixels);
  causes.method = compare_changes(before, picture, as_reference(old_bound, old_reference),
                                  as_reference(bound, reference), exposure, pixels);
  return causes;
}

std::vector<MethodPair> compare_pairs(const RunFolder& folder, std::span<const Record> records,
                                      std::span<const Image> images, std::span<const std::string> names,
                                      const ReferenceView& target, float exposure) {
  if (records.size() > most_methods_in_pairs || !target.reference.halves) return {};
  const Image object = object_pixels(target.reference.mean);
  std::vector<MethodPair> pairs;
  for (std::size_t i = 0; i < records.size(); ++i) {
    for (std::size_t j = i + 1; j < records.size(); ++j) {
      if (records[i].failure || records[j].failure) continue;
      const Image verdicts =
          closer_beyond_noise(images[i], images[j], target.reference.mean, target.reference.standard_error, exposure);
      const auto shares = closer_shares(verdicts, target.parts.interior);
      if (!shares) continue;
      const std::string file =
          fmt::format("images/{}_or_{}.png", distance_stem(target.at.distance, names[i]), names[j]);
      folder.attempt(file, [&] { write_png(folder / file, verdict_picture(verdicts, object)); });
      pairs.push_back({.distance = target.at.distance,
                       .methods = {records[i].method, records[j].method},
                       .closer = *shares,
                       .materials = shares_by_material(verdicts, target),
                       .picture = file});
    }
  }
  return pairs;
}

}  // namespace footprint
