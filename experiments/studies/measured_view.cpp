// Errors by cause, what a method prepared, what a pixel of it costs, and the verdicts for each two methods.
#include "experiments/studies/measured_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "experiments/studies/picture_files.hpp"
#include "experiments/studies/score.hpp"
#include "renderer/core/error.hpp"
#include "renderer/image/metrics.hpp"
#include "results/report/figures.hpp"
#include "results/report/ranking.hpp"

namespace footprint {
namespace {

// More methods have no pairs: 861 images of 42 methods took longer than all that a distance measures.
constexpr std::size_t most_methods_in_pairs = 24;

// bound: of the footprint filter; null where there is none, as of a history.
ErrorCauses separate_causes(const Reference& target, const BoundPicture* bound, const Image& picture, float exposure) {
  ErrorCauses causes = error_causes(picture, target.reference.mean, bound, target.parts, exposure);
  causes.shading_floor = target.shading_floor;
  if (target.reference.halves)
    causes.shading_noise = error_noise(picture, *target.reference.halves, exposure, target.parts.interior);
  return causes;
}

// Over interior pixels, where there are some: supersampling corrects edges, and no method here does.
std::optional<EquivalentSamples> equivalent(const Reference& target, const RecordError& error) {
  const std::optional<double>& shading = error.causes.shading;
  const auto curve =
      supersampling_curve(target.curve, target.place.at.distance,
                          shading ? &SupersamplingPoint::shading : &SupersamplingPoint::normalized_color);
  return equivalent_samples(curve, shading.value_or(error.normalized_color));
}

std::vector<OtherReference> errors_against_others(const Reference& target, const Image& picture, float exposure) {
  std::vector<OtherReference> errors;
  for (const OtherReferenceImage& other : target.others) {
    if (const auto error = normalized_color(picture, other.mean, exposure))
      errors.push_back({.spp = other.spp, .normalized_color = *error, .noise_floor = other.noise_floor});
  }
  return errors;
}

void set_error(Record& record, const Reference& target, const Image& frame, const std::optional<Image>& finest,
               float exposure) {
  const std::optional<ErrorFigures> figures =
      compare_images(frame, target.reference.mean, exposure, target.parts.interior);
  if (!figures) return;
  const BoundPicture* const bound = target.bound && !record.history ? &*target.bound : nullptr;
  record.error = RecordError{*figures, target.noise_floor};
  record.error->causes = separate_causes(target, bound, frame, exposure);
  if (finest) {
    record.error->representation = normalized_color(*finest, target.reference.mean, exposure);
    record.error->filtering = normalized_color(frame, *finest, exposure);
  }
  record.highlight_energy = highlight_energy(frame, target.reference.mean, exposure);
  record.reference_highlight_energy = target.highlight_energy;
  record.equivalent = equivalent(target, *record.error);
  record.other_references = errors_against_others(target, frame, exposure);
}

void set_material_errors(Record& record, const Stage& stage, const Reference& target, const Image& picture,
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

Record described(const Stage& stage, const StagedMethod& method, const Reference& target) {
  const BakedMethod& baked = method.baked();
  const EffectSet& honours = baked.method->info.honours;
  Record record;
  record.scene = stage.scene().name;
  record.method = method.text();
  record.options = {baked.options.all().begin(), baked.options.all().end()};
  if (method.history().frames > 0) record.history = method.history();
  record.distance = target.place.at.distance;
  record.degrees = target.place.at.degrees;
  record.seconds = target.place.at.seconds;
  record.frame = static_cast<int>(target.place.index);
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
  return record;
}

// Sets the error of an environment's lookup by the method's lobes: against all of its light, shaded by the method.
void set_light_error(Record& record, const Stage& stage, MethodTools& tools, const Reference& target,
                     const Image& picture, const StagedMethod& method, float exposure) {
  const MethodInfo& info = method.baked().method->info;
  const bool is_lit = has(info.honours, Effect::environment_light) && !info.slow_frame;  // thousands of lights
  if (!record.error || target.light.tiles.empty() || !is_lit) return;
  if (!tools.dense.contains(&method)) tools.dense.emplace(&method, stage.dense_frames(method));
  const Image lit = tools.dense.at(&method).render(target.view, target.light.tiles);
  Image pixels = target.light.pixels;
  leave_out_infinite(lit, pixels);
  record.pixels.light = pixel_count(pixels);
  record.error->causes.light = error_between(picture, lit, target.reference.mean, exposure, pixels);
}

// Counts the texture lookups and lobes per pixel, except of methods whose frames take seconds: counting takes as long.
void count_work(Record& record, const Stage& stage, MethodTools& tools, const StagedMethod& method, const View& view) {
  if (method.baked().method->info.slow_frame) return;
  if (!tools.counting.contains(&method)) tools.counting.emplace(&method, stage.counting_frames(method, Counting::work));
  const PixelWork work = pixel_work(tools.counting.at(&method), view);
  record.fetches = work.lookups;
  record.lobes = work.lobes;
}

// A method's finest level, supersampled, as converged as the reference.
Image finest_level(const Stage& stage, const StagedMethod& method, const Reference& target,
                   const ReferenceSettings& settings, const Progress& progress) {
  Image finest = finest_mean(stage.finest_level(method), target.view, settings, progress);
  return target.first.texels.empty() ? finest : as_converged(finest, target.first, target.reference.mean);
}

// Compares an image of a method.
// finest: its finest level; none: the errors that need it are left out, and so is the one of an environment's lookup.
Record measured(const Stage& stage, MethodTools& tools, const StagedMethod& method, const Image& image,
                const std::optional<Image>& finest, const Reference& target, float exposure) {
  Record record = described(stage, method, target);
  set_error(record, target, image, finest, exposure);
  if (record.equivalent && &method == &stage.methods()[stage.unit()])
    record.equivalent = EquivalentSamples{.spp = 1, .side = CurveSide::within};  // a sample is one of its frames
  if (finest) set_light_error(record, stage, tools, target, image, method, exposure);
  set_material_errors(record, stage, target, image, method, exposure);
  if (target.place.kind == RunKind::animation) return record;
  count_work(record, stage, tools, method, target.view);
  if (tools.gpu_costs) record.gpu_costs = tools.gpu_costs->costs(method, target.view, no_progress).gpus;
  return record;
}

// Renders and measures a method that can be drawn.
std::pair<Image, Record> measure_method(const Stage& stage, MethodTools& tools, std::size_t index,
                                        const Reference& target, const MethodsWanted& wanted,
                                        const Progress& progress) {
  const StagedMethod& method = stage.methods()[index];
  Image image = tools.frames.render(index, target.place, target.view);
  std::optional<Image> finest;
  if (wanted.reference.by_cause) finest = finest_level(stage, method, target, wanted.reference, progress);
  stage.context().check("rendering " + method.text());
  Record record = measured(stage, tools, method, image, finest, target, wanted.exposure);
  return {std::move(image), std::move(record)};
}

// Renders and measures a method; one that fails leaves a record with the reason, and no image.
std::pair<Image, Record> measure_or_fail(const Stage& stage, MethodTools& tools, std::size_t index,
                                         const Reference& target, const MethodsWanted& wanted,
                                         const Progress& progress) {
  const StagedMethod& method = stage.methods()[index];
  std::pair<Image, Record> result;
  std::optional<Error> failure = method.refusal();
  if (!failure)
    failure = catch_failure(stage.context(), method.spec(),
                            [&] { result = measure_method(stage, tools, index, target, wanted, progress); });
  if (!failure) return result;
  if (target.place.kind == RunKind::animation) throw *failure;
  Record record = described(stage, method, target);
  record.failure = failure->what();
  return {Image{}, std::move(record)};
}

double largest_error_of(std::span<const Image> images, const Image& reference, float exposure) {
  double largest = 0;
  for (const Image& image : images) {
    if (!image.texels.empty()) largest = std::max(largest, error_percentile(error_map(image, reference, exposure)));
  }
  return largest;
}

std::vector<std::array<double, 2>> shares_by_material(const Image& verdicts, const Reference& target) {
  std::vector<std::array<double, 2>> shares;
  for (const Image& mask : target.materials)
    shares.push_back(closer_shares(verdicts, mask).value_or(std::array<double, 2>{}));
  return shares;
}

}  // namespace

MeasuredView measure_view(const Stage& stage, MethodTools& tools, const Reference& reference,
                          const MethodsWanted& wanted, const Progress& progress) {
  MeasuredView measured;
  const std::span<const StagedMethod> methods = stage.requested_methods();
  ProgressParts parts(progress, static_cast<double>(methods.size()));
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const std::string activity = fmt::format("{}: {}, finest level, ", reference.place.words(), methods[m].text());
    auto [image, record] = measure_or_fail(stage, tools, m, reference, wanted, parts.next(1.0, activity));
    measured.images.push_back(std::move(image));
    measured.records.push_back(std::move(record));
  }
  if (reference.place.kind != RunKind::animation)
    measured.largest_error = largest_error_of(measured.images, reference.reference.mean, wanted.exposure);
  return measured;
}

std::vector<Image> render_methods(const Stage& stage, MethodTools& tools, const Reference& reference) {
  std::vector<Image> images;
  for (std::size_t m = 0; m < stage.requested_methods().size(); ++m) {
    Image& image = images.emplace_back();
    const StagedMethod& method = stage.methods()[m];
    if (method.refusal()) continue;
    // A failure shows again where the method is measured.
    (void)catch_failure(stage.context(), method.spec(),
                        [&] { image = tools.frames.render(m, reference.place, reference.view); });
  }
  return images;
}

double methods_weight(std::size_t methods, const ReferenceSettings& settings) {
  return static_cast<double>(methods) * settings.spp;
}

std::vector<Record> noise_records(std::span<const std::string> methods, const Reference& reference) {
  Record record;
  record.distance = reference.place.at.distance;
  record.frame = static_cast<int>(reference.place.index);
  RecordError& error = record.error.emplace();
  error.noise_floor = reference.noise_floor;
  error.causes.shading_floor = reference.shading_floor;
  if (reference.shading_floor) error.causes.shading = 0.0;
  for (const OtherReferenceImage& other : reference.others)
    record.other_references.push_back({.spp = other.spp, .normalized_color = 0, .noise_floor = other.noise_floor});
  std::vector<Record> records(methods.size(), record);
  for (std::size_t m = 0; m < records.size(); ++m) records[m].method = methods[m];
  return records;
}

std::vector<MethodPair> compare_pairs(const MeasuredView& measured, const Reference& reference, float exposure,
                                      const VerdictWatch& watch) {
  const std::vector<Record>& records = measured.records;
  if (records.size() > most_methods_in_pairs || !reference.reference.halves) return {};
  std::vector<MethodPair> pairs;
  for (std::size_t i = 0; i < records.size(); ++i) {
    for (std::size_t j = i + 1; j < records.size(); ++j) {
      if (records[i].failure || records[j].failure) continue;
      const Image verdicts = closer_beyond_noise(measured.images[i], measured.images[j], reference.reference.mean,
                                                 reference.reference.standard_error, exposure);
      const auto shares = closer_shares(verdicts, reference.parts.interior);
      if (!shares) continue;
      pairs.push_back({.distance = reference.place.at.distance,
                       .methods = {records[i].method, records[j].method},
                       .closer = *shares,
                       .materials = shares_by_material(verdicts, reference),
                       .picture = watch(i, j, verdicts)});
    }
  }
  return pairs;
}

}  // namespace footprint
