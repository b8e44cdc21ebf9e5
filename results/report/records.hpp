// The measurements of a run as plain values: the content of results.json (results.md), free of GL and of files. Each
// structure lists its fields there; those that differ from their members are in record_fields.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "renderer/core/gpu_cost.hpp"
#include "renderer/core/names.hpp"
#include "renderer/image/metrics.hpp"
#include "renderer/pipeline/history_settings.hpp"
#include "results/report/fields.hpp"

namespace footprint {

/// The position of an error on the measured curve of plain supersampling.
enum class CurveSide {
  within,
  below,  ///< worse than the whole curve
  above   ///< better than its last point
};

/// The number of plain samples with the same error.
struct EquivalentSamples {
  double spp = 1;  ///< samples per pixel; beside the curve those of its end: fewer (below) or more (above) than that
  CurveSide side = CurveSide::within;
};

/// Whether the timed frames include the rebuild of a method's maps.
enum class BuildTiming {
  every_frame,  ///< every frame rebuilds them
  reused        ///< the frames reuse maps that were built before them
};

/// The words for it in reports.
inline constexpr std::array<Word<BuildTiming>, 2> build_timing_words{{
    {BuildTiming::every_frame, "every frame"},
    {BuildTiming::reused, "reused"},
}};
constexpr const auto& words_of(BuildTiming /*timing*/) { return build_timing_words; }

/// Median with its spread over the repeats of one run.
struct FrameTime {
  double median = 0, min = 0, p90 = 0;  ///< milliseconds
};
void fields(auto& archive, Is<FrameTime> auto& value) {
  archive("median", value.median);
  archive("min", value.min);
  archive("p90", value.p90);
}

/// Frame time over `direct`'s, pair by pair: the median, and the 95% interval of that median (median_interval).
struct TimeRatio {
  double median = 0, low = 0, high = 0;
};
void fields(auto& archive, Is<TimeRatio> auto& value) {
  archive("median", value.median);
  archive("low", value.low);
  archive("high", value.high);
}

/// The causes of an error: normalised colour errors over parts of the object's pixels; metrics.md. None: no such
/// pixel, or its image was not rendered.
struct ErrorCauses {
  std::optional<double> shading;        ///< of the picture, over interior pixels: what methods are ranked by
  std::optional<double> shading_floor;  ///< what the reference's own noise causes there
  std::optional<double> shading_noise;  ///< standard error of `shading`, of the reference's noise
  std::optional<double> edges;          ///< of the picture, over all other object pixels
  std::optional<double> filter = {};    ///< of `exact` under the same footprint filter, over the bound's pixels
  std::optional<double> method = {};    ///< of the picture against that of `exact`, over the same
  std::optional<double> light;          ///< of the lookup of an environment by lobes, over the pixels for light
};
void fields(auto& archive, Is<ErrorCauses> auto& value) {
  archive("shading", value.shading);
  archive("shading_floor", value.shading_floor);
  archive("shading_noise", value.shading_noise);
  archive("edges", value.edges);
  archive("filter", value.filter);
  archive("method", value.method);
  archive("light", value.light);
}

/// How many pixels errors are taken over.
struct PixelCounts {
  std::size_t object = 0;            ///< that the reference covers wholly, and resolves
  std::size_t unresolved = 0;        ///< that it covers wholly and does not: they are left out of every figure
  std::size_t interior = 0;          ///< of those, in which it sees one smooth piece of surface
  std::size_t minified = 0;          ///< of the interior ones, whose footprint spans more than a texel of a normal map
  std::optional<std::size_t> bound;  ///< of those, that `exact` was drawn of; none: it was not drawn
  std::optional<std::size_t> light;  ///< of those, that were lit by all of an environment; none without one
};
void fields(auto& archive, Is<PixelCounts> auto& value) {
  archive("object", value.object);
  archive("unresolved", value.unresolved);
  archive("interior", value.interior);
  archive("minified", value.minified);
  archive("bound", value.bound);
  archive("light", value.light);
}

/// Errors of one picture; metrics.md. Absent and infinite figures are null in the JSON and "n/a" in tables.
struct RecordError : ErrorFigures {
  std::optional<double> noise_floor = {};  ///< normalised colour error that the reference's own noise causes
  /// Normalised colour errors: of the method's finest level, supersampled, and against it. None: it was not drawn.
  std::optional<double> representation = {}, filtering = {};
  ErrorCauses causes = {};
};

/// The causes of flicker, as ErrorCauses has them of errors. None: no such pixel in both frames, or its image was
/// not drawn.
struct FlickerCauses {
  std::optional<FlickerFigures> shading;  ///< over pixels that are interior in both frames
  std::optional<FlickerFigures> edges;    ///< over the object's other pixels
  std::optional<FlickerFigures> filter =
      {};  ///< of `exact` under the same footprint filter, over its pixels in both frames
  std::optional<FlickerFigures> method = {};  ///< of the picture against that of `exact`, over the same
};
void fields(auto& archive, Is<FlickerCauses> auto& value) {
  archive("shading", value.shading);
  archive("edges", value.edges);
  archive("filter", value.filter);
  archive("method", value.method);
}

/// The change of an image from frame to frame that the reference does not have; metrics.md.
struct Flicker {
  double mean = 0;                         ///< over the object's pixels, 0 to 2
  double p99 = 0;                          ///< 99th percentile over them
  std::optional<double> noise_floor = {};  ///< the mean that the references' own noise causes
  std::optional<double> ghosting = {};     ///< error where the reference got darker (trailing_edges); none: nowhere
  FlickerCauses causes = {};
};
void fields(auto& archive, Is<Flicker> auto& value) {
  archive("mean", value.mean);
  archive("p99", value.p99);
  archive("noise_floor", value.noise_floor);
  archive("ghosting", value.ghosting);
  fields(archive, value.causes);
}

/// The error against another reference, of another count of samples.
struct OtherReference {
  int spp = 1;
  double normalized_color = 0;
  std::optional<double> noise_floor = {};
};
void fields(auto& archive, Is<OtherReference> auto& value) {
  archive("spp", value.spp);
  archive("normalized_color", value.normalized_color);
  archive("noise_floor", value.noise_floor);
}

/// Pictures of one record, as paths relative to the output folder.
struct RecordImages {
  std::string color;           ///< EXR, with STEM.png and STEM_values.js (renderer/image/pixel_script.hpp)
  std::string reference;       ///< EXR, with the same two
  std::string error;           ///< PNG, false colour on the scale of its distance
  std::string error_shared;    ///< the same on the scale that all distances share
  std::string flip;            ///< PNG, LDR-FLIP in false colour from 0 to 1
  std::string interior;        ///< EXR, white where a pixel is interior, with a .png
  std::string standard_error;  ///< EXR, the reference's own in each pixel and channel
};
void fields(auto& archive, Is<RecordImages> auto& value) {
  archive("color", value.color);
  archive("reference", value.reference);
  archive("error", value.error);
  archive("error_shared", value.error_shared);
  archive("flip", value.flip);
  archive("interior", value.interior);
  archive("standard_error", value.standard_error);
}

/// The error of one picture over the interior pixels that show one material.
struct MaterialError {
  std::string material;
  std::size_t pixels = 0;
  std::optional<double> shading;  ///< as ErrorCauses has it; none: no such pixel
  std::optional<double> noise;    ///< its standard error, of the reference's noise
  std::uint64_t bytes = 0;        ///< that the method baked of the material
};
void fields(auto& archive, Is<MaterialError> auto& value) {
  archive("material", value.material);
  archive("pixels", value.pixels);
  archive("shading", value.shading);
  archive("noise", value.noise);
  archive("bytes", value.bytes);
}

/// One method in one view.
struct Record {
  std::string scene;
  std::string method;                                                ///< the method as written, options included
  std::map<std::string, std::variant<double, std::string>> options;  ///< every option, defaults filled in
  std::optional<HistorySettings> history = {};                       ///< none: images are single frames
  double distance = 1;
  double degrees = 0;  ///< that camera or lights have turned by since the first frame of an animation
  double seconds = 0;  ///< time of the model file's animation, where a path follows it
  int frame = 0;
  int width = 0, height = 0;
  std::optional<std::string> failure = {};  ///< why the method has no figures here; none: it was drawn and measured
  PixelCounts pixels;
  std::optional<RecordError> error;              ///< none: the object covers no whole pixel, or there is a failure
  std::optional<EquivalentSamples> equivalent;   ///< none: no error, or no curve
  std::vector<OtherReference> other_references;  ///< none without an error
  std::optional<Flicker> flicker;                ///< none: no frame of a path, or its first
  /// Exposed luminance above 0.8, mean over the object's pixels. None: no error.
  std::optional<double> highlight_energy = {}, reference_highlight_energy = {};
  std::string node = {};  ///< the machine that the times below were taken on
  FrameTime frame_ms;
  std::optional<double> frame_build_ms;    ///< median time to rebuild the method's maps; none: it rebuilds nothing
  std::optional<BuildTiming> frame_build;  ///< whether `frame_ms` includes that time; none: it rebuilds nothing
  double fps = 0;                          ///< 1000 / frame_ms.median
  TimeRatio ratio_to_direct;
  std::optional<double> fetches;         ///< texture lookups per pixel, mean over the object; none: not counted
  std::optional<double> lobes;           ///< lobes per pixel over all lights, mean over the object; none: not counted
  std::vector<GpuCost> gpu_costs = {};   ///< estimates for the GPUs of the run's settings
  std::vector<MaterialError> materials;  ///< in the order of the scene; empty if the run does not separate them
  double precompute_seconds = 0;
  std::uint64_t precompute_bytes = 0;
  std::optional<double> precompute_bytes_per_texel;  ///< over the finest level's texels; none: no texture
  bool precompute_cached = false;
  std::vector<std::string> effects_on;
  std::vector<std::string> effects_left_out;
  RecordImages images;
};

/// Two methods at one distance, pixel by pixel.
struct MethodPair {
  double distance = 1;
  std::array<std::string, 2> methods;  ///< as written
  std::array<double, 2> closer{};  ///< share of interior pixels in which that one is closer to the reference by more
                                   ///< than the reference's noise explains; in the rest noise decides
  /// The shares of `closer` over the interior pixels of each material; empty if the run does not separate them.
  std::vector<std::array<double, 2>> materials{};
  std::string picture;  ///< of that over the object, PNG: blue the first, orange the second, grey neither
};
void fields(auto& archive, Is<MethodPair> auto& value) {
  archive("distance", value.distance);
  archive("methods", value.methods);
  archive("closer", value.closer);
  archive("materials", value.materials);
  archive("picture", value.picture);
}

/// The mean of so many frames of `direct`, at one distance; that of one is the frame at pixel centres.
struct SupersamplingPoint {
  double distance = 1;
  int spp = 1;
  std::optional<double> normalized_color;
  std::optional<double> shading;  ///< over interior pixels
  double ms = 0;
  std::string node = {};  ///< the machine that it was timed on
};
void fields(auto& archive, Is<SupersamplingPoint> auto& value) {
  archive("distance", value.distance);
  archive("spp", value.spp);
  archive("normalized_color", value.normalized_color);
  archive("shading", value.shading);
  archive("ms", value.ms);
  archive("node", value.node);
}

/// The upper end of the scale of a distance's false-colour images.
struct ErrorScale {
  double distance = 1;
  double error = 0;  ///< normalised colour error
};
void fields(auto& archive, Is<ErrorScale> auto& value) {
  archive("distance", value.distance);
  archive("error", value.error);
}

/// The effective NDF of one footprint by one method, beside the exact one (renderer/ndf).
struct FootprintNdf {
  std::string footprint;  ///< its name
  std::string method;     ///< as written
  double l2 = 0;          ///< relative L2 error over solid angle
  double energy = 0;      ///< over the exact NDF's
  double peak = 0;        ///< largest density, per steradian
  int lobes = 0;          ///< evaluated per pixel
  std::string picture;    ///< of all methods and the exact NDF, PNG, from the output folder
};
void fields(auto& archive, Is<FootprintNdf> auto& value) {
  archive("footprint", value.footprint);
  archive("method", value.method);
  archive("l2", value.l2);
  archive("energy", value.energy);
  archive("peak", value.peak);
  archive("lobes", value.lobes);
  archive("picture", value.picture);
}

/// A figure of a method that no image shows, by its name in an experiment.
struct QuantityFigure {
  std::string name;      ///< in the experiment
  std::string method;    ///< as written
  std::string quantity;  ///< what the method calls it
  double value = 0;
};
void fields(auto& archive, Is<QuantityFigure> auto& value) {
  archive("name", value.name);
  archive("method", value.method);
  archive("quantity", value.quantity);
  archive("value", value.value);
}

/// The verdict on a claim, measured or expected.
enum class Verdict {
  reproduced,
  not_reproduced,
  undecided  ///< a figure is missing, or its figures decide nothing
};

/// The words for it in reports.
inline constexpr auto verdict_words = std::to_array<Word<Verdict>>({{Verdict::reproduced, "reproduced"},
                                                                    {Verdict::not_reproduced, "not_reproduced"},
                                                                    {Verdict::undecided, "undecided"}});
constexpr const auto& words_of(Verdict /*verdict*/) { return verdict_words; }

/// Whose statement a claim is. Only a paper's own count as reproduced or not; the others are counted apart.
enum class ClaimSource {
  paper,        ///< the paper says or shows it
  gpu_time,     ///< the paper says it of times on a GPU; only a GPU of that class decides it
  closed_form,  ///< a formula of the paper, evaluated
  our_measure,  ///< the paper says it, but the measure, the setting or the limit is our choice
  ours          ///< no paper says it
};

/// The words for it in experiment files and reports, the paper's own first.
inline constexpr auto claim_source_words = std::to_array<Word<ClaimSource>>({{ClaimSource::paper, "paper"},
                                                                             {ClaimSource::gpu_time, "gpu_time"},
                                                                             {ClaimSource::closed_form, "closed_form"},
                                                                             {ClaimSource::our_measure, "our_measure"},
                                                                             {ClaimSource::ours, "ours"}});
constexpr const auto& words_of(ClaimSource /*source*/) { return claim_source_words; }

/// A figure that a paper prints, and the one that was measured.
struct PublishedFigure {
  std::string figure;   ///< where it is printed: "Figure 4"
  std::string measure;  ///< the expression that was measured: "error(tan_gmm, spp=16)"
  std::string unit;     ///< "fps", "s"; empty for errors and ratios
  double published = 0;
  std::optional<double> measured = {};
  std::string note;  ///< how the paper measured, or why it is not measured here
};
void fields(auto& archive, Is<PublishedFigure> auto& value) {
  archive("figure", value.figure);
  archive("measure", value.measure);
  archive("unit", value.unit);
  archive("published", value.published);
  archive("measured", value.measured);
  archive("note", value.note);
}

/// A figure that a claim was decided by.
struct ClaimFigure {
  std::string measure;
  double value = 0;
  bool at_noise_floor = false;  ///< an error that the reference's own noise explains
};
void fields(auto& archive, Is<ClaimFigure> auto& value) {
  archive("measure", value.measure);
  archive("value", value.value);
  archive("at_noise_floor", value.at_noise_floor);
}

/// The outcome of a claim.
struct ClaimOutcome {
  std::string name, text;
  ClaimSource source = ClaimSource::ours;
  std::string inequality;
  Verdict expect = Verdict::reproduced;
  Verdict outcome = Verdict::undecided;
  std::string reason;         ///< why that is expected
  std::string problem;        ///< which figure is missing; empty: none
  std::string undecidable{};  ///< why its figures decide nothing here; empty: they decide it
  std::optional<double> left, right;
  std::vector<ClaimFigure> figures;
  std::string place{};  ///< FILE:LINE of the claim

