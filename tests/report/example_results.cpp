// Makes up four methods, their curve and an experiment with every kind of outcome; then spoils them.
#include "tests/report/example_results.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>

#include "results/report/figures.hpp"
#include "results/report/ranking.hpp"

namespace footprint {
namespace {

/// The behaviour of one made-up method: its error at distance 1 and by how much it grows per distance, and its price.
struct Behaviour {
  const char* method;
  double error, growth, milliseconds;
  std::uint64_t bytes;
};

constexpr std::array<Behaviour, 4> behaviours = {{{"direct", 0.021, 2.1, 2.04, 0},
                                                  {"naive_mip", 0.018, 1.65, 2.31, 12'582'912},
                                                  {"toksvig", 0.011, 1.18, 2.52, 16'777'216},
                                                  {"toksvig:storage=unorm8", 0.0125, 1.22, 2.43, 4'194'304}}};

// So many pixels, fewer the brighter, and a few that sparkle: of the last bin.
std::array<std::uint32_t, 32> example_luminances(std::uint32_t pixels, std::uint32_t sparkles) {
  std::array<std::uint32_t, 32> counts{};
  std::uint32_t left = pixels - sparkles;
  for (std::size_t i = 0; i < counts.size() / 2; ++i) {
    counts[i] = left / 3;
    left -= counts[i];
  }
  counts.front() += left;
  counts.back() = sparkles;
  return counts;
}

Record example_record(const Results& results, const Behaviour& behaviour, double distance) {
  Record record;
  record.scene = results.scene.name;
  record.method = behaviour.method;
  record.options = {{"probes", 1.0}, {"storage", std::string("fp32")}};
  record.distance = distance;
  record.width = record.height = 256;
  const double error = behaviour.error * std::pow(behaviour.growth, std::log2(distance));
  record.error = RecordError{{.normalized_color = error,
                              .relative_rmse = error * 4.1,
                              .relmse = error * 9.3,
                              .psnr = -20 * std::log10(error),
                              .energy_bias = -0.013 * distance,
                              .luminance_distance = error * 0.4,
                              .smape = error * 1.3,
                              .ssim = 1 - error * 2.1,
                              .luminances = example_luminances(12'345, static_cast<std::uint32_t>(1000 * error)),
                              .reference_luminances = example_luminances(12'345, 40)},
                             0.00071,
                             error * 0.22,
                             error * 0.91,
                             {error * 0.8, 0.0005, 1e-5, error * 1.6, 0.006, error * 0.8 - 0.004, {}}};
  record.pixels = {
      .object = 12'345, .unresolved = 50, .interior = 9'260, .minified = 9'000, .bound = 9'260, .light = {}};
  record.equivalent = equivalent_samples(
      supersampling_curve(results.supersampling, distance, &SupersamplingPoint::shading), error * 0.8);
  if (behaviour.bytes != 0) record.history = {.frames = 16, .alpha = 0.1, .clamp = HistoryClamp::box, .jitter = true};
  const double ms = behaviour.milliseconds / std::pow(distance, 0.3);
  record.frame_ms = {ms, ms * 0.96, ms * 1.11};
  record.fps = 1000 / ms;
  const double ratio = behaviour.milliseconds / behaviours[0].milliseconds;
  record.ratio_to_direct = {ratio, ratio * 0.97, ratio * 1.05};
  record.precompute_bytes = behaviour.bytes;
  if (behaviour.bytes != 0) record.precompute_bytes_per_texel = 16.0;
  record.precompute_seconds = static_cast<double>(behaviour.bytes) * 2e-8;
  record.effects_on = {"diffuse", "fresnel", "normal_variation"};
  if (behaviour.bytes != 0) record.effects_left_out = {"roughness_variation"};
  const std::string stem = fmt::format("images/method{}_d{}", &behaviour - behaviours.data(), distance);
  record.images = {stem + ".exr",
                   fmt::format("images/reference_d{}.exr", distance),
                   stem + "_error.png",
                   stem + "_error_shared.png",
                   stem + "_flip.png",
                   fmt::format("images/interior_d{}.exr", distance),
                   fmt::format("images/reference_d{}_standard_error.exr", distance)};
  return record;
}

/// Every kind of outcome; `text` replaces every text of a file or a paper.
ExperimentReport example_experiment(const std::string& text) {
  return {.name = "example",
          .title = "A made-up experiment" + text,
          .description = "Shows every kind of outcome." + text,
          .file = "experiments/example.toml",
          .quick = true,
          .published = {{.figure = "Figure 4" + text,
                         .measure = "fps(toksvig)",
                         .unit = "fps",
                         .published = 125,
                         .measured = 400.5,
                         .note = text},
                        {.figure = "Figure 5",
                         .measure = "precompute(toksvig)",
                         .unit = "s",
                         .published = 300,
                         .measured = {},
                         .note = "from the cache"}},
          .claims = {{.name = "passes",
                      .text = "It passes." + text,
                      .source = ClaimSource::gpu_time,
                      .inequality = "error(toksvig) < error(direct)",
                      .expect = Verdict::reproduced,
                      .outcome = Verdict::reproduced,
                      .reason = "as it should" + text,
                      .problem = {},
                      .left = 0.011,
                      .right = 0.021,
                      .figures = {{"error(toksvig)", 0.011, true}, {"error(direct)", 0.021, false}}},
                     {.name = "undecided",
                      .text = "It is unknown.",
                      .inequality = "precompute(toksvig) < 300",
                      .expect = Verdict::not_reproduced,
                      .outcome = Verdict::undecided,
                      .reason = "no reason",
                      .problem = "the bake came from the cache",
                      .left = {},
                      .right = 300,
                      .figures = {}},
                     {.name = "time",
                      .text = "It is fast.",
                      .source = ClaimSource::gpu_time,
                      .inequality = "time(toksvig) < time(direct)",
                      .expect = Verdict::not_reproduced,
                      .outcome = Verdict::undecided,
                      .reason = "it is timed on a GPU",
                      .problem = {},
                      .undecidable = "timed on llvmpipe, a software renderer" + text,
                      .left = 4,
                      .right = 1,
                      .figures = {{"time(toksvig)", 4, false}, {"time(direct)", 1, false}}}},
          .second_verdicts = {{.claim = "time",
                               .gpu = "Steam Deck",
                               .left = 0.3,
                               .right = 0.6,
                               .outcome = Verdict::reproduced,
                               .problem = {}},
                              {.claim = "time",
                               .gpu = "PS4",
                               .left = {},
                               .right = 0.6,
                               .outcome = Verdict::undecided,
                               .problem = "the figure is not a number" + text}},
          .thresholds = {{.measure = "error(toksvig)", .limit = 0.02, .measured = 0.011, .problem = {}},
                         {.measure = "error(direct)", .limit = 0.02, .measured = 0.021, .problem = {}},
                         {.measure = "flicker(direct)", .limit = 0.02, .measured = {}, .problem = "no figure" + text}},
          .pictures = {"images/figure.png"}};
}

}  // namespace

Results example_results() {
  Results results;
  results.tool.version = "0.1.0";
  results.backend = {"egl", "llvmpipe (LLVM 15.0.6, 256 bits)", "4.5 (Core Profile) Mesa 22.3.6",
                     "AMD EPYC 7B13, 2 cores"};
  results.scene = {.name = "ClearCoatTest",
                   .source = "ClearCoatTest.gltf",
                   .triangles = 37'322,
                   .materials = 9,
                   .lights = 2,
                   .exposure = 0.84,
                   .exposure_source = "automatic",
                   .defaults = {"a camera framed on the bounds", "a rig of two lights"},
                   .warnings = {"KHR_materials_clearcoat is optional here and was left out"}};
  results.reference = {256, "after_shading", 7, {0.0042, 0.0051, 0.0085}};
  results.footprint = "anisotropic:8";
  results.timing = {.frames = 9, .processes = 5};
  results.error_scale = 0.1;
  for (const double distance : {1.0, 4.0, 16.0}) {
    results.error_scales.push_back({distance, 0.1 / distance});
    for (const int spp : {1, 2, 4, 8, 16, 32, 64}) {
      const double error = 0.024 * std::pow(distance, 0.9) / std::sqrt(spp);
      results.supersampling.push_back(
          {distance, spp, error, error * 0.8, (1.6 + 0.72 * spp) / std::pow(distance, 0.3)});
    }
    for (const Behaviour& behaviour : behaviours) {
      results.records.push_back(example_record(results, behaviour, distance));
    }
  }
  for (const double distance : {1.0, 4.0}) {
    for (std::size_t i = 0; i < behaviours.size(); ++i) {
      for (std::size_t j = i + 1; j < behaviours.size(); ++j) {
        const double share = 0.1 * static_cast<double>(i + 2 * j) / distance;
        results.pairs.push_back({.distance = distance,
                                 .methods = {behaviours[i].method, behaviours[j].method},
                                 .closer = {0.05 * static_cast<double>(i), share},
                                 .picture = fmt::format("images/pair{}{}_d{}.png", i, j, distance)});
      }
    }
  }
  results.records[2].error->normalized_color = 0.0006;  // below the noise floor
  results.records[2].error->causes.shading = 0.0004;
  for (std::size_t i = 4; i < 8; ++i)
    results.records[i].pixels = {.object = 150, .interior = 60, .minified = 60, .bound = {}, .light = {}};
  for (std::size_t i = 8; i < 12; ++i)
    results.records[i].pixels = {.object = 30, .interior = 7, .minified = 7, .bound = {}, .light = {}};
  results.records[1].error->causes.light = 0.0021;
  results.records[1].fetches = 96.5;
  results.records[1].lobes = 12.25;
  results.records[3].frame_build_ms = 0.31;
  results.records[3].frame_build = BuildTiming::every_frame;
  results.records[3].precompute_cached = true;
  results.records[0].other_references = {{16, 0.0223, 0.0029}, {36, 0.0217, {}}};
  results.records[4].flicker = Flicker{.mean = 0.031, .p99 = 0.4, .noise_floor = 0.002};
  results.records[5].flicker = Flicker{.mean = 0.013, .p99 = 1.1, .noise_floor = {}};
  results.quantities = {{"narrow", "toksvig", "fit_error", 1.25e-6}};
  results.ndf = {{"groove", "toksvig", 0.41, 1.002, 3.4, 1, "ndf/groove/ndf.png"}};
  results.experiment = example_experiment("");
  return results;
}

Results hostile_results() {
  Results results = example_results();
  results.scene.name = "</script><script>document.title='broken'</script>\"<b>&amp; {{data}}";
  results.scene.source = "a,b\r\n\"c\".gltf";
  results.scene.warnings = {"not UTF-8: \xff\xfe, and <!-- a comment"};
  results.backend.cpu = "| pipe `tick` [link](javascript:alert(1)) *star*";
  results.experiment = example_experiment("<script>document.title='broken'</script> | `\xff` *");
  for (Record& record : results.records) record.scene = results.scene.name;
  Record& named = results.records[1];
  results.pairs[1].methods[1] = "</script>";
  results.pairs[2].picture = "images/pair absent <b>#1.png";
  named.method = "<img src=x onerror=\"document.title='broken'\">' , #?%";
  named.options["a/b~c"] = std::string("=;\"");
  named.images.color = "images/absent <b>#1.exr";
  results.records[2].error.reset();
  results.records[2].equivalent.reset();
  RecordError& equal = *results.records[3].error;
  equal.normalized_color = 0;
  equal.psnr = equal.relative_rmse = equal.relmse = equal.energy_bias = std::numeric_limits<double>::infinity();
  equal.noise_floor.reset();
  constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
  results.records[3].ratio_to_direct = {no_number, no_number, no_number};
  results.reference.standard_errors[0].reset();
  results.reference.seed = std::numeric_limits<std::uint64_t>::max();
  results.supersampling[3].normalized_color.reset();
  return results;
}

MatrixResults example_matrix(std::size_t members) {
  MatrixResults matrix{.report = example_experiment(""), .left_out = {"error(lean)"}, .members = {}};
  matrix.report.pictures.clear();
  for (std::size_t i = 0; i < members; ++i) {
    Results results = example_results();
    const std::string scene = fmt::format("surface_{}", i / 2);
    results.footprint = i % 2 == 0 ? "trilinear" : "anisotropic:8";
    results.coordinates = {{"scene", scene}, {"footprint", results.footprint}};
    results.scene.name = scene;
    results.experiment.reset();
    const double scale = 1.0 + 0.1 * static_cast<double>(i % 7);
    for (Record& record : results.records) {
      record.scene = scene;
      record.error->normalized_color *= scale;
      if (record.error->causes.shading) *record.error->causes.shading *= scale;
      record.frame_ms = {.median = record.frame_ms.median * scale,
                         .min = record.frame_ms.min * scale,
                         .p90 = record.frame_ms.p90 * scale};
      record.flicker = Flicker{
          .mean = (0.5 * record.error->normalized_color + 0.01) / record.distance, .p99 = 0.3, .noise_floor = 0.002};
    }
    std::string folder = fmt::format("{}-{}", scene, i % 2 == 0 ? "trilinear" : "anisotropic_8");
    matrix.members.push_back({.folder = std::move(folder), .results = std::move(results)});
  }
  return matrix;
}

}  // namespace footprint
