// From the reference's first samples to all that methods are compared with in one view: masks of pixels, errors over
// them, and the share of an image over which `exact` is cheap enough to be rendered by default.
#include "experiments/studies/reference_view.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <numeric>

#include "experiments/settings/setting.hpp"
#include "experiments/studies/frame_times.hpp"
#include "experiments/studies/picture_files.hpp"
#include "experiments/studies/view_path.hpp"
#include "methods/registry.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/image/metrics.hpp"

namespace footprint {
namespace {

constexpr double most_facets_per_level = 128.0 * 128.0;
// Under an environment, measured on golden_armor and armor_sky: a GGX lobe's nodes are looked up one by one.
constexpr double most_surrounded_per_level = 1428.0, surrounded_facet = 50.0;

// Tiles have row 0 at the bottom, pictures at the top.
template <typename Visit>  // visit(column, row of the picture)
void visit_pixels(const Tile& tile, int height, Visit visit) {
  for (int y = tile.origin.y; y < tile.origin.y + tile.size.y; ++y) {
    for (int x = tile.origin.x; x < tile.origin.x + tile.size.x; ++x) visit(x, height - 1 - y);
  }
}

constexpr std::string_view bound_name = "exact";
constexpr double cheap_facets = 1.5e7;  // shaded for all lights, of one distance: about a second on a CPU's two cores

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

LightPart light_part(const PixelParts& parts) {
  const std::vector<Tile> tiles = cheap_parts(
      parts, light_tile, [](int, int) { return 1.0; }, pixels_lit_by_all);
  return {.tiles = tiles, .pixels = within(parts.interior, tiles)};
}

constexpr double halves_over_whole = 2.0;  // A - B has twice the deviation of the reference's own error

constexpr int tile_edge = 128;  // each draw of a tile goes through all vertices
constexpr int samples_factor = 4;

// The sum over a tile's object pixels of half the error between the halves, over their number.
double noise_of(const Image& error, const Image& counted, const Tile& tile) {
  double sum = 0, count = 0;
  visit_pixels(tile, error.height, [&](int x, int y) {
    sum += error.at(x, y)[0] / 2.0;
    count += counted.at(x, y)[3] >= 1.0F ? 1.0 : 0.0;
  });
  return count > 0.0 ? sum / count : 0.0;
}

double pixels_of(const Tile& tile) { return static_cast<double>(tile.size.x) * tile.size.y; }

// Those of `tiles` whose noise is above `noise`, the noisiest first.
std::vector<Tile> noisy(const Supersampled& picture, std::span<const Tile> tiles, const Convergence& wanted) {
  Supersampled counted = picture;
  leave_out(counted, unresolved(picture, wanted.exposure));
  const Image error = error_map(counted.halves->first, counted.halves->second, wanted.exposure);
  std::vector<std::pair<double, Tile>> found;
  for (const Tile& tile : tiles) {
    const double noise = noise_of(error, counted.mean, tile);
    if (noise > wanted.noise) found.emplace_back(noise, tile);
  }
  std::ranges::stable_sort(found, std::greater<>(), [](const auto& entry) { return entry.first; });
  std::vector<Tile> out;
  out.reserve(found.size());
  for (const auto& entry : found) out.push_back(entry.second);
  return out;
}

}  // namespace

PixelParts pixel_parts(const Image& reference, const Interior& interior) {
  const Image object = object_pixels(reference);
  PixelParts parts{.interior = object, .edges = object};
  for (std::size_t i = 0; i < object.texels.size(); ++i) {
    (interior.mask.texels[i] > 0.0F ? parts.edges : parts.interior).texels[i] = 0.0F;
    if (parts.interior.texels[i] > 0.0F && interior.texels.texels[i] > 1.0F) ++parts.counts.minified;
  }
  parts.counts.object = pixel_count(object);
  parts.counts.interior = pixel_count(parts.interior);
  return parts;
}

ErrorCauses error_causes(const Image& picture, const Image& reference, const BoundPicture* bound,
                         const PixelParts& parts, float exposure) {
  ErrorCauses causes;
  causes.shading = normalized_color(picture, reference, exposure, parts.interior);
  causes.edges = normalized_color(picture, reference, exposure, parts.edges);
  if (bound == nullptr) return causes;
  causes.filter = normalized_color(bound->picture, reference, exposure, bound->pixels);
  causes.method = error_between(picture, bound->picture, reference, exposure, bound->pixels);
  return causes;
}

Image as_reference(Image picture, const Image& reference) {
  for (std::size_t i = 3; i < picture.texels.size(); i += 4) picture.texels[i] = reference.texels[i];
  return picture;
}

std::optional<double> error_between(const Image& picture, const Image& other, const Image& reference, float exposure,
                                    const Image& mask) {
  return normalized_color(picture, as_reference(other, reference), exposure, mask);
}

std::optional<double> error_noise(const Image& picture, const std::pair<Image, Image>& halves, float exposure,
                                  const Image& mask) {
  const Image first = error_map(picture, halves.first, exposure), second = error_map(picture, halves.second, exposure);
  double squares = 0;
  std::size_t pixels = 0;
  for (std::size_t i = 0; i < mask.texels.size(); ++i) {
    if (mask.texels[i] <= 0.0F) continue;
    squares += std::pow(0.5 * (static_cast<double>(first.texels[i]) - second.texels[i]), 2);
    ++pixels;
  }
  return pixels > 0 ? std::optional(std::sqrt(squares) / static_cast<double>(pixels)) : std::nullopt;
}

double estimated_exact_cost(double texels, const BoundLights& lights) {
  const double level = std::floor(std::log2(std::max(texels, 1.0)));
  const auto facets = [&](double most) {
    return std::min(std::pow(4.0, level + 1.0), most) + std::min(std::pow(4.0, level + 2.0), most);
  };
  const double surrounded = lights.environment ? surrounded_facet * facets(most_surrounded_per_level) : 0.0;
  return static_cast<double>(lights.lights) * facets(most_facets_per_level) + surrounded;
}

double cost_of(const Tile& tile, const PixelParts& parts, const PixelCost& cost) {
  double sum = 0;
  visit_pixels(tile, parts.interior.height, [&](int x, int y) {
    if (parts.interior.at(x, y)[0] + parts.edges.at(x, y)[0] > 0.0F) sum += cost(x, y);
  });
  return sum;
}

std::vector<Tile> cheap_parts(const PixelParts& parts, int edge, const PixelCost& cost, double most) {
  const std::vector<Tile> tiles = tiles_of({parts.interior.width, parts.interior.height}, edge);
  std::vector<std::size_t> order(tiles.size());
  std::iota(order.begin(), order.end(), 0U);
  // Multiples of the golden ratio fill the unit interval evenly (Weyl's sequence): each tile's turn.
  const auto turn = [](std::size_t i) { return std::fmod(static_cast<double>(i) * std::numbers::phi, 1.0); };
  std::ranges::stable_sort(order, {}, turn);
  std::vector<Tile> chosen;
  for (const std::size_t i : order) {
    const double price = cost_of(tiles[i], parts, cost);
    if (price == 0.0) continue;
    if (price > most) break;
    most -= price;
    chosen.push_back(tiles[i]);
  }
  return chosen;
}

void leave_out_infinite(const Image& picture, Image& mask) {
  for (std::size_t i = 0; i < mask.texels.size(); ++i) {
    const std::span<const float> texel = std::span(picture.texels).subspan(4 * i, 4);
    if (!std::ranges::all_of(texel, [](float value) { return std::isfinite(value); })) mask.texels[i] = 0.0F;
  }
}

Image within(const Image& mask, std::span<const Tile> tiles) {
  Image inside(mask.width, mask.height, 1);
  for (const Tile& tile : tiles)
    visit_pixels(tile, mask.height, [&](int x, int y) { inside.at(x, y)[0] = mask.at(x, y)[0]; });
  return inside;
}

namespace {

// `exact` over a stage, where this build has it, `use` wants it and it knows every effect of the scene; none otherwise,
// and the last reason is added to `warnings`.
std::optional<StagedMethod> stage_bound(const Stage& stage, BoundUse use, std::vector<std::string>& warnings) {
  if (use == BoundUse::off) return {};
  const auto all = all_methods();
  const auto found = std::ranges::find(all, bound_name, [](const Method* m) { return m->info.name; });
  if (found == all.end()) return {};
  const EffectSet left_out = stage.effects() & ~(*found)->info.honours;
  if (left_out.any()) {
    warnings.push_back(
        fmt::format("no bound is drawn: {} leaves out {}", bound_name, fmt::join(effect_names(left_out), ", ")));
    return {};
  }
  return stage.stage(parse_methods(std::string(bound_name)).front(), no_progress);
}

// Whole if requested or cheap, else in squares. texels: those of Interior.
BoundPicture draw_bound(const Stage& stage, const StagedMethod& bound, BoundUse use, const View& view,
                        const PixelParts& parts, const Image& texels) {
  const BoundLights lights{.lights = stage.scene().lights.size(), .environment = stage.scene().environment.has_value()};
  const PixelCost facets = [&](int x, int y) { return estimated_exact_cost(texels.at(x, y)[0], lights); };
  const std::vector<Tile> whole{{.origin = {0, 0}, .size = view.size}};
  const bool all = use == BoundUse::on || cost_of(whole.front(), parts, facets) <= cheap_facets;
  const std::vector<Tile> tiles = all ? whole : cheap_parts(parts, bound_tile, facets, cheap_facets);
  const FrameRenderer& frames = bound.frames();
  BoundPicture out{.picture = all ? frames.render(view) : frames.render(view, tiles),
                   .pixels = within(parts.interior, tiles)};
  leave_out_infinite(out.picture, out.pixels);  // of more texels and lights than it sums
  return out;
}

}  // namespace

std::optional<double> noise_floor(const Supersampled& reference, float exposure, const Image& mask) {
  if (!reference.halves) return std::nullopt;
  const auto difference = normalized_color(reference.halves->first, reference.halves->second, exposure, mask);
  if (!difference) return std::nullopt;
  return *difference / halves_over_whole;
}

std::optional<Flicker> flicker_between(const Image& before, const Image& picture, const Supersampled& reference_before,
                                       const Supersampled& reference, float exposure) {
  const auto figures = compare_changes(before, picture, reference_before.mean, reference.mean, exposure);
  if (!figures) return std::nullopt;
  Flicker flicker{.mean = figures->mean, .p99 = figures->p99};
  flicker.ghosting = normalized_color(picture, reference.mean, exposure,
                                      trailing_edges(reference_before.mean, reference.mean, exposure));
  if (!reference_before.halves || !reference.halves) return flicker;
  const auto& [old_even, old_odd] = *reference_before.halves;
  const auto& [even, odd] = *reference.halves;
  if (const auto noise = compare_changes(old_even, even, old_odd, odd, exposure)) {
    flicker.noise_floor = noise->mean / halves_over_whole;
  }
  return flicker;
}

Image as_converged(const Image& picture, const Image& same, const Image& converged) {
  Image out = converged;
  for (std::size_t t = 0; t < out.texels.size(); t += 4) {
    if (picture.texels[t + 3] <= 0.0F || same.texels[t + 3] <= 0.0F) continue;
    for (std::size_t c = t; c < t + 3; ++c)
      out.texels[c] = std::max(converged.texels[c] + (picture.texels[c] - same.texels[c]), 0.0F);
  }
  return out;
}

double converge(const Supersampler& sampler, Supersampled& picture, const View& view, std::uint64_t seed,
                const Convergence& wanted, const Progress& progress) {
  const double pixels = static_cast<double>(view.size.x) * view.size.y;
  double work = wanted.max_extra_work * picture.spp * pixels;
  double samples = picture.spp * pixels;
  std::vector<Tile> tiles = tiles_of(view.size, tile_edge);
  int before = picture.spp;
  while (picture.halves && before < wanted.spp_max) {
    const int spp = std::min(before * samples_factor, wanted.spp_max);
    tiles = noisy(picture, tiles, wanted);
    std::vector<Tile> taken;
    for (const Tile& tile : tiles) {
      const double cost = spp * pixels_of(tile);
      if (cost > work) break;
      work -= cost;
      samples += (spp - before) * pixels_of(tile);
      taken.push_back(tile);
    }
    if (taken.empty()) break;
    sampler.refine(picture, view, taken, spp, seed, progress);
    tiles = std::move(taken);
    before = spp;
  }
  progress("reference", 1.0);
  return samples / pixels;
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

ReferenceRenderer::ReferenceRenderer(const RunSettings& settings, Stage& stage, RunFolder folder,
                                     ProgressParts& progress, SharedReferences* shared)
    : settings_(settings),
      stage_(stage),
      folder_(std::move(folder)),
      progress_(progress),
      interior_finder_(stage.interior_finder()),
      bound_(stage_bound(
          stage, count_histories(settings) == settings.methods.size() ? BoundUse::off : settings.reference.bound,
          warnings_)),
      shared_(shared != nullptr ? shared : &own_) {}

double ReferenceRenderer::weight(const RunSettings& settings) {
  const ReferenceSettings& reference = settings.reference;
  const double others = std::accumulate(reference.other_spp.begin(), reference.other_spp.end(), 0.0);
  return (1.0 + automatic_work) * reference.spp + finest_samples(reference) + others +
         curve_weight(reference.supersampling) + 2.0 * interior_weight;
}

const Image& ReferenceRenderer::first_samples(const RunView& first) {
  return begun_reference(first, stage_.move_to(first), prefix_of(0, first)).begun;
}

std::string ReferenceRenderer::prefix_of(std::size_t index, const RunView& at) const {
  return view_words(settings_, index, at) + ": ";
}

ReferenceView ReferenceRenderer::render(std::size_t index, const RunView& at, float exposure) {
  const std::string prefix = prefix_of(index, at);
  exposure_ = exposure;
  ReferenceView target;
  target.index = index;
  target.at = at;
  target.view = stage_.move_to(at);
  SharedReferences::OfView& known = begun_reference(at, target.view, prefix);
  refine_reference(known, target.view,
                   progress_.next(automatic_work * settings_.reference.spp, prefix + "reference, "));
  if (const auto noise = shared_->wanted_noise.find(at); noise != shared_->wanted_noise.end())
    target.wanted_noise = noise->second;
  static_cast<RenderedReference&>(target) = known;
  leave_out_unresolved(target);
  find_parts(target);
  return target;
}

ReferenceView ReferenceRenderer::find(std::size_t index, const RunView& at, float exposure) {
  const std::string prefix = prefix_of(index, at);
  ReferenceView target = render(index, at, exposure);
  write_files(target);
  target.noise_floor = noise_floor(target.reference, exposure_);
  target.highlight_energy = highlight_energy(target.reference.mean, target.reference.mean, exposure_);
  target.curve = measured_curve(stage_, settings_.reference, target, exposure_, progress_);
  for (const int spp : settings_.reference.other_spp) target.others.push_back(other_reference(target, spp, prefix));
  own_ = {};
  return target;
}

// Renders the first samples, which do not depend on the methods, unless they are known.
SharedReferences::OfView& ReferenceRenderer::begun_reference(const RunView& at, const View& view,
                                                             const std::string& prefix) {
  const ReferenceSettings& settings = settings_.reference;
  if (SharedReferences::OfView* known = shared_->of(at)) return *known;
  const Progress reference = progress_.next(settings.spp, prefix + "reference, ");
  const Progress finest = progress_.next(finest_samples(settings), prefix + "reference, ");
  const auto begin = std::chrono::steady_clock::now();
  SharedReferences::OfView begun;
  begun.at = at;
  begun.reference = stage_.reference().render(view, settings.spp, settings.seed, reference);
  begun.begun = begun.reference.mean;
  begun.first = samples_of_finest_levels(view, begun.begun, finest);
  begun.seconds = seconds_since(begin);
  return shared_->views.emplace_back(std::move(begun));
}

// The reference over the samples of finest levels. Where its samples draw directions from an environment or points of
// area lights, their noise is its own: methods draw none, and a difference of the two would only add it.
Image ReferenceRenderer::samples_of_finest_levels(const View& view, const Image& whole, const Progress& progress) {
  const ReferenceSettings& settings = settings_.reference;
  if (has(stage_.effects(), Effect::environment_light) && settings.environment == EnvironmentUse::sampled) return {};
  if (has(stage_.effects(), Effect::area_light)) return {};
  const int spp = finest_samples(settings);
  if (spp == settings.spp || !settings.by_cause) return whole;
  return finest_mean(stage_.reference(), view, settings, progress);
}

// Refines the reference to the requested noise, unless it was refined already.
void ReferenceRenderer::refine_reference(SharedReferences::OfView& begun, const View& view, const Progress& progress) {
  if (begun.samples > 0) return;
  const ReferenceSettings& settings = settings_.reference;
  begun.samples = settings.spp;
  if (!settings.by_noise || settings.fixed_spp) return;
  const auto begin = std::chrono::steady_clock::now();
  const bool has_environment = has(stage_.effects(), Effect::environment_light);
  const double noise = noise_wanted(begun, view);
  shared_->wanted_noise[begun.at] = noise;
  const Convergence wanted{
      .noise = noise,
      .exposure = exposure_,
      .spp_max = settings.spp_max,
      .max_extra_work = settings.noise ? unbounded_work : max_extra_work(settings.spp, view.size, has_environment)};
  begun.samples = converge(stage_.reference(), begun.reference, view, settings.seed, wanted, progress);
  begun.seconds += seconds_since(begin);
}

// As requested, or as the first comparison that shares the reference wanted it.
double ReferenceRenderer::noise_wanted(const SharedReferences::OfView& begun, const View& view) {
  if (settings_.reference.noise) return *settings_.reference.noise;
  const auto known = shared_->wanted_noise.find(begun.at);
  return known != shared_->wanted_noise.end() ? known->second : noise_that_separates(begun.reference, view);
}

// A fifth of the least difference between the methods' errors that the table prints, or of the least error. Methods
// that agree to three figures are one to it.
double ReferenceRenderer::noise_that_separates(const Supersampled& reference, const View& view) const {
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

// An animation has no images but those of its frames.
void ReferenceRenderer::write_files(ReferenceView& target) const {
  const auto stem_of = [&](const char* what) { return view_stem(settings_, target.index, target.at, what); };
  const std::string stem = stem_of("reference");
  target.files.reference = write_page_picture(folder_, stem, target.whole, exposure_, target.unresolved);
  if (is_animation(settings_)) return;
  target.files.interior = write_mask(folder_, stem_of("interior"), target.parts.interior);
  target.files.standard_error = fmt::format("images/{}_standard_error.exr", stem);
  folder_.attempt(target.files.standard_error,
                  [&] { write_exr(folder_ / target.files.standard_error, target.reference.standard_error); });
}

// Every figure is over the pixels that are covered; the warnings say how many are left out.
void ReferenceRenderer::leave_out_unresolved(ReferenceView& target) const {
  target.whole = target.reference.mean;
  target.unresolved = unresolved(target.reference, exposure_);
  leave_out(target.reference, target.unresolved);
  if (!target.first.texels.empty()) uncover(target.first, target.unresolved);
  const std::size_t whole = object_pixel_count(target.whole);
  const std::size_t left_out = whole - object_pixel_count(target.reference.mean);
  target.parts.counts.unresolved = left_out;
  if (left_out == 0) return;
  target.warnings.push_back(
      fmt::format("{}: {:.2g}% of the object unresolved: in {} of {} pixels a few samples carry nearly all of the "
                  "light; they are left out of every figure",
                  view_words(settings_, target.index, target.at),
                  100.0 * static_cast<double>(left_out) / static_cast<double>(whole), left_out, whole));
}

// The pixels that are interior, and the bound over them.
void ReferenceRenderer::find_parts(ReferenceView& target) {
  const std::string prefix = prefix_of(target.index, target.at);
  const Interior interior = interior_of(target, progress_.next(interior_weight, prefix));
  const std::size_t left_out = target.parts.counts.unresolved;
  target.parts = pixel_parts(target.reference.mean, interior);
  target.parts.counts.unresolved = left_out;
  if (settings_.by_material)
    target.materials = material_masks(interior.materials, target.parts.interior, stage_.scene().materials.size());
  target.shading_floor = noise_floor(target.reference, exposure_, target.parts.interior);
  if (has(stage_.effects(), Effect::environment_light)) {
    target.light = light_part(target.parts);
    target.parts.counts.light = pixel_count(target.light.pixels);
  }
  const Progress progress = progress_.next(interior_weight, prefix);
  if (!bound_) return;
  progress("exact", 0.0);
  target.bound = draw_bound(stage_, *bound_, settings_.reference.bound, target.view, target.parts, interior.texels);
  target.parts.counts.bound = pixel_count(target.bound->pixels);
  stage_.context().check("drawing the bound");
}

// As they are shared, or found and shared.
Interior ReferenceRenderer::interior_of(const ReferenceView& target, const Progress& progress) const {
  SharedReferences::OfView& known = *shared_->of(target.at);
  if (known.interior) return *known.interior;
  Interior interior = interior_finder_.render(target.view, object_part(target.reference.mean), settings_.reference.spp,
                                              settings_.reference.seed, progress);
  stage_.context().check("finding interior pixels");
  known.interior = interior;
  return interior;
}

OtherReferenceImage ReferenceRenderer::other_reference(const ReferenceView& target, int spp,
                                                       const std::string& prefix) {
  Supersampled other = stage_.reference().render(target.view, spp, settings_.reference.seed,
                                                 progress_.next(spp, prefix + "other reference, "), TexelUse::drawn);
  leave_out(other, target.unresolved);
  return {.spp = spp, .mean = other.mean, .noise_floor = noise_floor(other, exposure_)};
}

}  // namespace footprint
