// One comparison from its stage to its records: each distance in turn, then what all of them share.
#include "experiments/studies/compare.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "experiments/studies/converge.hpp"
#include "experiments/studies/error_causes.hpp"
#include "experiments/studies/exposure.hpp"
#include "experiments/studies/picture_files.hpp"
#include "experiments/studies/plain_supersampling.hpp"
#include "experiments/studies/reference_noise.hpp"
#include "experiments/studies/run_info.hpp"
#include "experiments/studies/stage.hpp"
#include "experiments/studies/zoom.hpp"
#include "methods/registry.hpp"
#include "renderer/core/error.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/image/metrics.hpp"
#include "renderer/pipeline/pixel_work.hpp"
#include "renderer/pipeline/timing.hpp"
#include "renderer/pipeline/unresolved.hpp"
#include "renderer/scene/assembly/load_scene.hpp"
#include "results/report/equivalent_spp.hpp"

namespace footprint {
namespace {

constexpr double scale_quantile = 0.99;
constexpr double least_noise = 1e-5;         // that is asked for unasked
constexpr double printed_difference = 1e-3;  // of an error, in three figures
constexpr double automatic_work = 1.0;       // samples beyond the first, in multiples of those
constexpr double automatic_samples = 16e6;   // likewise, of all pixels: a second or two
constexpr double unbounded_work = 1e9;
constexpr double smallest_error_scale = 0.01;
constexpr std::uint64_t curve_seed = 0x9e3779b97f4a7c15;  // keeps the curve's samples apart from the reference's

constexpr std::string_view bound_name = "exact";
constexpr double cheap_facets = 1.5e7;  // shaded for all lights, of one distance: about a second on a CPU's two cores
constexpr double pixels_lit_by_all = 512;  // by each of some 6000 directional lights: about a second a method
constexpr double interior_weight = 16;     // of progress, in samples of the reference

// `direct` is what every ratio is taken to: it is staged first, also where it is not asked for, and looks its maps up
// by one trilinear lookup whatever the footprint filter, so that ratios of several filters compare.
constexpr FootprintFilter filter_of_the_unit{FootprintFilterKind::trilinear, 1};

RunSettings with_direct(RunSettings settings) {
  settings.methods.insert(settings.methods.begin(), {.text = "direct", .name = "direct", .options = {}});
  return settings;
}

// Kept of each distance until the end: the reference, and of each method the picture and its error (a quarter as
// large). Beside them what is worked on: most of all the strips of one distance, made of all its pictures in 5 steps.
int pictures_held(std::size_t methods, std::size_t distances) {
  const double kept = static_cast<double>(distances) * (1.0 + 1.25 * static_cast<double>(methods));
  constexpr double own_of_the_reference = 9;  // with its masks and the bound
  return static_cast<int>(std::ceil(kept + 5.0 * static_cast<double>(methods + 1) + own_of_the_reference));
}

// Another reference, of another count of samples.
struct OtherTruth {
  int spp = 1;
  Image mean;
  std::optional<double> noise_floor;
};

// The picture of `exact`, and where it was drawn.
struct BoundPicture {
  Image picture;
  Image pixels;  // interior ones; a mask
};

// What is known of one distance besides the methods.
struct Truth {
  std::size_t frame = 0;
  double distance = 1;
  View view;
  Supersampled reference;  // its unresolved pixels uncovered
  Image first;             // its mean over the samples that every pixel has, likewise
  Image unresolved;        // a mask of them
  std::optional<double> noise_floor, shading_floor;
  PixelParts parts;
  std::optional<BoundPicture> bound;
  std::vector<Tile> light_tiles;  // lit by all of an environment, and the interior pixels there
  Image light_pixels;
  std::string reference_file, standard_error_file, interior_file;
  std::vector<SupersamplingPoint> curve;
  std::vector<OtherTruth> others;
};

// A record whose error picture waits for the scale that all of them share.
struct Draft {
  Record record;
  Exhibit exhibit;
  std::string stem;
};

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// Of so many frames those that are timed: more of them take as many times longer.
int timed_frames(int spp) { return std::min(spp, 8); }

// How often they are timed: few of them, which a passing disturbance would spoil, more often.
int curve_repeats(int spp) { return std::clamp(16 / spp, 2, 5); }

std::optional<double> normalized_color(const Image& picture, const Image& reference, float exposure) {
  const std::optional<ErrorFigures> figures = compare_images(picture, reference, exposure);
  return figures ? std::optional(figures->normalized_color) : std::nullopt;
}

class Comparison {
 public:
  Comparison(const RunSettings& settings, std::filesystem::path folder, const Progress& progress)
      : settings_(settings),
        folder_(std::move(folder)),
        whole_(progress, 4),
        stage_(load_scene(settings.scene, settings.scene_library, settings.view.camera), with_direct(settings),
               whole_.next(1, ""), pictures_of_a_frame, filter_of_the_unit),
        distances_(run_distances(settings.view, stage_.scene())),
        parts_(whole_.next(3, ""),
               static_cast<double>(distances_.size()) * ((1.0 + automatic_work) * settings.reference.spp +
                                                         other_samples() + curve_samples() + method_weight())) {
    require_pictures(stage_.view(1.0).size, pictures_held(settings.methods.size(), distances_.size()));
  }

