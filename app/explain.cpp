// `footprint explain`: the effects of a scene with their reasons, its passes, textures and bytes, and their costs.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/commands.hpp"
#include "app/messages.hpp"
#include "app/run_options.hpp"
#include "experiments/studies/frame_times.hpp"
#include "experiments/studies/stage.hpp"
#include "renderer/core/memory.hpp"
#include "renderer/pipeline/timing.hpp"
#include "renderer/scene/assembly/load_scene.hpp"

namespace footprint {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* explain_examples =
    "Examples:\n"
    "  footprint explain model.gltf                 effects with reasons, passes, textures, memory\n"
    "  footprint explain model.gltf --method toksvig --cost\n"
    "  footprint explain model.gltf --json          for programs";

struct ExplainArguments {
  explicit ExplainArguments(CLI::App& command) : run(command) {}

  RunOptions run;
  bool cost = false;
  bool json = false;
  bool quiet = false;
};

// A texture of the method, over all materials.
struct TextureUse {
  std::string name;
  std::size_t bytes = 0;
};

// Bytes of the scene's maps, each once however many materials share it.
struct MapBytes {
  std::size_t decoded = 0;  // as 32-bit floats
  std::size_t stored = 0;   // at their own depth
};

MapBytes map_bytes(const Scene& scene) {
  MapBytes bytes;
  std::set<MapTexels> counted;
  for (const Material& material : scene.materials) {
    for (const TextureMap* map : maps_of(material)) {
      const MapTexels& texels = map->image;
      if (!counted.insert(texels).second) continue;
      bytes.decoded += texels.texel_count() * static_cast<std::size_t>(texels.channels()) * sizeof(float);
      bytes.stored += texels.byte_count();
    }
  }
  return bytes;
}

// The shadow maps, rendered once before the first frame; none if nothing casts a shadow.
struct ShadowPass {
  std::size_t maps = 0, draws = 0, bytes = 0;
  int resolution = 0;
};

// The environment's visibility at the vertices, computed once before the first frame; none if nothing hides it.
struct VisibilityPass {
  std::size_t vertices = 0, bytes = 0;
  double error = 0;  // radians
};

// Milliseconds of a frame with every effect of the scene, and without one of them.
struct EffectCost {
  Effect effect = Effect::diffuse;
  double with_ms = 0, without_ms = 0;  // medians over the repeats
  double added_ms = 0;                 // median of the differences, frame by frame; noise can make it negative
};

// Everything that `explain` reports.
struct Explanation {
  std::vector<ModelChoice> choices;
  std::vector<std::string> warnings, supplied;
  std::vector<EffectDecision> effects;
  MapBytes maps;
  std::string method;
  std::vector<std::string> left_out;  // effects of the scene that the method does not support
  std::size_t draws = 0;              // of the forward pass: one per material
  std::size_t shared_bytes = 0, method_bytes = 0;
  std::vector<TextureUse> textures;
  std::size_t shader_lines = 0;
  std::optional<ShadowPass> shadows;
  std::optional<VisibilityPass> visibility;
  std::vector<EffectCost> costs;
};

EffectCost cost_of(Effect effect, const std::vector<double>& with, const std::vector<double>& without) {
  std::vector<double> added(with.size());
  std::ranges::transform(with, without, added.begin(), std::minus{});
  return {.effect = effect,
          .with_ms = quantile(with, 0.5),
          .without_ms = quantile(without, 0.5),
          .added_ms = quantile(added, 0.5)};
}

// Whether more rounds would change little, because the intervals of all ratios to the first frame are narrow.
bool are_known(const RepeatedTimes& times) {
  return std::ranges::all_of(times, [&](const auto& own) { return is_ratio_known(own, times.front()); });
}

// The scene with some of its effects. The method stores the scene's address.
struct Variant {
  std::unique_ptr<GpuScene> scene;
  StagedMethod method;
};

Variant make_variant(const Stage& stage, const RunSettings& run, const EffectSet& effects, const glm::ivec2& size,
                     const Progress& progress) {
  const gl::ContextInfo& context = stage.context().info();
  auto scene = std::make_unique<GpuScene>(context, stage.scene(), effects, progress, nullptr, &stage.gpu_scene());
  const StagedFrames wanted{.spec = run.methods.front(), .filter = footprint_filter_of(run, stage.scene())};
  StagedMethod method(context, *scene, stage.scene(),
                      prepared_method(*scene, stage.scene(), effects, wanted.spec, run, no_progress), wanted, size,
                      run.backend.tile);
  return {std::move(scene), std::move(method)};
}

// Renders the scene by the stage's first method with all effects and without each one, frames interleaved.
std::vector<EffectCost> measure_effect_costs(const Stage& stage, const RunSettings& run, const Progress& progress) {
  const View view = stage.view(1.0);
  std::vector<Effect> measured;
  std::vector<Variant> variants;
  ProgressParts parts([&](std::string_view what, double done) { progress(what, 0.5 * done); },
                      static_cast<double>(stage.effects().count()));
  for (const Effect effect : all_effects()) {
    if (!has(stage.effects(), effect)) continue;
    measured.push_back(effect);
    const EffectSet remaining = EffectSet(stage.effects()).reset(static_cast<std::size_t>(effect));
    const Progress preparing = parts.next(1, "preparing: ");
    preparing(effect_name(effect), 0.0);
    variants.push_back(make_variant(stage, run, remaining, view.size, preparing));
  }
  std::vector<DrawFrame> frames{[&] { stage.methods().front().frames().draw(view); }};
  for (const Variant& variant : variants) frames.emplace_back([&] { variant.method.frames().draw(view); });
  const auto times = interleaved_times(
      stage.context().info(), frames, run.timing.repeats,
      [&](std::string_view what, double done) { progress(what, 0.5 + 0.5 * done); }, are_known);
  stage.context().check("timing the effects");

  std::vector<EffectCost> costs;
  for (std::size_t i = 0; i < measured.size(); ++i) costs.push_back(cost_of(measured[i], times[0], times[i + 1]));
  return costs;
}

std::vector<TextureUse> texture_uses(const BakedMethod& baked) {
  std::vector<TextureUse> uses;
  for (std::size_t material = 0; material < baked.materials.size(); ++material) {
    const std::vector<PrefilteredTexture>& textures = baked.materials[material].textures;
    for (std::size_t i = 0; i < textures.size(); ++i) {
      auto use = std::ranges::find(uses, textures[i].name, &TextureUse::name);
      if (use == uses.end()) use = uses.insert(uses.end(), {.name = textures[i].name});
      if (!baked.shared.contains({material, i})) use->bytes += byte_count(textures[i]);
    }
  }
  return uses;
}

Explanation explain(const ExplainArguments& arguments, const Progress& progress) {
  const RunSettings run = arguments.run.settings();
  ProgressParts parts(progress, arguments.cost ? 3 : 1);
  const Stage stage(load_scene(run.scene, run.scene_library, run.overrides), run, parts.next(1, ""));
  const StagedMethod& method = stage.methods().front();

  Explanation out;
  out.choices = stage.scene().choices;
  out.warnings = stage.scene().warnings;
  out.supplied = stage.scene().defaults;
  out.effects = stage.decisions();
  out.maps = map_bytes(stage.scene());
  out.method = run.methods.front().text;
  out.left_out = effect_names(stage.effects() & ~method.baked().method->info.honours);
  out.draws = stage.gpu_scene().batches().size();
  out.shared_bytes = stage.gpu_scene().shared_bytes();
  out.method_bytes = method.baked().bytes;
  out.textures = texture_uses(method.baked());
  out.shader_lines = static_cast<std::size_t>(std::ranges::count(method.frames().program().fragment_text(), '\n'));
  if (const auto& maps = stage.gpu_scene().shadow_maps()) {
    out.shadows = {.maps = maps->views().views.size(),
                   .draws = maps->draws(),
                   .bytes = maps->bytes(),
                   .resolution = maps->resolution()};
  }
  if (const GpuVisibility* visibility = stage.gpu_scene().visibility()) {
    out.visibility = {
        .vertices = visibility->vertex_count(), .bytes = visibility->bytes(), .error = visibility->error()};
  }
  if (arguments.cost) out.costs = measure_effect_costs(stage, run, parts.next(2, ""));
  return out;
}

std::string text_of(const ShadowPass& pass) {
  return fmt::format("\nshadow maps, rendered once\n  {:<24} {}\n  {:<24} {} of {}x{}\n  {:<24} {}\n", "draws",
                     pass.draws, "maps", pass.maps, pass.resolution, pass.resolution, "bytes",
                     readable_bytes(pass.bytes));
}

std::string text_of(const VisibilityPass& pass) {
  return fmt::format("\nenvironment visibility, computed once\n  {:<24} {}\n  {:<24} {:.3f} rad\n  {:<24} {}\n",
                     "vertices", pass.vertices, "error of the distance", pass.error, "bytes",
                     readable_bytes(pass.bytes));
}

// The names of the choices, with a star before the selected one.
std::string text_of(const ModelChoice& choice) {
  std::string text;
  for (std::size_t i = 0; i < choice.names.size(); ++i) {
    text += fmt::format("{}{}{} `{}`", i == 0 ? "" : ", ", choice.taken == i ? "*" : "", i, choice.names[i]);
  }
  return text;
}

std::string lines_of(std::string_view heading, const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += fmt::format("  {}\n", line);
  return text.empty() ? text : fmt::format("{}\n{}\n", heading, text);
}

// The choices of the model file, the defaults supplied for it, and the warnings about it.
std::string text_of_input(const Explanation& explanation) {
  std::vector<std::string> choices;
  for (const ModelChoice& choice : explanation.choices) {
    choices.push_back(fmt::format("{:<24} {}", choice.kind, text_of(choice)));
  }
  return lines_of("choices (* = selected)", choices) + lines_of("supplied", explanation.supplied) +
         lines_of("warnings", explanation.warnings);
}

std::string text_of(const Explanation& explanation) {
  std::string text = text_of_input(explanation) + "effects\n";
  for (const EffectDecision& decision : explanation.effects) {
    text +=
        fmt::format("  {:<24} {:<4} {}\n", effect_name(decision.effect), decision.on ? "on" : "off", decision.reason);
  }
  if (explanation.shadows) text += text_of(*explanation.shadows);
  if (explanation.visibility) text += text_of(*explanation.visibility);
  text += fmt::format("\nforward pass with {}\n  {:<24} {}\n  {:<24} {} lines\n  {:<24} {}\n", explanation.method,
                      "draws", explanation.draws, "fragment shader", explanation.shader_lines, "shared by all methods",
                      readable_bytes(explanation.shared_bytes));
  text += fmt::format("  {:<24} {}\n", "the method's own", readable_bytes(explanation.method_bytes));
  for (const TextureUse& use : explanation.textures) {
    text += fmt::format("    {:<19} {}\n", use.name, readable_bytes(use.bytes));
  }
  if (!explanation.left_out.empty()) {
    text += fmt::format("  {:<24} {}\n", "left out", fmt::join(explanation.left_out, ", "));
  }
  text += fmt::format("\nmemory of the maps\n  {:<24} {}\n  {:<24} {}\n", "as 32-bit floats",
                      readable_bytes(explanation.maps.decoded), "stored, at their own depth",
                      readable_bytes(explanation.maps.stored));
  if (explanation.costs.empty()) return text;
  text += fmt::format("\n{:<23} {:>10} {:>12} {:>10}\n", "cost, ms per frame", "with", "without", "adds");
  for (const EffectCost& cost : explanation.costs) {
    text += fmt::format("  {:<24} {:>10.3f} {:>12.3f} {:>10.3f}\n", effect_name(cost.effect), cost.with_ms,
                        cost.without_ms, cost.added_ms);
  }
  return text;
}

std::string json_of(const Explanation& explanation) {
  Json json;
  json["choices"] = Json::array();
  for (const ModelChoice& choice : explanation.choices) {
    Json taken;
    if (choice.taken) taken = *choice.taken;
    json["choices"].push_back({{"kind", choice.kind}, {"names", choice.names}, {"taken", taken}});
  }
  json["supplied"] = explanation.supplied;
  json["warnings"] = explanation.warnings;
  for (const EffectDecision& decision : explanation.effects) {
    json["effects"].push_back(
        {{"effect", effect_name(decision.effect)}, {"on", decision.on}, {"reason", decision.reason}});
  }
  json["method"] = explanation.method;
  json["left_out"] = explanation.left_out;
  if (const auto& shadows = explanation.shadows) {
    json["passes"].push_back({{"name", "shadow_maps"},
                              {"draws", shadows->draws},
                              {"maps", shadows->maps},
                              {"resolution", shadows->resolution},
                              {"bytes", shadows->bytes},
                              {"once", true}});
  }
  if (const auto& visibility = explanation.visibility) {
    json["passes"].push_back({{"name", "environment_visibility"},
                              {"vertices", visibility->vertices},
                              {"error_radians", visibility->error},
                              {"bytes", visibility->bytes},
                              {"once", true}});
  }
  json["passes"].push_back(
      {{"name", "forward"}, {"draws", explanation.draws}, {"shader_lines", explanation.shader_lines}});
  json["memory"] = {{"decoded_maps", explanation.maps.decoded}, {"kept_maps", explanation.maps.stored}};
  json["shared_bytes"] = explanation.shared_bytes;
  json["method_bytes"] = explanation.method_bytes;
  json["textures"] = Json::array();
  for (const TextureUse& use : explanation.textures) {
    json["textures"].push_back({{"name", use.name}, {"bytes", use.bytes}});
  }
  for (const EffectCost& cost : explanation.costs) {
    json["cost"].push_back({{"effect", effect_name(cost.effect)},
                            {"with_ms", cost.with_ms},
                            {"without_ms", cost.without_ms},
                            {"added_ms", cost.added_ms}});
  }
  return json.dump(2) + "\n";
}

void run_explain(const ExplainArguments& arguments) {
  Explanation explanation;
  {
    ProgressDisplay display(progress_style(arguments.quiet));
    explanation = explain(arguments, display.callback());
  }
  write_output(arguments.json ? json_of(explanation) : text_of(explanation));
}

}  // namespace

void add_explain_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("explain", "Show which shading effects a scene uses, why, and what they cost");
  const auto arguments = std::make_shared<ExplainArguments>(*command);
  command->add_flag("--cost", arguments->cost, "Measure what each effect adds to a frame's time");
  command->add_flag("--json", arguments->json, "Print JSON");
  add_quiet_flag(*command, arguments->quiet);
  command->footer(explain_examples);
  command->callback([arguments] { run_explain(*arguments); });
}

}  // namespace footprint
