// Counts loops and lookups on the software renderer, compiles each program with constant loops, and combines both.
#include "experiments/studies/gpu_cost.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/studies/run_info.hpp"
#include "experiments/studies/stage.hpp"
#include "renderer/core/error.hpp"
#include "renderer/gpu_cost/estimate.hpp"
#include "renderer/scene/assembly/load_scene.hpp"

namespace footprint {
namespace {

constexpr int most_unrolled_lights = 4;  // of a kind; further ones cost what the last one adds

// The programs of a frame: one with a single round per loop, and one per kind of loop with one round more.
std::vector<WeighedProgram> weighed_programs(const PixelTrips& trips, const GpuScene::LightCounts& lights) {
  const auto unrolled = [](std::size_t count) { return std::clamp(static_cast<int>(count), 1, most_unrolled_lights); };
  const FixedTrips base{.probes = 1,
                        .lobes = 1,
                        .rounds = 1,
                        .point_lights = unrolled(lights.point),
                        .spot_lights = unrolled(lights.spot),
                        .directional_lights = unrolled(lights.directional)};
  std::vector<WeighedProgram> programs{{base, 1.0}};
  const auto add = [&](int FixedTrips::*loop, double further) {
    if (further <= 0) return;
    FixedTrips longer = base;
    ++(longer.*loop);
    programs.front().weight -= further;
    programs.push_back({longer, further});
  };
  add(&FixedTrips::probes, trips.probes - 1);
  add(&FixedTrips::lobes, trips.lobes - 1);
  add(&FixedTrips::rounds, trips.rounds - 1);
  add(&FixedTrips::point_lights, static_cast<double>(lights.point) - base.point_lights);
  add(&FixedTrips::spot_lights, static_cast<double>(lights.spot) - base.spot_lights);
  add(&FixedTrips::directional_lights, static_cast<double>(lights.directional) - base.directional_lights);
  return programs;
}

// Reads the textures 0 and 1: its code tells how far apart a driver puts two descriptors.
SpirvProgram calibration() {
  return spirv_program("calibration", "#version 450 core\nvoid main() { gl_Position = vec4(0.0); }\n",
                       "#version 450 core\n"
                       "layout(binding = 0) uniform sampler2D first;\nlayout(binding = 1) uniform sampler2D second;\n"
                       "layout(location = 0) out vec4 color;\n"
                       "void main() { color = textureLod(first, gl_FragCoord.xy, 0.0) + "
                       "textureLod(second, gl_FragCoord.yx, 0.0); }\n");
}

std::map<int, TextureCost> costs_of(const std::vector<BoundTexture>& textures) {
  std::map<int, TextureCost> costs;
  for (std::size_t unit = 0; unit < textures.size(); ++unit) {
    const BoundTexture& texture = textures[unit];
    costs[static_cast<int>(unit)] = {
        .name = texture.name, .bits = texture.bits, .trilinear = texture.trilinear, .bytes = texture.bytes};
  }
  return costs;
}

CompileOutcome no_failure(ChipOutcomes outcomes) {
  if (!outcomes.programs.front().stage) throw Error(ErrorKind::machine, "--gpu", outcomes.programs.front().failure);
  return std::move(outcomes.programs.front());
}

void set_statistics(GpuCost& cost, const CompiledStage& stage) {
  const auto figure = [&](const char* name) {
    const auto found = stage.statistics.find(name);
    return found == stage.statistics.end() ? 0 : static_cast<int>(found->second);
  };
  constexpr double pixels_of_a_wave = 64;
  cost.issue_clocks = figure("Inverse Throughput") / pixels_of_a_wave;
  cost.instructions = figure("Instructions");
  cost.registers = figure("VGPRs");
  cost.waves = figure("Subgroups per SIMD");
  cost.shader_bytes = figure("Code size");
  cost.scratch_bytes = figure("Scratch size");
  cost.compile_seconds = stage.seconds;
}

void set_estimate(GpuCost& cost, const CostEstimate& estimate) {
  cost.cost_ns = estimate.cost_ns();
  cost.bound = word_for(cost_bounds, estimate.bound());
  cost.arithmetic_ns = estimate.arithmetic_ns;
  cost.texture_ns = estimate.texture_ns;
  cost.bandwidth_ns = estimate.bandwidth_ns;
  cost.alu_clocks = estimate.alu_clocks;
  cost.texture_reads = estimate.texture_reads;
  cost.reads_by_format = estimate.reads_by_format;
  cost.bytes_fetched = estimate.bytes_fetched;
  cost.bytes_from_memory = estimate.bytes_from_memory;
  cost.loop_rounds = estimate.loop_rounds;
}

// A method and its footprint filter, on which its programs depend.
std::string name_of(const StagedMethod& method) {
  return fmt::format("{}, {}", method.baked().spec.text, footprint_filter_text(method.filter()));
}

// The row of a method without figures.
MethodCosts failed_costs(const RunSettings& settings, std::size_t method, const Error& why) {
  MethodCosts costs;
  costs.method = settings.methods[method].text;
  for (const Chip* chip : chips_named("--gpu", settings.gpus)) {
    costs.gpus.emplace_back().gpu = chip->name;
    costs.gpus.back().failure = why.what();
  }
  return costs;
}

double distance_of(const RunSettings& settings) {
  return settings.view.distances.empty() ? 1.0 : settings.view.distances.front();
}

}  // namespace

GpuCosts::GpuCosts(const Stage& stage, const std::vector<std::string>& gpus, GpuCompiler compile)
    : stage_(stage), compile_(std::move(compile)) {
  const SpirvProgram program = calibration();
  for (const Chip* chip : chips_named("--gpu", gpus)) {
    ChipOutcomes outcomes = compile_(*chip, {&program, 1}, no_progress);
    compiler_ = outcomes.device.substr(0, outcomes.device.rfind(' '));
    chips_.push_back({.chip = chip,
                      .between_descriptors = descriptor_bytes(no_failure(std::move(outcomes)).stage->code),
                      .compiled = {}});
  }
}

// The unit is `direct` of the stage, if it has one.
MethodCosts GpuCosts::costs(const StagedMethod& method, const View& view, const Progress& progress) {
  MethodCosts costs = own_costs(method, view, progress);
  if (!stage_.has_unit()) return costs;
  const StagedMethod& direct = stage_.methods()[stage_.unit()];
  if (direct.refusal()) return costs;
  if (!unit_ || unit_->first.camera != view.camera || unit_->first.size != view.size)
    unit_.emplace(view, own_costs(direct, view, progress));
  for (std::size_t i = 0; i < costs.gpus.size(); ++i) {
    const double unit_ns = unit_->second.gpus[i].cost_ns;
    if (!costs.gpus[i].failure && unit_ns > 0) costs.gpus[i].ratio_to_direct = costs.gpus[i].cost_ns / unit_ns;
  }
  return costs;
}

MethodCosts GpuCosts::own_costs(const StagedMethod& method, const View& view, const Progress& progress) {
  MethodCosts costs;
  costs.method = method.baked().spec.text;
  const PixelTrips trips = pixel_trips(stage_.counting_frames(method, Counting::trips), view);
  costs.trips = {.probes = trips.probes, .lobes = trips.lobes, .rounds = trips.rounds};
  const FrameRenderer work = stage_.counting_frames(method, Counting::work);
  costs.lookups = pixel_work(work, view).lookups;
  costs.map_bytes = static_cast<double>(method.baked().bytes);
  const std::map<int, TextureCost> textures = costs_of(work.program().bound_textures());
  const std::vector<WeighedProgram> programs = weighed_programs(trips, stage_.gpu_scene().light_counts());
  ProgressParts parts(progress, static_cast<double>(chips_.size()));
  for (CompilingChip& chip : chips_) {
    compile_missing(chip, method, programs, parts.next(1, costs.method + ", "));
    costs.gpus.push_back(cost_of(chip, method, costs.lookups, programs, textures));
  }
  return costs;
}

void GpuCosts::compile_missing(CompilingChip& chip, const StagedMethod& method,
                               const std::vector<WeighedProgram>& programs, const Progress& progress) {
  const std::string text = name_of(method);
  std::vector<SpirvProgram> missing;
  std::vector<CompileOutcome*> places;
  for (const WeighedProgram& one : programs) {
    const auto [place, is_new] = chip.compiled.try_emplace({text, one.trips});
    if (!is_new) continue;
    const ForwardProgram program = stage_.program_for_cost(method, one.trips);
    missing.push_back(spirv_program(text, program.shaders.vertex, program.shaders.fragment.text()));
    places.push_back(&place->second);
  }
  if (missing.empty()) return;
  ChipOutcomes outcomes = compile_(*chip.chip, missing, progress);
  for (std::size_t i = 0; i < places.size(); ++i) *places[i] = std::move(outcomes.programs.at(i));
}

GpuCost GpuCosts::cost_of(const CompilingChip& chip, const StagedMethod& method, double lookups,
                          const std::vector<WeighedProgram>& programs, const std::map<int, TextureCost>& textures) {
  const std::string text = name_of(method);
  GpuCost cost;
  cost.gpu = chip.chip->name;
  std::vector<WeighedWork> works;
  for (const WeighedProgram& one : programs) {
    const CompileOutcome& outcome = chip.compiled.at({text, one.trips});
    if (!outcome.stage) {
      cost.failure = outcome.failure;
      return cost;
    }
    works.push_back({one.weight, shader_work(outcome.stage->code, chip.between_descriptors)});
  }
  set_statistics(cost, *chip.compiled.at({text, programs.front().trips}).stage);
  set_estimate(cost, estimate(*chip.chip, works, lookups, textures));
  return cost;
}

CostReport estimate_costs(const RunSettings& settings, const GpuCompiler& compile, const Progress& progress) {
  ProgressParts parts(progress, 10);
  const Stage stage(load_scene(settings.scene, settings.scene_library, settings.overrides), settings, parts.next(4, ""),
                    pictures_of_a_frame, Unit::none, Refusal::keeps_a_row);
  const View view = stage.view(distance_of(settings));
  GpuCosts gpus(stage, settings.gpus, compile);
  CostReport report;
  report.backend = backend_info(stage.context().info());
  report.scene = stage.info({});
  report.footprint = footprint_filter_text(footprint_filter_of(settings, stage.scene()));
  report.compiler = gpus.compiler();
  report.width = view.size.x;
  report.height = view.size.y;
  report.distance = distance_of(settings);
  ProgressParts methods(parts.next(6, ""), static_cast<double>(settings.methods.size()));
  for (std::size_t m = 0; m < settings.methods.size(); ++m) {
    const StagedMethod& method = stage.methods()[m];
    const Progress own = methods.next(1, "");
    std::optional<Error> failure = method.refusal();
    if (!failure)
      failure = failure_of(stage.context(), settings.methods[m],
                           [&] { report.methods.push_back(gpus.costs(method, view, own)); });
    if (failure) report.methods.push_back(failed_costs(settings, m, *failure));
  }
  return report;
}

}  // namespace footprint