  Results run(std::span<const FrameTimes> further_times) {
    std::filesystem::create_directories(folder_ / "images");
    interior_finder_.emplace(stage_.interior_finder());
    stage_bound();
    for (std::size_t i = 0; i < distances_.size(); ++i) {
      Truth truth = find_truth(i);
      results_.supersampling.insert(results_.supersampling.end(), truth.curve.begin(), truth.curve.end());
      for (std::size_t m = 0; m < settings_.methods.size(); ++m) drafts_.push_back(compare_method(truth, m));
      set_times(i, further_times);
      before_ = std::move(truth.reference);
    }
    finish_error_pictures();
    describe(static_cast<int>(further_times.size()) + 1);
    return std::move(results_);
  }

  FrameTimes times() {
    FrameTimes all;
    for (const double distance : distances_) all.push_back(time_distance(distance));
    return all;
  }

 private:
  [[nodiscard]] double other_samples() const {
    const std::vector<int>& others = settings_.reference.other_spp;
    return std::accumulate(others.begin(), others.end(), 0.0);
  }

  // Of the renders and timed draws of plain supersampling: what it weighs beside the reference.
  [[nodiscard]] double curve_samples() const {
    double samples = 0.0;
    for (const int spp : settings_.reference.supersampling) samples += spp + timed_frames(spp) * curve_repeats(spp);
    return samples;
  }

  [[nodiscard]] double method_weight() const {
    return static_cast<double>(settings_.methods.size()) * (settings_.reference.spp + settings_.timing.repeats);
  }

  [[nodiscard]] const StagedMethod& method(std::size_t index) const { return stage_.methods()[index + 1]; }

  [[nodiscard]] std::string stem_of(double distance, const std::string& what) const {
    return fmt::format("d{}_{}", file_stem(fmt::format("{}", distance)), what);
  }

  Truth find_truth(std::size_t frame) {
    const double distance = distances_[frame];
    const std::string prefix = fmt::format("distance {:g}: ", distance);
    Truth truth{.frame = frame,
                .distance = distance,
                .view = stage_.view(distance),
                .reference = {},
                .first = {},
                .unresolved = {},
                .noise_floor = {},
                .shading_floor = {},
                .parts = {},
                .bound = {},
                .light_tiles = {},
                .light_pixels = {},
                .reference_file = {},
                .standard_error_file = {},
                .interior_file = {},
                .curve = {},
                .others = {}};
    const auto begin = std::chrono::steady_clock::now();
    truth.reference = stage_.reference().render(truth.view, settings_.reference.spp, settings_.reference.seed,
                                                parts_.next(settings_.reference.spp, prefix + "reference, "));
    if (frame == 0) {
      chosen_exposure_ = choose_exposure(settings_.view.exposure, stage_.scene(), truth.reference.mean);
      exposure_ = chosen_exposure_.factor;
    }
    truth.first = truth.reference.mean;
    const bool by_noise = settings_.reference.by_noise && !settings_.reference.fixed_spp;
    samples_ += by_noise ? refine_reference(truth, prefix) : settings_.reference.spp;
    seconds_ += seconds_since(begin);
    references_.push_back({.caption = fmt::format("reference, {} spp", settings_.reference.spp),
                           .picture = truth.reference.mean,
                           .error = {}});
    write_reference(truth);
    leave_out_unresolved(truth);
    truth.noise_floor = noise_floor(truth.reference, exposure_);
    if (frame == 0) results_.reference.standard_error = relative_standard_error(truth.reference);
    find_parts(truth, prefix);
    truth.curve = supersampling_curve(truth, prefix);
    for (const int spp : settings_.reference.other_spp) {
      Supersampled other = stage_.reference().render(truth.view, spp, settings_.reference.seed,
                                                     parts_.next(spp, prefix + "other reference, "), TexelUse::drawn);
      leave_out(other, truth.unresolved);
      truth.others.push_back({.spp = spp, .mean = other.mean, .noise_floor = noise_floor(other, exposure_)});
    }
    return truth;
  }

