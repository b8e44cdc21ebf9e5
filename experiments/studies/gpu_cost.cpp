// Counts loops and lookups on the software renderer, compiles each program with constant loops, and combines both.
#include "experiments/studies/gpu_cost.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/studies/frame_setup.hpp"
#include "experiments/studies/report_facts.hpp"
#include "renderer/core/error.hpp"
#include "renderer/scene/assembly/load_scene.hpp"

namespace footprint {
namespace {

constexpr int most_unrolled_lights = 4;  // of a kind; further ones cost what the last one adds

// The constant numbers of rounds of a frame's programs, and how often each counts: one with a single round per loop,
// and one per kind of loop with one round more. Rounds find the lobes that a loop over lobes reads, so a further lobe
// is counted where there is a further round: a compiler may drop all that depends on a lobe that nothing writes.
std::vector<std::pair<FixedTrips, double>> weighed_trips(const PixelTrips& trips, const GpuScene::LightCounts& lights) {
  const auto unrolled = [](std::size_t count) { return std::clamp(static_cast<int>(count), 1, most_unrolled_lights); };
  FixedTrips base;
  std::ranges::transform(lights.of, base.lights.begin(), unrolled);
  std::vector<std::pair<FixedTrips, double>> programs{{base, 1.0}};
  // `further` times what one round more of a loop adds to the program `from`. Returns the longer program.
  const auto add = [&](std::size_t from, int FixedTrips::*loop, double further) {
    if (further <= 0) return from;
    FixedTrips longer = programs[from].first;
    ++(longer.*loop);
    programs[from].second -= further;
    programs.emplace_back(longer, further);
    return programs.size() - 1;
  };
  add(0, &FixedTrips::probes, trips.probes - 1);
  const std::size_t rounds = add(0, &FixedTrips::rounds, trips.rounds - 1);
  add(rounds, &FixedTrips::lobes, trips.lobes - 1);
  for (std::size_t i = 0; i < light_types.size(); ++i) {
    const double further = static_cast<double>(lights.of.at(i)) - base.lights.at(i);
    if (further <= 0) continue;
    programs.front().second -= further;
    programs.emplace_back(base, further);
    ++programs.back().first.lights.at(i);
  }
  return programs;
}

// Reads the textures 0 and 1: its code tells how far apart a driver puts two descriptors.
GlslProgram calibration() {
  return {.name = "calibration",
          .vertex = "#version 450 core\nvoid main() { gl_Position = vec4(0.0); }\n",
          .fragment =
              "#version 450 core\n"
              "layout(binding = 0) uniform sampler2D first;\nlayout(binding = 1) uniform sampler2D second;\n"
              "layout(location = 0) out vec4 color;\n"
              "void main() { color = textureLod(first, gl_FragCoord.xy, 0.0) + "
              "textureLod(second, gl_FragCoord.yx, 0.0); }\n"};
}

// Whether samples of a method's map read its finest level whatever the footprint, because it has no other.
bool has_one_level(const BakedMethod& baked, const ReadTexture& texture) {
  return std::ranges::any_of(baked.materials.front().textures, [&](const PrefilteredTexture& map) {
    return map.name == texture.name && map.filter != TextureFilter::linear && map.levels.size() == 1 && map.layers <= 1;
  });
}

std::map<int, ReadTexture> textures_of(const FrameRenderer& frames, const BakedMethod& baked) {
  std::map<int, ReadTexture> textures = frames.program().bound_textures();
  for (auto& [unit, texture] : textures) {
    if (has_one_level(baked, texture)) texture.finest_texels = 8.0 * texture.bytes / texture.bits;
  }
  return textures;
}

CostedProgram program_of(const RecordedDraw& draw) {
  return {.vertex = draw.vertex, .fragment = draw.fragment, .targets = draw.targets};
}

double written_bytes(const RecordedDraw& draw) {
  double bytes = 0;
  for (const ColorTarget& target : draw.targets) bytes += target.bytes();
  return bytes;
}

bool is_copy(const RecordedDraw& draw) { return draw.fragment.empty(); }

// The programs of the forward pass and of the passes before it.
std::vector<CostedProgram> programs_of(const CostedFrame& frame) {
  std::vector<CostedProgram> programs;
  for (const auto& [program, weight] : frame.programs) programs.push_back(program);
  for (const RecordedDraw& draw : frame.passes) {
    if (!is_copy(draw)) programs.push_back(program_of(draw));
  }
  return programs;
}

void set_statistics(GpuCost& cost, const CompiledStage& stage) {
  const auto figure = [&](const char* name) {
    const auto found = stage.statistics.find(name);
    return found == stage.statistics.end() ? 0 : static_cast<int>(found->second);
  };
  constexpr double pixels_of_a_wave = 64;
  cost.issue_clocks = figure("Inverse Throughput") / pixels_of_a_wave;
  cost.instructions = figure(instructions_statistic);
  cost.vertex_instructions = static_cast<int>(stage.vertex_instructions);
  cost.registers = figure("VGPRs");
  cost.waves = figure("Subgroups per SIMD");
  cost.shader_bytes = figure("Code size");
  cost.scratch_bytes = figure("Scratch size");
  cost.compile_seconds = stage.seconds;
}

// A method and its footprint filter, on which its programs depend.
std::string name_of(const StagedMethod& method) {
  return fmt::format("{}, {}", method.text(), footprint_filter_text(method.filter()));
}

// The row of a method without figures.
MethodCosts failed_costs(const MethodSpec& method, const std::vector<std::string>& gpus, const Error& why) {
  MethodCosts costs;
  costs.method = method.text;
  for (const Chip* chip : chips_named("--gpu", gpus)) {
    costs.gpus.emplace_back().gpu = chip->name;
    costs.gpus.back().failure = why.what();
  }
  return costs;
}

double first_distance(const ViewSettings& view) { return view.distances.empty() ? 1.0 : view.distances.front(); }

}  // namespace

GpuCosts::GpuCosts(const Stage& stage, const std::vector<std::string>& gpus, GpuCompiler compile)
    : stage_(stage), compile_(std::move(compile)) {
  const GlslProgram program = calibration();
  for (const Chip* chip : chips_named("--gpu", gpus)) {
    const ChipOutcomes outcomes = compile_(*chip, {&program, 1}, no_progress);
    const CompileOutcome& outcome = outcomes.programs.front();
    compiler_ = outcomes.device.substr(0, outcomes.device.rfind(' '));
    chips_.push_back({.chip = chip,
                      .failure = outcome.failure,
                      .between_descriptors = outcome.stage ? descriptor_bytes(outcome.stage->code) : 0});
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
  costs.method = method.text();
  const PixelTrips trips = pixel_trips(stage_.counting_frames(method, Counting::trips), view);
  costs.trips = {.probes = trips.probes, .lobes = trips.lobes, .rounds = trips.rounds};
  const FrameRenderer counting = stage_.counting_frames(method, Counting::work);
  const PixelWork work = pixel_work(counting, view);
  costs.lookups = work.lookups;
  costs.pixels = work.pixels;
  costs.map_bytes = static_cast<double>(method.baked().bytes);
  const CostedFrame frame{.name = name_of(method),
                          .programs = weighed_programs(method, trips),
                          .textures = textures_of(counting, method.baked()),
                          .passes = method.gpu().draws_per_frame(view),
                          .work = work};
  ProgressParts parts(progress, static_cast<double>(chips_.size()));
  for (CompilingChip& chip : chips_) {
    compile_missing(chip, frame, parts.next(1, costs.method + ", "));
    costs.gpus.push_back(cost_of(chip, frame));
  }
  return costs;
}

std::vector<std::pair<CostedProgram, double>> GpuCosts::weighed_programs(const StagedMethod& method,
                                                                         const PixelTrips& trips) const {
  std::vector<std::pair<CostedProgram, double>> programs;
  for (const auto& [rounds, weight] : weighed_trips(trips, stage_.gpu_scene().light_counts())) {
    const ForwardShaders shaders = stage_.program_for_cost(method, rounds).shaders;
    programs.emplace_back(CostedProgram{.vertex = shaders.vertex, .fragment = shaders.fragment.text()}, weight);
  }
  return programs;
}

void GpuCosts::compile_missing(CompilingChip& chip, const CostedFrame& frame, const Progress& progress) {
  if (!chip.failure.empty()) return;
  std::vector<GlslProgram> missing;
  std::vector<CompileOutcome*> places;
  for (const CostedProgram& program : programs_of(frame)) {
    const auto [place, is_new] = chip.compiled.try_emplace(program);
    if (!is_new) continue;
    missing.push_back({frame.name, program.vertex, program.fragment, program.targets});
    places.push_back(&place->second);
  }
  if (missing.empty()) return;
  ChipOutcomes outcomes = compile_(*chip.chip, missing, progress);
  for (std::size_t i = 0; i < places.size(); ++i) *places[i] = std::move(outcomes.programs.at(i));
}

GpuCost GpuCosts::cost_of(const CompilingChip& chip, const CostedFrame& frame) {
  GpuCost cost;
  cost.gpu = chip.chip->name;
  if (!chip.failure.empty()) {
    cost.failure = chip.failure;
    return cost;
  }
  for (const CostedProgram& program : programs_of(frame)) {
    const CompileOutcome& outcome = chip.compiled.at(program);
    if (outcome.stage) continue;
    cost.failure = outcome.failure;
    return cost;
  }
  std::vector<WeighedWork> works;
  for (const auto& [program, weight] : frame.programs)
    works.push_back({weight, shader_work(chip.compiled.at(program).stage->code, chip.between_descriptors)});
  cost = estimate(*chip.chip, works, frame.work.lookups, frame.textures, frame_pixel_bytes, frame.work.finest_areas);
  if (cost.failure) return cost;
  set_statistics(cost, *chip.compiled.at(frame.programs.front().first).stage);
  if (frame.work.pixels > 0) cost.passes_ns = passes_ns(chip, frame) / frame.work.pixels;
  cost.cost_ns += cost.passes_ns;
  return cost;
}

// The passes of one frame: one after the other, because each reads what the one before has written.
double GpuCosts::passes_ns(const CompilingChip& chip, const CostedFrame& frame) {
  std::map<CostedProgram, ShaderWork> works;
  double sum = 0;
  for (const RecordedDraw& draw : frame.passes) {
    if (is_copy(draw)) {
      sum += copy_ns(*chip.chip, draw.pixels * written_bytes(draw));
      continue;
    }
    const auto [work, is_new] = works.try_emplace(program_of(draw));
    if (is_new) work->second = shader_work(chip.compiled.at(work->first).stage->code, chip.between_descriptors);
    const GpuCost pixel = estimate(*chip.chip, {{1.0, work->second}}, draw.lookups, draw.textures, written_bytes(draw));
    sum += draw.pixels * pixel.cost_ns;
  }
  return sum;
}

CostReport estimate_costs(const RunSettings& settings, const GpuCompiler& compile, const Progress& progress) {
  ProgressParts parts(progress, 10);
  const Stage stage(load_scene(settings.scene, settings.scene_library, settings.overrides), settings, parts.next(4, ""),
                    {.records_refusals = true});
  const View view = stage.view(first_distance(settings.view));
  GpuCosts gpus(stage, settings.gpus, compile);
  CostReport report;
  report.backend = backend_info(stage.context().info());
  report.scene = stage.info();
  report.footprint = footprint_filter_text(footprint_filter_of(settings.footprint, stage.scene()));
  report.compiler = gpus.compiler();
  report.size = {view.size.x, view.size.y};
  report.distance = first_distance(settings.view);
  ProgressParts methods(parts.next(6, ""), static_cast<double>(settings.methods.size()));
  for (std::size_t m = 0; m < settings.methods.size(); ++m) {
    const StagedMethod& method = stage.methods()[m];
    const Progress own = methods.next(1, "");
    std::optional<Error> failure = method.refusal();
    if (!failure)
      failure = catch_failure(stage.context(), settings.methods[m],
                              [&] { report.methods.push_back(gpus.costs(method, view, own)); });
    if (failure) report.methods.push_back(failed_costs(settings.methods[m], settings.gpus, *failure));
  }
  return report;
}

}  // namespace footprint