  /// Figures that decide nothing are no failure, missing ones are. `undecided` expects nothing of a GPU that decides.
  [[nodiscard]] bool as_expected() const {
    return problem.empty() && (outcome == expect || !undecidable.empty() || expect == Verdict::undecided);
  }
};

/// A claim over times, decided by estimated cost in place of measured times (gpu-cost.md). It is never expected or
/// counted with the claims.
struct SecondVerdict {
  std::string claim;  ///< its name
  std::string gpu;
  std::optional<double> left, right;
  Verdict outcome = Verdict::undecided;
  std::string problem;  ///< of an undecided one
};
void fields(auto& archive, Is<SecondVerdict> auto& value) {
  archive("claim", value.claim);
  archive("gpu", value.gpu);
  archive("left", value.left);
  archive("right", value.right);
  archive("outcome", value.outcome);
  archive("problem", value.problem);
}

/// An upper bound and what was measured.
struct ThresholdOutcome {
  std::string measure;
  double limit = 0;
  std::optional<double> measured;
  std::string problem;  ///< why it was not measured, or empty
  std::string place{};  ///< FILE:LINE of the threshold

  [[nodiscard]] bool passed() const { return measured && *measured <= limit; }
};

/// The part of results.json that an experiment adds.
struct ExperimentReport {
  std::string name, title, description;
  std::string file;    ///< the TOML, as given
  bool quick = false;  ///< smaller than the file says: the figures are no measurement
  std::vector<PublishedFigure> published = {};
  std::vector<ClaimOutcome> claims = {};
  std::vector<SecondVerdict> second_verdicts = {};
  std::vector<ThresholdOutcome> thresholds = {};
  std::vector<std::string> pictures = {};  ///< composed figures, paths from the output folder