  // Goes on with the reference until its noise is what was asked for; returns its mean samples a pixel.
  double refine_reference(Truth& truth, const std::string& prefix) {
    const ReferenceSettings& asked = settings_.reference;
    const Convergence wanted{.noise = asked.noise.value_or(noise_that_tells_apart(truth)),
                             .exposure = exposure_,
                             .spp_max = asked.spp_max,
                             .most_work = asked.noise ? unbounded_work : most_work(truth.view.size)};
    return converge(stage_.reference(), truth.reference, truth.view, asked.seed, wanted,
                    parts_.next(automatic_work * asked.spp, prefix + "reference, "));
  }

  // Unasked: as many samples as the picture has, and more where that is little.
  [[nodiscard]] double most_work(const glm::ivec2& size) const {
    const double first = static_cast<double>(settings_.reference.spp) * size.x * size.y;
    return std::max(automatic_work, automatic_samples / first);
  }

  // A fifth of the least difference between the methods' errors that the table prints, or of the least error. Methods
  // that agree to three figures are one to it.
  [[nodiscard]] double noise_that_tells_apart(const Truth& truth) const {
    Supersampled counted = truth.reference;
    leave_out(counted, unresolved(counted, exposure_));
    std::vector<double> errors;
    for (std::size_t m = 0; m < settings_.methods.size(); ++m) {
      if (const auto error = normalized_color(method(m).frames().render(truth.view), counted.mean, exposure_))
        errors.push_back(*error);
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

  void write_reference(Truth& truth) const {
    const std::string stem = stem_of(truth.distance, "reference");
    truth.reference_file = write_exposable_picture(folder_, stem, truth.reference.mean, exposure_);
    truth.standard_error_file = fmt::format("images/{}_standard_error.exr", stem);
    write_exr(folder_ / truth.standard_error_file, truth.reference.standard_error);
  }

  // Every figure is over the pixels that are covered; what is left out stands in the warnings.
  void leave_out_unresolved(Truth& truth) {
    const std::size_t whole = object_pixel_count(truth.reference.mean);
    truth.unresolved = unresolved(truth.reference, exposure_);
    leave_out(truth.reference, truth.unresolved);
    uncover(truth.first, truth.unresolved);
    const std::size_t left_out = whole - object_pixel_count(truth.reference.mean);
    truth.parts.counts.unresolved = left_out;
    if (left_out == 0) return;
    results_.scene.warnings.push_back(fmt::format(
        "distance {:g}: {:.2g}% of the object unresolved: in {} of {} pixels a few samples carry nearly all of the "
        "light; they are left out of every figure",
        truth.distance, 100.0 * static_cast<double>(left_out) / static_cast<double>(whole), left_out, whole));
  }

  // The pixels that are interior, and the bound over them.
  void find_parts(Truth& truth, const std::string& prefix) {
    const Interior interior = interior_finder_->render(truth.view, settings_.reference.spp, settings_.reference.seed,
                                                       parts_.next(interior_weight, prefix));
    stage_.context().check("finding interior pixels");
    const std::size_t left_out = truth.parts.counts.unresolved;
    truth.parts = pixel_parts(truth.reference.mean, interior);
    truth.parts.counts.unresolved = left_out;
    truth.shading_floor = noise_floor_over(truth.reference, exposure_, truth.parts.interior);
    truth.interior_file = write_mask(folder_, stem_of(truth.distance, "interior"), truth.parts.interior);
    if (has(stage_.effects(), Effect::environment_light)) {
      truth.light_tiles = cheap_parts(
          truth.parts, light_tile, [](int, int) { return 1.0; }, pixels_lit_by_all);
      truth.light_pixels = within(truth.parts.interior, truth.light_tiles);
      truth.parts.counts.light = count_pixels(truth.light_pixels);
    }
    const Progress progress = parts_.next(interior_weight, prefix);
    if (!bound_) return;
    progress("exact", 0.0);
    truth.bound = draw_bound(truth, interior.texels);
    truth.parts.counts.bound = count_pixels(truth.bound->pixels);
    stage_.context().check("drawing the bound");
  }

  // Whole where that was asked for or is cheap, else in squares.
  [[nodiscard]] BoundPicture draw_bound(const Truth& truth, const Image& texels) const {
    const double lights = static_cast<double>(std::max<std::size_t>(stage_.scene().lights.size(), 1));
    const PixelCost facets = [&](int x, int y) { return lights * facets_of_bound(texels.at(x, y)[0]); };
    const std::vector<Tile> whole{{.origin = {0, 0}, .size = truth.view.size}};
    const bool all =
        settings_.reference.bound == BoundUse::on || cost_of(whole.front(), truth.parts, facets) <= cheap_facets;
    const std::vector<Tile> tiles = all ? whole : cheap_parts(truth.parts, bound_tile, facets, cheap_facets);
    const FrameRenderer& frames = bound_->frames();
    BoundPicture bound{.picture = all ? frames.render(truth.view) : frames.render(truth.view, tiles),
                       .pixels = within(truth.parts.interior, tiles)};
    leave_out_infinite(bound.picture, bound.pixels);  // of more texels and lights than it sums
    return bound;
  }

  // `exact`, where this build has it and it knows every effect of the scene; else why not is said.
  void stage_bound() {
    if (settings_.reference.bound == BoundUse::off) return;
    const auto all = all_methods();
    const auto found = std::ranges::find(all, bound_name, [](const Method* m) { return m->info().name; });
    if (found == all.end()) return;
    const EffectSet left_out = stage_.effects() & ~(*found)->info().honours;
    if (left_out.any()) {
      results_.scene.warnings.push_back(
          fmt::format("no bound is drawn: {} leaves out {}", bound_name, fmt::join(effect_names(left_out), ", ")));
      return;
    }
    bound_.emplace(stage_.stage(parse_methods(std::string(bound_name)).front(), no_progress));
  }

  std::vector<SupersamplingPoint> supersampling_curve(const Truth& truth, const std::string& prefix) {
    const FrameRenderer& direct = stage_.methods().front().frames();
    std::vector<SupersamplingPoint> curve;
    for (const int spp : settings_.reference.supersampling) {
      const std::uint64_t seed = settings_.reference.seed ^ (curve_seed * static_cast<std::uint64_t>(spp));
      const std::vector<glm::dvec2> offsets = frame_offsets(spp, seed);
      const Image picture = mean_of_frames(direct, truth.view, offsets, parts_.next(spp, prefix + "supersampling, "));
      const int repeats = curve_repeats(spp);
      const DrawFrame draw = [&] {
        for (int i = 0; i < timed_frames(spp); ++i) direct.draw(truth.view, offsets[static_cast<std::size_t>(i)]);
      };
      const std::vector<double> times =
          repeated_times(stage_.context().info(), draw, repeats, parts_.next(timed_frames(spp) * repeats, prefix));
      curve.push_back({.distance = truth.distance,
                       .spp = spp,
                       .normalized_color = normalized_color(picture, truth.reference.mean, exposure_),
                       .shading = normalized_color_over(picture, truth.reference.mean, exposure_, truth.parts.interior),
                       .ms = quantile(times, 0.5) * spp / timed_frames(spp)});
    }
    return curve;
  }

  Draft compare_method(const Truth& truth, std::size_t index) {
    const StagedMethod& staged = method(index);
    const std::string prefix = fmt::format("distance {:g}: {}, ", truth.distance, settings_.methods[index].text);
    Draft draft{.record = new_record(truth, staged),
                .exhibit = {},
                .stem = stem_of(truth.distance, method_stem(settings_.methods, index))};
    Image picture = staged.frames().render(truth.view);
    Supersampled finest =
        stage_.finest_level(staged).render(truth.view, settings_.reference.spp, settings_.reference.seed,
                                           parts_.next(settings_.reference.spp, prefix + "finest level, "));
    leave_out(finest, truth.unresolved);
    stage_.context().check("rendering " + settings_.methods[index].text);
    try {
      set_error(draft.record, truth, picture, finest.mean);
      set_light_error(draft.record, truth, picture, staged);
    } catch (const Error& error) {
      throw error.within("method " + settings_.methods[index].text);
    }
    set_flicker(draft.record, truth, picture, index);
    draft.record.images.color = write_exposable_picture(folder_, draft.stem, picture, exposure_);
    draft.record.images.reference = truth.reference_file;
    draft.record.images.standard_error = truth.standard_error_file;
    draft.record.images.interior = truth.interior_file;
    Image error = error_map(picture, truth.reference.mean, exposure_);
    draft.exhibit = {
        .caption = settings_.methods[index].text, .picture = std::move(picture), .error = std::move(error)};
    return draft;
  }

  Record new_record(const Truth& truth, const StagedMethod& staged) const {
    const BakedMethod& baked = staged.baked();
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

  void set_error(Record& record, const Truth& truth, const Image& picture, const Image& finest) const {
    const Image& reference = truth.reference.mean;
    const std::optional<ErrorFigures> figures = compare_images(picture, reference, exposure_);
    if (!figures) return;
    // The finest level is supersampled with the reference's own samples: where one covers a pixel whole, so does the
    // other.
    record.error = RecordError{.normalized_color = figures->normalized_color,
                               .relative_rmse = figures->relative_rmse,
                               .relmse = figures->relmse,
                               .psnr = figures->psnr,
                               .energy_bias = figures->energy_bias,
                               .noise_floor = truth.noise_floor,
                               .representation = normalized_color(finest, truth.first, exposure_).value(),
                               .filtering = normalized_color(picture, finest, exposure_).value(),
                               .causes = causes_of(truth, picture)};
    // Over interior pixels, where there are some: supersampling mends edges, and no method here does.
    const std::optional<double>& shading = record.error->causes.shading;
    record.equivalent = equivalent_samples(
        footprint::supersampling_curve(truth.curve, truth.distance,
                                       shading ? &SupersamplingPoint::shading : &SupersamplingPoint::normalized_color),
        shading.value_or(figures->normalized_color));
    for (const OtherTruth& other : truth.others) {
      if (const auto error = normalized_color(picture, other.mean, exposure_)) {
        record.other_references.push_back(
            {.spp = other.spp, .normalized_color = *error, .noise_floor = other.noise_floor});
      }
    }
  }

  [[nodiscard]] ErrorCauses causes_of(const Truth& truth, const Image& picture) const {
    ErrorCauses causes = error_causes({.method = picture,
                                       .reference = truth.reference.mean,
                                       .bound = truth.bound ? &truth.bound->picture : nullptr,
                                       .bound_pixels = truth.bound ? &truth.bound->pixels : nullptr},
                                      truth.parts, exposure_);
    causes.shading_floor = truth.shading_floor;
    if (truth.reference.halves)
      causes.shading_noise = error_noise(picture, *truth.reference.halves, exposure_, truth.parts.interior);
    return causes;
  }

  // The lookup of an environment by the method's lobes against all of its light shaded by the method.
  void set_light_error(Record& record, const Truth& truth, const Image& picture, const StagedMethod& staged) {
    const bool is_lit = has(staged.baked().method->info().honours, Effect::environment_light);
    if (!record.error || truth.light_tiles.empty() || !is_lit) return;
    if (!dense_frames_.contains(&staged)) dense_frames_.emplace(&staged, stage_.dense_frames(staged));
    const Image lit = dense_frames_.at(&staged).render(truth.view, truth.light_tiles);
    Image pixels = truth.light_pixels;
    leave_out_infinite(lit, pixels);
    record.pixels.light = count_pixels(pixels);
    record.error->causes.light = error_between(picture, lit, truth.reference.mean, exposure_, pixels);
  }

  // Against the frame before: the picture of the same method, one round of drafts earlier.
  void set_flicker(Record& record, const Truth& truth, const Image& picture, std::size_t index) const {
    if (settings_.view.zoom.frames == 0 || truth.frame == 0) return;
    const Image& before = drafts_[(truth.frame - 1) * settings_.methods.size() + index].exhibit.picture;
    record.flicker = flicker_between(before, picture, before_, truth.reference, exposure_);
  }

  std::vector<std::vector<double>> time_distance(double distance) {
    const View view = stage_.view(distance);
    std::vector<DrawFrame> draws;
    for (const StagedMethod& staged : stage_.methods())
      draws.emplace_back([&staged, &view] { staged.frames().draw(view); });
    for (const StagedMethod& staged : stage_.methods()) {
      if (staged.gpu().has_frame_build()) draws.emplace_back([&staged, &view] { staged.gpu().rebuild(view); });
    }
    const double weight = static_cast<double>(settings_.methods.size()) * settings_.timing.repeats;
    return interleaved_times(stage_.context().info(), draws, settings_.timing.repeats,
                             parts_.next(weight, fmt::format("distance {:g}: ", distance)));
  }

  // The times of one candidate at one distance, over all processes.
  static std::vector<double> pooled(std::span<const FrameTimes> processes, std::size_t distance,
                                    std::size_t candidate) {
    std::vector<double> times;
    for (const FrameTimes& process : processes) {
      const auto& own = process.at(distance).at(candidate);
      times.insert(times.end(), own.begin(), own.end());
    }
    return times;
  }

  // Fills in the times of the drafts of one distance, the last ones made.
  void set_times(std::size_t distance, std::span<const FrameTimes> further) {
    std::vector<FrameTimes> processes(further.begin(), further.end());
    processes.emplace_back(distances_.size());
    processes.back()[distance] = time_distance(distances_[distance]);
    const std::size_t count = settings_.methods.size();
    const std::vector<double> direct = pooled(processes, distance, 0);
    std::size_t build = count + 1;  // the candidate that is the next method's frame build
    for (std::size_t m = 0; m < count; ++m) {
      const std::vector<double> times = pooled(processes, distance, m + 1);
      const std::vector<double> ratios = paired_ratios(times, direct);
      Record& record = drafts_[drafts_.size() - count + m].record;
      record.frame_ms = {
          .median = quantile(times, 0.5), .minimum = std::ranges::min(times), .p90 = quantile(times, 0.9)};
      record.fps = 1000.0 / record.frame_ms.median;
      record.ratio_to_direct = {
          .median = quantile(ratios, 0.5), .minimum = std::ranges::min(ratios), .maximum = std::ranges::max(ratios)};
      record.work = work_of(m, stage_.view(distances_[distance]));
      if (!method(m).gpu().has_frame_build()) continue;
      record.frame_build =
          FrameBuildTime{.ms = quantile(pooled(processes, distance, build++), 0.5),
                         .timing = method(m).gpu().keeps_builds() ? BuildTiming::reused : BuildTiming::every_frame};
    }
  }

  // Not of methods that draw for seconds: they would count as long.
  std::optional<RecordWork> work_of(std::size_t m, const View& view) {
    if (method(m).baked().method->info().slow_frame) return {};
    if (counting_.size() <= m) counting_.push_back(stage_.counting_frames(method(m)));
    const PixelWork work = pixel_work(counting_[m], view);
    return RecordWork{.fetches = work.lookups, .lobes = work.lobes};
  }

  // What stands at the top of the pictures of some drafts: what was asked for, else the largest 99th percentile over
  // them, in two digits.
  [[nodiscard]] double error_scale(std::span<const Draft> drafts) const {
    if (settings_.view.error_scale) return *settings_.view.error_scale;
    double scale = smallest_error_scale;
    for (const Draft& draft : drafts) {
      std::vector<double> values;
      std::ranges::copy_if(draft.exhibit.error.texels, std::back_inserter(values), [](float v) { return v > 0.0F; });
      if (!values.empty()) scale = std::max(scale, quantile(std::move(values), scale_quantile));
    }
    const double step = std::pow(10.0, std::floor(std::log10(scale)) - 1.0);
    return std::ceil(scale / step) * step;
  }

  // The drafts stand in the order of the distances, as many for each as there are methods.
  [[nodiscard]] std::span<Draft> drafts_at(std::size_t distance) {
    return std::span(drafts_).subspan(distance * settings_.methods.size(), settings_.methods.size());
  }

  void finish_error_pictures() {
    results_.error_scale = error_scale(drafts_);
    for (std::size_t i = 0; i < distances_.size(); ++i) {
      const double scale = error_scale(drafts_at(i));
      results_.error_scales.push_back({.distance = distances_[i], .error = scale});
      write_distance_strips(i, scale);
      for (Draft& draft : drafts_at(i)) finish_error_picture(draft, scale);
    }
  }

  void finish_error_picture(Draft& draft, double scale) {
    const auto write = [&](const std::string& end, double top) {
      return write_error_picture(folder_, draft.stem + end, draft.exhibit.error, static_cast<float>(top));
    };
    RecordImages& images = draft.record.images;
    images.error = write("_error", scale);
    images.error_shared = scale == results_.error_scale ? images.error : write("_error_shared", results_.error_scale);
    results_.records.push_back(std::move(draft.record));
  }

  void write_distance_strips(std::size_t distance, double scale) {
    std::vector<Exhibit> exhibits{std::move(references_[distance])};
    for (const Draft& draft : drafts_at(distance)) exhibits.push_back(draft.exhibit);
    write_strips(folder_, stem_of(distances_[distance], "all"), exhibits, exposure_, static_cast<float>(scale));
  }

  void describe(int processes) {
    results_.backend = backend_info(stage_.context().info());
    results_.reference.spp = settings_.reference.spp;
    results_.reference.samples = samples_ / static_cast<double>(distances_.size());
    results_.reference.seconds = seconds_;
    results_.reference.filter = word_for(reference_filters, settings_.reference.filter);
    results_.reference.seed = settings_.reference.seed;
    results_.footprint = footprint_filter_text(footprint_filter_of(settings_, stage_.scene()));
    results_.timing = {.frames = settings_.timing.repeats, .processes = processes};
    if (has(stage_.effects(), Effect::environment_light))
      results_.reference.environment = word_for(reference_integrals, settings_.reference.environment);
    std::vector<std::string> notes = std::move(results_.scene.warnings);
    results_.scene = scene_info(stage_.scene(), chosen_exposure_);
    std::ranges::move(notes, std::back_inserter(results_.scene.warnings));
    add_left_out();
    add_precompute_notes();
  }

  void add_left_out() {
    const EffectSet left_out = effects_on(stage_.decisions()) & settings_.without;
    if (left_out.none()) return;
    results_.scene.warnings.push_back(fmt::format("left out of every picture, the reference's too, as was asked: {}",
                                                  fmt::join(effect_names(left_out), ", ")));
  }

  void add_precompute_notes() {
    for (std::size_t m = 0; m < settings_.methods.size(); ++m) {
      const BakedMethod& baked = method(m).baked();
      for (std::size_t i = 0; i < baked.materials.size(); ++i) {
        for (const std::string& note : baked.materials[i].notes)
          results_.scene.warnings.push_back(
              fmt::format("{}, material {}: {}", baked.spec.text, stage_.scene().materials[i].name, note));
      }
    }
  }

  const RunSettings& settings_;
  std::filesystem::path folder_;
  ProgressParts whole_;
  Stage stage_;
  std::vector<double> distances_;
  std::optional<InteriorFinder> interior_finder_;  // of a run that measures errors
  std::optional<StagedMethod> bound_;
  std::map<const StagedMethod*, FrameRenderer> dense_frames_;  // of a scene with an environment
  ProgressParts parts_;
  double samples_ = 0, seconds_ = 0;  // of the references of all distances
  Exposure chosen_exposure_;
  std::vector<FrameRenderer> counting_;  // of each method, made where it is first counted
  float exposure_ = 1.0F;                // its factor
  std::vector<Draft> drafts_;
  std::vector<Exhibit> references_;  // one a distance, for the strips
  Supersampled before_;              // the reference of the frame before
  Results results_;
};

}  // namespace

FrameTimes time_frames(const RunSettings& settings, const Progress& progress) {
  return Comparison(settings, {}, progress).times();
}

Results run_compare(const RunSettings& settings, const std::filesystem::path& folder,
                    std::span<const FrameTimes> further_times, const Progress& progress) {
  return Comparison(settings, folder, progress).run(further_times);
}

}  // namespace footprint
