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

// A program, and how often it counts in a frame (WeighedWork::weight).
struct WeighedProgram {
  FixedTrips trips;
  double weight = 1;
};

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

// A method before any compiler has seen it.
struct CountedMethod {
  MethodCosts costs;
  std::vector<WeighedProgram> weighed;
  std::map<int, TextureCost> textures;
  std::size_t first = 0;               // of its programs among all
  std::optional<std::string> failure;  // before they could be compiled
};

class CostStudy {
 public:
  CostStudy(const RunSettings& settings, const Progress& progress)
      : settings_(settings),
        parts_(progress, 10),
        stage_(load_scene(settings.scene, settings.scene_library, settings.overrides), settings, parts_.next(4, ""),
               pictures_of_a_frame, Unit::none, Refusal::keeps_a_row),
        view_(stage_.view(settings.view.distances.empty() ? 1.0 : settings.view.distances.front())) {
    programs_.push_back(calibration());
    const Progress counting = parts_.next(3, "");
    for (std::size_t m = 0; m < stage_.methods().size(); ++m) {
      counting(settings.methods[m].text, static_cast<double>(m) / static_cast<double>(stage_.methods().size()));
      methods_.push_back(count(stage_.methods()[m], settings.methods[m]));
    }
  }

  CostReport report(std::span<const Chip* const> chips, const GpuCompiler& compile) {
    CostReport report = head();
    ProgressParts compiling(parts_.next(3, ""), static_cast<double>(chips.size()));
    for (const Chip* chip : chips) {
      const ChipOutcomes outcomes = compile(*chip, programs_, compiling.next(1, ""));
      report.compiler = outcomes.device.substr(0, outcomes.device.rfind(' '));
      const int between = between_descriptors(outcomes);
      for (CountedMethod& method : methods_) method.costs.gpus.push_back(cost_of(method, *chip, outcomes, between));
    }
    for (CountedMethod& method : methods_) report.methods.push_back(std::move(method.costs));
    return report;
  }

 private:
  CountedMethod count(const StagedMethod& staged, const MethodSpec& spec) {
    CountedMethod counted;
    counted.costs.method = spec.text;
    std::optional<Error> failure = staged.refusal();
    if (!failure) failure = failure_of(stage_.context(), spec, [&] { count_work(staged, counted); });
    if (failure) counted.failure = failure->what();
    return counted;
  }

  void count_work(const StagedMethod& staged, CountedMethod& counted) {
    const PixelTrips trips = pixel_trips(stage_.counting_frames(staged, Counting::trips), view_);
    counted.costs.trips = {trips.probes, trips.lobes, trips.rounds};
    const FrameRenderer work = stage_.counting_frames(staged, Counting::work);
    counted.costs.lookups = pixel_work(work, view_).lookups;
    counted.textures = costs_of(work.program().bound_textures());
    counted.costs.map_bytes = static_cast<double>(staged.baked().bytes);
    counted.weighed = weighed_programs(trips, stage_.gpu_scene().light_counts());
    counted.first = programs_.size();
    for (const WeighedProgram& one : counted.weighed) {
      const ForwardProgram program = stage_.program_for_cost(staged, one.trips);
      programs_.push_back(spirv_program(counted.costs.method, program.shaders.vertex, program.shaders.fragment.text()));
    }
  }

  static int between_descriptors(const ChipOutcomes& outcomes) {
    const CompileOutcome& first = outcomes.programs.front();
    if (!first.stage) throw Error(ErrorKind::machine, "--gpu", first.failure);
    return descriptor_bytes(first.stage->code);
  }

  static GpuCost cost_of(const CountedMethod& method, const Chip& chip, const ChipOutcomes& outcomes, int between) {
    GpuCost cost;
    cost.gpu = chip.name;
    cost.failure = method.failure;
    std::vector<WeighedWork> works;
    for (std::size_t i = 0; i < method.weighed.size() && !cost.failure; ++i) {
      const CompileOutcome& outcome = outcomes.programs.at(method.first + i);
      if (!outcome.stage) {
        cost.failure = outcome.failure;
      } else {
        works.push_back({method.weighed[i].weight, shader_work(outcome.stage->code, between)});
      }
    }
    if (cost.failure) return cost;
    set_statistics(cost, *outcomes.programs.at(method.first).stage);
    set_estimate(cost, estimate(chip, works, method.costs.lookups, method.textures));
    return cost;
  }

  static void set_statistics(GpuCost& cost, const CompiledStage& stage) {
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

  static void set_estimate(GpuCost& cost, const CostEstimate& estimate) {
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

  [[nodiscard]] CostReport head() const {
    CostReport report;
    report.backend = backend_info(stage_.context().info());
    report.scene = stage_.info({});
    report.footprint = footprint_filter_text(footprint_filter_of(settings_, stage_.scene()));
    report.width = view_.size.x;
    report.height = view_.size.y;
    report.distance = settings_.view.distances.empty() ? 1.0 : settings_.view.distances.front();
    return report;
  }

  const RunSettings& settings_;
  ProgressParts parts_;
  Stage stage_;
  View view_;
  std::vector<SpirvProgram> programs_;
  std::vector<CountedMethod> methods_;
};

}  // namespace

CostReport estimate_costs(const RunSettings& settings, std::span<const Chip* const> chips, const GpuCompiler& compile,
                          const Progress& progress) {
  return CostStudy(settings, progress).report(chips, compile);
}

}  // namespace footprint
