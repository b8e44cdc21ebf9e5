// From the reference's first samples to all that methods are held against at one distance.
#include "experiments/studies/truth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <numeric>
#include <utility>

#include "experiments/studies/converge.hpp"
#include "experiments/studies/measured_curve.hpp"
#include "experiments/studies/picture_files.hpp"
#include "experiments/studies/reference_noise.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/image/metrics.hpp"
#include "renderer/pipeline/unresolved.hpp"

namespace footprint {
namespace {

constexpr double least_noise = 1e-5;         // that is asked for unasked
constexpr double printed_difference = 1e-3;  // of an error, in three figures
constexpr double automatic_work = 1.0;       // samples beyond the first, in multiples of those
constexpr double automatic_samples = 16e6;   // likewise, of all pixels: a second or two
constexpr double surrounded_share = 0.25;  // of that under an environment: its samples draw directions, and take longer
constexpr double unbounded_work = 1e9;
constexpr double pixels_lit_by_all = 512;  // by each of some 6000 directional lights: about a second a method
constexpr double interior_weight = 16;     // of progress, in samples of the reference
constexpr int samples_of_finest = 16;

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// Unasked: as many samples as the picture has, and more where that is little.
double most_work(int spp, const glm::ivec2& size, bool surrounded) {
  const double first = static_cast<double>(spp) * size.x * size.y;
  return (surrounded ? surrounded_share : 1.0) * std::max(automatic_work, automatic_samples / first);
}

// The least rectangle that holds the object.
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

LightPart light_part(const PixelParts& parts) {
  const std::vector<Tile> tiles = cheap_parts(
      parts, light_tile, [](int, int) { return 1.0; }, pixels_lit_by_all);
  return {.tiles = tiles, .pixels = within(parts.interior, tiles)};
}

}  // namespace

int finest_samples(const ReferenceSettings& settings) {
  return settings.by_noise && !settings.fixed_spp ? std::min(settings.spp, samples_of_finest) : settings.spp;
}

Image finest_mean(const Supersampler& sampler, const View& view, const ReferenceSettings& settings,
                  const Progress& progress) {
  const int spp = finest_samples(settings);
  if (spp == settings.spp) return sampler.render(view, spp, settings.seed, progress).mean;
  return sampler.render_mean(view, spp, settings.seed, progress);
}

SharedTruth::AtDistance* SharedTruth::at(double distance) {
  const auto known = std::ranges::find(distances, distance, &AtDistance::distance);
  return known != distances.end() ? &*known : nullptr;
}

TruthFinder::TruthFinder(const RunSettings& settings, const Stage& stage, std::filesystem::path folder,
                         std::function<float(const Image& first_reference)> exposure, ProgressParts& progress,
                         SharedTruth* shared)
    : settings_(settings),
      stage_(stage),
      folder_(std::move(folder)),
      choose_exposure_(std::move(exposure)),
      progress_(progress),
      interior_finder_(stage.interior_finder()),
      bound_(stage_bound(stage, settings.reference.bound, warnings_)),
      shared_(shared) {
  if (settings.by_material)
    material_finder_.emplace(stage.context().info(), stage.scene(), stage.view(1.0).size, settings.backend.tile);
}

double TruthFinder::weight(const RunSettings& settings) {
  const ReferenceSettings& reference = settings.reference;
  const double others = std::accumulate(reference.other_spp.begin(), reference.other_spp.end(), 0.0);
  return (1.0 + automatic_work) * reference.spp + finest_samples(reference) + others +
         curve_weight(reference.supersampling) + 2.0 * interior_weight;
}

Truth TruthFinder::find(std::size_t frame, double distance) {
  const std::string prefix = fmt::format("distance {:g}: ", distance);
  Truth truth;
  truth.frame = frame;
  truth.distance = distance;
  truth.view = stage_.view(distance);
  render_reference(truth, prefix);
  write_reference(truth);
  leave_out_unresolved(truth);
  truth.noise_floor = noise_floor(truth.reference, exposure_);
  find_parts(truth, prefix);
  truth.curve = measured_curve(
      stage_, settings_.reference, distance,
      {.reference = truth.reference.mean, .interior = truth.parts.interior, .exposure = exposure_}, progress_);
  for (const int spp : settings_.reference.other_spp) truth.others.push_back(other_truth(truth, spp, prefix));
  return truth;
}

void TruthFinder::set_exposure(float exposure) {
  known_exposure_ = exposure;
  exposure_ = exposure;
}

void TruthFinder::choose_exposure(double first_distance) {
  const ReferenceSettings& asked = settings_.reference;
  set_exposure(
      choose_exposure_(stage_.reference()
                           .render(stage_.view(first_distance), asked.spp, asked.seed, progress_.next(0, "exposure, "))
                           .mean));
}

void TruthFinder::render_reference(Truth& truth, const std::string& prefix) {
  SharedTruth own;
  SharedTruth::AtDistance& known = begun_reference(shared_ != nullptr ? *shared_ : own, truth, prefix);
  if (!known_exposure_ && truth.frame == 0) set_exposure(choose_exposure_(known.begun));
  refine_reference(known, truth.view, progress_.next(automatic_work * settings_.reference.spp, prefix + "reference, "));
  truth.reference = known.reference;
  truth.first = known.first;
  truth.samples = known.samples;
  truth.seconds = known.seconds;
}

// What does not depend on the methods: rendered, or taken from what is shared.
SharedTruth::AtDistance& TruthFinder::begun_reference(SharedTruth& shared, const Truth& truth,
                                                      const std::string& prefix) {
  const ReferenceSettings& asked = settings_.reference;
  const Progress reference = progress_.next(asked.spp, prefix + "reference, ");
  const Progress finest = progress_.next(finest_samples(asked), prefix + "reference, ");
  if (SharedTruth::AtDistance* known = shared.at(truth.distance)) return *known;
  const auto begin = std::chrono::steady_clock::now();
  SharedTruth::AtDistance begun;
  begun.distance = truth.distance;
  begun.reference = stage_.reference().render(truth.view, asked.spp, asked.seed, reference);
  begun.begun = begun.reference.mean;
  begun.first = samples_of_finest_levels(truth, begun.begun, finest);
  begun.seconds = seconds_since(begin);
  return shared.distances.emplace_back(std::move(begun));
}

// The reference over the samples of finest levels. Where its samples draw directions from an environment, their noise
// is its own: methods look the environment up, and a difference of the two would only add it.
Image TruthFinder::samples_of_finest_levels(const Truth& truth, const Image& whole, const Progress& progress) {
  const ReferenceSettings& asked = settings_.reference;
  if (has(stage_.effects(), Effect::environment_light) && asked.environment == EnvironmentUse::sampled) return {};
  const int spp = finest_samples(asked);
  if (spp == asked.spp || !asked.by_cause) return whole;
  return finest_mean(stage_.reference(), truth.view, asked, progress);
}

// Goes on with the reference until its noise is what was asked for, where nobody has.
void TruthFinder::refine_reference(SharedTruth::AtDistance& begun, const View& view, const Progress& progress) {
  if (begun.samples > 0) return;
  const ReferenceSettings& asked = settings_.reference;
  begun.samples = asked.spp;
  if (!asked.by_noise || asked.fixed_spp) return;
  const auto begin = std::chrono::steady_clock::now();
  const bool surrounded = has(stage_.effects(), Effect::environment_light);
  const Convergence wanted{.noise = asked.noise ? *asked.noise : noise_that_tells_apart(begun.reference, view),
                           .exposure = exposure_,
                           .spp_max = asked.spp_max,
                           .most_work = asked.noise ? unbounded_work : most_work(asked.spp, view.size, surrounded)};
  begun.samples = converge(stage_.reference(), begun.reference, view, asked.seed, wanted, progress);
  begun.seconds += seconds_since(begin);
}

// A fifth of the least difference between the methods' errors that the table prints, or of the least error. Methods
// that agree to three figures are one to it.
double TruthFinder::noise_that_tells_apart(const Supersampled& reference, const View& view) const {
  Supersampled counted = reference;
  leave_out(counted, unresolved(counted, exposure_));
  std::vector<double> errors;
  for (const StagedMethod& method : std::span(stage_.methods()).first(settings_.methods.size())) {
    if (method.refusal()) continue;
    const auto add = [&] {
      if (const auto error = normalized_color(method.frames().render(view), counted.mean, exposure_))
        errors.push_back(*error);
    };
    (void)failure_of(stage_.context(), method.baked().spec,
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

void TruthFinder::write_reference(Truth& truth) const {
  const std::string stem = distance_stem(truth.distance, "reference");
  truth.files.reference = write_exposable_picture(folder_, stem, truth.reference.mean, exposure_);
  truth.files.standard_error = fmt::format("images/{}_standard_error.exr", stem);
  write_exr(folder_ / truth.files.standard_error, truth.reference.standard_error);
}

// Every figure is over the pixels that are covered; what is left out stands in the warnings.
void TruthFinder::leave_out_unresolved(Truth& truth) const {
  truth.whole = truth.reference.mean;
  truth.unresolved = unresolved(truth.reference, exposure_);
  leave_out(truth.reference, truth.unresolved);
  if (!truth.first.texels.empty()) uncover(truth.first, truth.unresolved);
  const std::size_t whole = object_pixel_count(truth.whole);
  const std::size_t left_out = whole - object_pixel_count(truth.reference.mean);
  truth.parts.counts.unresolved = left_out;
  if (left_out == 0) return;
  truth.warnings.push_back(fmt::format(
      "distance {:g}: {:.2g}% of the object unresolved: in {} of {} pixels a few samples carry nearly all of the "
      "light; they are left out of every figure",
      truth.distance, 100.0 * static_cast<double>(left_out) / static_cast<double>(whole), left_out, whole));
}

// The pixels that are interior, and the bound over them.
void TruthFinder::find_parts(Truth& truth, const std::string& prefix) {
  const Interior interior = interior_of(truth, progress_.next(interior_weight, prefix));
  const std::size_t left_out = truth.parts.counts.unresolved;
  truth.parts = pixel_parts(truth.reference.mean, interior);
  truth.parts.counts.unresolved = left_out;
  if (material_finder_) truth.materials = material_finder_->masks(truth.view, truth.parts.interior);
  truth.shading_floor = noise_floor_over(truth.reference, exposure_, truth.parts.interior);
  truth.files.interior = write_mask(folder_, distance_stem(truth.distance, "interior"), truth.parts.interior);
  if (has(stage_.effects(), Effect::environment_light)) {
    truth.light = light_part(truth.parts);
    truth.parts.counts.light = pixel_count(truth.light.pixels);
  }
  const Progress progress = progress_.next(interior_weight, prefix);
  if (!bound_) return;
  progress("exact", 0.0);
  truth.bound = draw_bound(stage_, *bound_, settings_.reference.bound, truth.view, truth.parts, interior.texels);
  truth.parts.counts.bound = pixel_count(truth.bound->pixels);
  stage_.context().check("drawing the bound");
}

// As they are shared, or found and shared.
Interior TruthFinder::interior_of(const Truth& truth, const Progress& progress) const {
  SharedTruth::AtDistance* known = shared_ != nullptr ? shared_->at(truth.distance) : nullptr;
  if (known != nullptr && known->interior) return *known->interior;
  Interior interior = interior_finder_.render(truth.view, object_part(truth.reference.mean), settings_.reference.spp,
                                              settings_.reference.seed, progress);
  stage_.context().check("finding interior pixels");
  if (known != nullptr) known->interior = interior;
  return interior;
}

OtherTruth TruthFinder::other_truth(const Truth& truth, int spp, const std::string& prefix) {
  Supersampled other = stage_.reference().render(truth.view, spp, settings_.reference.seed,
                                                 progress_.next(spp, prefix + "other reference, "), TexelUse::drawn);
  leave_out(other, truth.unresolved);
  return {.spp = spp, .mean = other.mean, .noise_floor = noise_floor(other, exposure_)};
}

}  // namespace footprint