  /// Claims and thresholds that did not come out as they should, one line each.
  [[nodiscard]] std::vector<std::string> shortfalls() const;
};
void fields(auto& archive, Is<ExperimentReport> auto& value) {
  archive("name", value.name);
  archive("title", value.title);
  archive("description", value.description);
  archive("file", value.file);
  archive("quick", value.quick);
  archive("published", value.published);
  archive("claims", value.claims);
  archive("second_verdicts", value.second_verdicts);
  archive("thresholds", value.thresholds);
  archive("pictures", value.pictures);
}

struct ToolInfo {
  std::string name = "footprint";
  std::string version;
};
void fields(auto& archive, Is<ToolInfo> auto& value) {
  archive("name", value.name);
  archive("version", value.version);
}

struct BackendInfo {
  std::string name;      ///< egl, egl-device, osmesa
  std::string renderer;  ///< GL_RENDERER
  std::string version;   ///< GL_VERSION
  std::string cpu = {};  ///< processor model and core count: times mean nothing without them
};
void fields(auto& archive, Is<BackendInfo> auto& value) {
  archive("name", value.name);
  archive("renderer", value.renderer);
  archive("version", value.version);
  archive("cpu", value.cpu);
}

struct SceneInfo {
  std::string name, source;
  std::size_t triangles = 0, materials = 0, lights = 0;
  double exposure = 1;
  std::string exposure_source;        ///< "scene", "automatic", "command line" or "experiment"
  std::vector<std::string> defaults;  ///< what was supplied because the input has none
  std::vector<std::string> warnings;  ///< what the input has and the run left out
};
void fields(auto& archive, Is<SceneInfo> auto& value) {
  archive("name", value.name);
  archive("source", value.source);
  archive("triangles", value.triangles);
  archive("materials", value.materials);
  archive("lights", value.lights);
  archive("exposure", value.exposure);
  archive("exposure_source", value.exposure_source);
  archive("defaults", value.defaults);
  archive("warnings", value.warnings);
}

struct ReferenceInfo {
  int spp = 0;
  std::string filter;  ///< after_shading, nearest, bilinear
  std::uint64_t seed = 0;
  /// In each view: root mean square of the per-pixel standard error over mean radiance; none: unknown.
  std::vector<std::optional<double>> standard_errors = {};
  double samples = 0;  ///< mean samples per pixel over all distances: `spp`, and more if the noise needs them
  double seconds = 0;  ///< that its pictures took, all distances together
  std::optional<std::string> environment = {};  ///< sampled or dense; none: the scene has no environment
};
void fields(auto& archive, Is<ReferenceInfo> auto& value) {
  archive("spp", value.spp);
  archive("filter", value.filter);
  archive("seed", value.seed);
  archive("standard_errors", value.standard_errors);
  archive("samples", value.samples);
  archive("seconds", value.seconds);
  archive("environment", value.environment);
}

/// The repeats behind the medians of frame times.
struct TimingInfo {
  int frames = 0;     ///< of each method and distance in each process, those of all methods in turn
  int processes = 0;  ///< one after the other
};
void fields(auto& archive, Is<TimingInfo> auto& value) {
  archive("frames", value.frames);
  archive("processes", value.processes);
}

/// The way of an animation.
struct AnimationInfo {
  std::string path;                                ///< zoom, orbit, light or animation
  std::optional<std::array<double, 3>> axis = {};  ///< of the rotation, unit, in world space; none: nothing turns
};
void fields(auto& archive, Is<AnimationInfo> auto& value) {
  archive("path", value.path);
  archive("axis", value.axis);
}

/// The coordinates of a member of a [matrix]: each axis with its value, as the file writes them.
using Coordinates = std::vector<std::pair<std::string, std::string>>;

/// A whole run.
struct Results {
  ToolInfo tool;
  BackendInfo backend;
  SceneInfo scene;
  ReferenceInfo reference;
  std::string footprint;  ///< the footprint filter, as parse_footprint_filter reads it
  TimingInfo timing;
  std::optional<AnimationInfo> animation = {};  ///< none: not an animation
  std::optional<std::string> film = {};         ///< video of its frames, from the output folder; none: not requested
  std::vector<SupersamplingPoint> supersampling;
  std::vector<Record> records;
  std::vector<MethodPair> pairs;               ///< every two methods of a distance
  std::vector<FootprintNdf> ndf;               ///< empty where no footprint was looked into
  std::vector<QuantityFigure> quantities;      ///< empty if none was requested
  std::optional<ExperimentReport> experiment;  ///< none: a plain comparison
  Coordinates coordinates{};                   ///< in the matrix that it is a member of; empty: of none
  double error_scale = 0;                      ///< at the top of the false-colour pictures on the shared scale
  std::vector<ErrorScale> error_scales;        ///< of the pictures on the scale of their distance
  std::vector<std::string> files{};            ///< every image that was written, from the output folder, sorted
};

}  // namespace footprint
