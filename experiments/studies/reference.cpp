// From a reference's first samples to all that methods are compared with in one view.
#include "experiments/studies/reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <numeric>
#include <utility>

#include "experiments/studies/bound.hpp"
#include "experiments/studies/frame_times.hpp"
#include "experiments/studies/reference_noise.hpp"
#include "renderer/image/metrics.hpp"

namespace footprint {
namespace {

constexpr double least_noise = 1e-5;         // smallest automatic noise
constexpr double printed_difference = 1e-3;  // of an error, in three figures
constexpr double automatic_work = 1.0;       // samples beyond the first, in multiples of those
constexpr double automatic_samples = 16e6;   // the same, over all pixels: a second or two
constexpr double environment_share = 0.25;   // of that under an environment, whose samples take longer
constexpr double unbounded_work = 1e9;
constexpr double pixels_lit_by_all = 512;  // by each of some 6000 directional lights: about a second a method
constexpr double interior_weight = 16;     // of progress, in samples of the reference
constexpr int samples_of_finest = 16;

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// Without a requested noise: as many samples as the image has, and more if those are few.
double max_extra_work(int spp, const glm::ivec2& size, bool has_environment) {
  const double first = static_cast<double>(spp) * size.x * size.y;
  return (has_environment ? environment_share : 1.0) * std::max(automatic_work, automatic_samples / first);
}

// The smallest rectangle around the object.
Tile object_part(const Image& reference) {
  const Image pixels = object_pixels(reference);
  glm::ivec2 lower(pixels.width, pixels.height), upper(0);
  for (int y = 0; y < pixels.height; ++y) {
    for (int x = 0; x < pixels.width; ++x) {
      if (pixels.at(x, y)[0] <= 0.0F) continue;
      const glm::ivec2 pixel(x, pixels.height - 1 - y);  // tiles count rows from the bottom
      lower = glm::min(lower, pixel);
      upper = glm::max(upper, pixel + 1);
    }
  }
  return upper.x == 0 ? Tile{} : Tile{.origin = lower, .size = upper - lower};
}

// The edge of the squares that are lit by all of an environment, pixels.
constexpr int light_tile = 8;

LightPart light_part(const PixelParts& parts) {
  const std::vector<Tile> tiles = cheap_parts(
      parts, light_tile, [](int, int) { return 1.0; }, pixels_lit_by_all);
  return {.tiles = tiles, .pixels = within(parts.interior, tiles)};
}

// The noise floor that separates the methods: a fifth of the least difference between their errors that the table
// prints, or of the least error. Methods that agree to three figures are one to it.
double noise_that_separates(const Stage& stage, const Supersampled& reference, const View& view, float exposure) {
  Supersampled counted = reference;
  leave_out(counted, unresolved(counted, exposure));
  std::vector<double> errors;
  for (const StagedMethod& method : stage.requested_methods()) {
    if (method.refusal()) continue;
    const auto add = [&] {
      if (const auto error = normalized_color(method.frames().render(view), counted.mean, exposure))
        errors.push_back(*error);
    };
    (void)catch_failure(stage.context(), method.baked().spec,
                        add);  // it shows again, and is reported, where the method is measured
  }
  if (errors.empty()) return least_noise;
  std::ranges::sort(errors);
  double least = errors.front();
  for (std::size_t i = 1; i < errors.size(); ++i) {
    const double difference = errors[i] - errors[i - 1];
    if (difference > printed_difference * errors[i]) least = std::min(least, difference);
  }
  return std::max(least / 5.0, least_noise);
}

// The requested noise, or what the first comparison that shares the reference wanted.
double noise_wanted(const Stage& stage, const SharedReferences::OfView& begun, const View& view,
                    const ReferenceWanted& wanted, const SharedReferences& shared) {
  if (wanted.settings.noise) return *wanted.settings.noise;
  const auto known = shared.wanted_noise.find(begun.at);
  return known != shared.wanted_noise.end() ? known->second
                                            : noise_that_separates(stage, begun.reference, view, wanted.exposure);
}

// The mean over the samples of finest levels. Where samples draw directions from an environment or points of area
// lights, the reference's noise is its own: methods draw none, and a difference of the two would only add it.
Image samples_of_finest_levels(const Stage& stage, const View& view, const Image& whole,
                               const ReferenceSettings& settings, const Progress& progress) {
  if (has(stage.effects(), Effect::environment_light) && settings.environment == EnvironmentUse::sampled) return {};
  if (has(stage.effects(), Effect::area_light)) return {};
  const int spp = finest_samples(settings);
  if (spp == settings.spp || !settings.by_cause) return whole;
  return finest_mean(stage.reference(), view, settings, progress);
}

// Refines a reference to the requested noise, unless it was refined already.
void refine(const Stage& stage, SharedReferences::OfView& begun, const View& view, const ReferenceWanted& wanted,
            SharedReferences& shared, const Progress& progress) {
  if (begun.samples > 0) return;
  const ReferenceSettings& settings = wanted.settings;
  begun.samples = settings.spp;
  if (!settings.by_noise || settings.fixed_spp) return;
  const auto begin = std::chrono::steady_clock::now();
  const bool has_environment = has(stage.effects(), Effect::environment_light);
  const double noise = noise_wanted(stage, begun, view, wanted, shared);
  shared.wanted_noise[begun.at] = noise;
  const Convergence convergence{
      .noise = noise,
      .exposure = wanted.exposure,
      .spp_max = settings.spp_max,
      .max_extra_work = settings.noise ? unbounded_work : max_extra_work(settings.spp, view.size, has_environment)};
  begun.samples = converge(stage.reference(), begun.reference, view, settings.seed, convergence, progress);
  begun.seconds += seconds_since(begin);
}

// Uncovers the pixels that the reference does not resolve: no figure includes them. A warning has their number.
void leave_out_unresolved(Reference& target, float exposure) {
  target.whole = target.reference.mean;
  target.unresolved = unresolved(target.reference, exposure);
  leave_out(target.reference, target.unresolved);
  if (!target.first.texels.empty()) uncover(target.first, target.unresolved);
  const std::size_t whole = object_pixel_count(target.whole);
  const std::size_t left_out = whole - object_pixel_count(target.reference.mean);
  target.parts.counts.unresolved = left_out;
  if (left_out == 0) return;
  target.warnings.push_back(fmt::format(
      "{}: {:.2g}% of the object unresolved: in {} of {} pixels a few samples carry nearly all of the "
      "light; they are left out of every figure",
      target.place.words(), 100.0 * static_cast<double>(left_out) / static_cast<double>(whole), left_out, whole));
}

// Returns the interior pixels; finds them unless they are known.
const Interior& find_interior(const Stage& stage, const ReferenceTools& tools, const Reference& target,
                              const ReferenceSettings& settings, std::optional<Interior>& known,
                              const Progress& progress) {
  if (known) return *known;
  known = tools.interior.render(target.view, object_part(target.reference.mean), settings.spp, settings.seed, progress);
  stage.context().check("finding interior pixels");
  return *known;
}

// Sets the parts of the pixels.
void set_parts(Reference& target, const Stage& stage, const Interior& interior, const ReferenceWanted& wanted) {
  const std::size_t left_out = target.parts.counts.unresolved;
  target.parts = pixel_parts(target.reference.mean, interior);
  target.parts.counts.unresolved = left_out;
  if (wanted.by_material)
    target.materials = material_masks(interior.materials, target.parts.interior, stage.scene().materials.size());
  target.shading_floor = noise_floor(target.reference, wanted.exposure, target.parts.interior);
  if (!has(stage.effects(), Effect::environment_light)) return;
  target.light = light_part(target.parts);
  target.parts.counts.light = pixel_count(target.light.pixels);
}

void set_bound(Reference& target, const Stage& stage, const StagedMethod& bound, BoundUse use, const Image& texels,
               const Progress& progress) {
  progress("exact", 0.0);
  target.bound = draw_bound(stage, bound, use, target.view, target.parts, texels);
  target.parts.counts.bound = pixel_count(target.bound->pixels);
  stage.context().check("drawing the bound");
}

OtherReferenceImage other_reference(const Stage& stage, const Reference& target, int spp, const ReferenceWanted& wanted,
                                    const Progress& progress) {
  Supersampled other = stage.reference().render(target.view, spp, wanted.settings.seed, progress, TexelUse::drawn);
  leave_out(other, target.unresolved);
  return {.spp = spp, .mean = other.mean, .noise_floor = noise_floor(other, wanted.exposure)};
}

double sum_of(const std::vector<int>& counts) { return std::accumulate(counts.begin(), counts.end(), 0.0); }

// The first samples, and those of finest levels.
double weight_of_begun(const ReferenceSettings& settings) { return settings.spp + finest_samples(settings); }

}  // namespace

Image as_converged(const Image& picture, const Image& same, const Image& converged) {
  Image out = converged;
  for (std::size_t t = 0; t < out.texels.size(); t += 4) {
    if (picture.texels[t + 3] <= 0.0F || same.texels[t + 3] <= 0.0F) continue;
    for (std::size_t c = t; c < t + 3; ++c)
      out.texels[c] = std::max(converged.texels[c] + (picture.texels[c] - same.texels[c]), 0.0F);
  }
  return out;
}

int finest_samples(const ReferenceSettings& settings) {
  return settings.by_noise && !settings.fixed_spp ? std::min(settings.spp, samples_of_finest) : settings.spp;
}

Image finest_mean(const Supersampler& sampler, const View& view, const ReferenceSettings& settings,
                  const Progress& progress) {
  const int spp = finest_samples(settings);
  if (spp == settings.spp) return sampler.render(view, spp, settings.seed, progress).mean;
  return sampler.render_mean(view, spp, settings.seed, progress);
}

SharedReferences::OfView* SharedReferences::of(const RunView& at) {
  const auto known = std::ranges::find(views, at, &OfView::at);
  return known != views.end() ? &*known : nullptr;
}

ReferenceTools reference_tools(const Stage& stage, BoundUse bound) {
  ReferenceTools tools{.interior = stage.interior_finder(), .bound = {}, .warnings = {}};
  tools.bound = stage_bound(stage, bound, tools.warnings);
  return tools;
}

ReferenceWanted ReferenceWanted::for_flicker() const {
  ReferenceWanted less = *this;
  less.settings.supersampling.clear();
  less.settings.other_spp.clear();
  return less;
}

SharedReferences::OfView& begin_reference(Stage& stage, const PlannedView& place, const ReferenceSettings& settings,
                                          SharedReferences& shared, const Progress& progress) {
  if (SharedReferences::OfView* known = shared.of(place.at)) return *known;
  const View view = stage.move_to(place.at);
  ProgressParts parts(progress, weight_of_begun(settings));
  const std::string activity = place.words() + ": reference, ";
  const auto begin = std::chrono::steady_clock::now();
  SharedReferences::OfView begun;
  begun.at = place.at;
  begun.reference = stage.reference().render(view, settings.spp, settings.seed, parts.next(settings.spp, activity));
  begun.begun = begun.reference.mean;
  begun.first =
      samples_of_finest_levels(stage, view, begun.begun, settings, parts.next(finest_samples(settings), activity));
  begun.seconds = seconds_since(begin);
  return shared.views.emplace_back(std::move(begun));
}

Reference render_reference(Stage& stage, const ReferenceTools& tools, const PlannedView& place,
                           const ReferenceWanted& wanted, SharedReferences& shared, const Progress& progress) {
  const ReferenceSettings& settings = wanted.settings;
  const std::string prefix = place.words() + ": ";
  ProgressParts parts(progress, reference_weight(settings));
  SharedReferences::OfView& known =
      begin_reference(stage, place, settings, shared, parts.next(weight_of_begun(settings), ""));
  Reference target;
  target.place = place;
  target.view = stage.move_to(place.at);
  refine(stage, known, target.view, wanted, shared, parts.next(automatic_work * settings.spp, prefix + "reference, "));
  if (const auto noise = shared.wanted_noise.find(place.at); noise != shared.wanted_noise.end())
    target.wanted_noise = noise->second;
  static_cast<RenderedReference&>(target) = known;
  leave_out_unresolved(target, wanted.exposure);
  const Interior& interior =
      find_interior(stage, tools, target, settings, known.interior, parts.next(interior_weight, prefix));
  set_parts(target, stage, interior, wanted);
  const Progress of_bound = parts.next(interior_weight, prefix);
  if (tools.bound) set_bound(target, stage, *tools.bound, settings.bound, interior.texels, of_bound);
  target.noise_floor = noise_floor(target.reference, wanted.exposure);
  target.highlight_energy = highlight_energy(target.reference.mean, target.reference.mean, wanted.exposure);
  target.curve = measured_curve(stage, settings, target, wanted.exposure,
                                parts.next(curve_weight(settings.supersampling), prefix));
  for (const int spp : settings.other_spp)
    target.others.push_back(other_reference(stage, target, spp, wanted, parts.next(spp, prefix + "other reference, ")));
  return target;
}

double reference_weight(const ReferenceSettings& settings) {
  return weight_of_begun(settings) + automatic_work * settings.spp + sum_of(settings.other_spp) +
         curve_weight(settings.supersampling) + 2.0 * interior_weight;
}

}  // namespace footprint
