// `footprint explain`: the effects of a scene with their reasons, its passes, textures and bytes, and their costs.
#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "app/subcommand.hpp"
#include "experiments/studies/frame_setup.hpp"
#include "experiments/studies/frame_times.hpp"
#include "experiments/studies/stage.hpp"
#include "renderer/core/memory.hpp"
#include "renderer/pipeline/timing.hpp"
#include "renderer/scene/assembly/load_scene.hpp"
#include "results/report/json_archive.hpp"

namespace footprint {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* explain_examples =
    R"(Examples:
  footprint explain model.gltf                 effects with reasons, passes, textures, memory
  footprint explain model.gltf --method toksvig --cost
  footprint explain model.gltf --json          for programs)";

struct ExplainArguments : RunArguments {
  explicit ExplainArguments(CLI::App& command) : RunArguments(command) {
    command.add_flag("--cost", cost, "Measure what each effect adds to a frame's time");
    command.add_flag("--json", json, "Print JSON");
  }

  bool cost = false;
  bool json = false;
};

// Bytes of the scene's maps, each once however many materials share it.
Json map_bytes(const Scene& scene) {
  std::size_t decoded = 0;  // as 32-bit floats
  std::size_t stored = 0;   // at their own depth
  std::set<MapTexels> counted;
  for (const Material& material : scene.materials) {
    for (const TextureMap* map : maps_of(material)) {
      const MapTexels& texels = map->image;
      if (!counted.insert(texels).second) continue;
      decoded += texels.texel_count() * static_cast<std::size_t>(texels.channels()) * sizeof(float);
      stored += texels.byte_count();
    }
  }
  return {{"decoded_maps", decoded}, {"kept_maps", stored}};
}

// Milliseconds of a frame with every effect of the scene, and without one of them: medians over the repeats, and of the
// differences, frame by frame; noise can make those negative.
Json cost_of(Effect effect, const std::vector<double>& with, const std::vector<double>& without) {
  std::vector<double> added(with.size());
  std::ranges::transform(with, without, added.begin(), std::minus{});
  return {{"effect", effect_name(effect)},
          {"with_ms", quantile(with, 0.5)},
          {"without_ms", quantile(without, 0.5)},
          {"added_ms", quantile(added, 0.5)}};
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

Variant make_variant(const Stage& stage, const EffectSet& effects, const Progress& progress) {
  auto scene =
      std::make_unique<GpuScene>(stage.context().info(), stage.scene(), effects, progress, nullptr, &stage.gpu_scene());
  StagedMethod method = stage.stage_with(effects, *scene);
  return {std::move(scene), std::move(method)};
}

// Renders the scene by the stage's first method with all effects and without each one, frames interleaved.
Json measure_effect_costs(const Stage& stage, int repeats, const Progress& progress) {
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
    variants.push_back(make_variant(stage, remaining, preparing));
  }
  std::vector<DrawFrame> frames{[&] { stage.methods().front().frames().draw(view); }};
  for (const Variant& variant : variants) frames.emplace_back([&] { variant.method.frames().draw(view); });
  const auto times = interleaved_times(
      stage.context().info(), frames, repeats,
      [&](std::string_view what, double done) { progress(what, 0.5 + 0.5 * done); }, are_known);
  stage.context().check("timing the effects");

  Json costs;
  for (std::size_t i = 0; i < measured.size(); ++i) costs.push_back(cost_of(measured[i], times[0], times[i + 1]));
  return costs;
}

// The textures of the method by their names, with their bytes over all materials.
Json texture_uses(const BakedMethod& baked) {
  Json uses = Json::array();
  for (std::size_t material = 0; material < baked.materials.size(); ++material) {
    const std::vector<PrefilteredTexture>& textures = baked.materials[material].textures;
    for (std::size_t i = 0; i < textures.size(); ++i) {
      auto use = std::ranges::find_if(uses, [&](const Json& known) { return known["name"] == textures[i].name; });
      if (use == uses.end()) use = uses.insert(uses.end(), Json{{"name", textures[i].name}, {"bytes", 0U}});
      Json& bytes = (*use)["bytes"];
      if (!baked.shared.contains({material, i})) bytes = bytes.get<std::size_t>() + byte_count(textures[i]);
    }
  }
  return uses;
}

// The shadow maps and the environment's visibility, made once before the first frame, if there are any; the forward
// pass, which draws each material.
Json passes_of(const Stage& stage) {
  Json passes;
  if (const auto& maps = stage.gpu_scene().shadow_maps()) {
    passes.push_back({{"name", "shadow_maps"},
                      {"draws", maps->draws()},
                      {"maps", maps->views().views.size()},
                      {"resolution", maps->resolution()},
                      {"bytes", maps->bytes()},
                      {"once", true}});
  }
  if (const GpuVisibility* visibility = stage.gpu_scene().visibility()) {
    passes.push_back({{"name", "environment_visibility"},
                      {"vertices", visibility->vertex_count()},
                      {"error_radians", visibility->error()},
                      {"bytes", visibility->bytes()},
                      {"once", true}});
  }
  const std::string& shader = stage.methods().front().frames().program().fragment_text();
  passes.push_back({{"name", "forward"},
                    {"draws", stage.gpu_scene().batches().size()},
                    {"shader_lines", std::ranges::count(shader, '\n')}});
  return passes;
}

Json choices_of(const Scene& scene) {
  Json choices = Json::array();
  for (const auto& [kind, names, taken] : scene.choices)
    choices.push_back({{"kind", kind}, {"names", names}, {"taken", to_json_value(taken)}});
  return choices;
}

Json explain(const ExplainArguments& arguments, const Progress& progress) {
  const RunSettings run = arguments.settings();
  ProgressParts parts(progress, arguments.cost ? 3 : 1);
  const Stage stage(load_scene(run.scene, run.scene_library, run.overrides), run, parts.next(1, ""));
  const BakedMethod& baked = stage.methods().front().baked();
  Json out{{"choices", choices_of(stage.scene())},
           {"supplied", stage.scene().defaults},
           {"warnings", stage.scene().warnings}};
  for (const auto& [effect, on, reason] : stage.decisions())
    out["effects"].push_back({{"effect", effect_name(effect)}, {"on", on}, {"reason", reason}});
  out["method"] = run.methods.front().text;
  out["left_out"] = effect_names(stage.effects() & ~baked.method->info.honours);
  out["passes"] = passes_of(stage);
  out["memory"] = map_bytes(stage.scene());
  out["shared_bytes"] = stage.gpu_scene().shared_bytes();
  out["method_bytes"] = baked.bytes;
  out["textures"] = texture_uses(baked);
  if (!arguments.cost) return out;
  for (const Json& cost : measure_effect_costs(stage, run.timing.repeats, parts.next(2, "")))
    out["cost"].push_back(cost);
  return out;
}

std::string line_of(std::string_view label, const Json& value, std::string_view unit = "") {
  return fmt::format("  {:<24} {}{}\n", label, value.is_string() ? value.get<std::string>() : value.dump(), unit);
}

std::string bytes_line(std::string_view label, const Json& bytes) {
  return line_of(label, readable_bytes(bytes.get<std::uint64_t>()));
}

std::string text_of_pass(const Json& pass, const Json& explanation) {
  if (pass["name"] == "shadow_maps")
    return "\nshadow maps, rendered once\n" + line_of("draws", pass["draws"]) +
           line_of("maps", fmt::format("{0} of {1}x{1}", pass["maps"].get<int>(), pass["resolution"].get<int>())) +
           bytes_line("bytes", pass["bytes"]);
  if (pass["name"] == "environment_visibility")
    return "\nenvironment visibility, computed once\n" + line_of("vertices", pass["vertices"]) +
           line_of("error of the distance", fmt::format("{:.3f} rad", pass["error_radians"].get<double>())) +
           bytes_line("bytes", pass["bytes"]);
  return fmt::format("\nforward pass with {}\n", explanation["method"].get<std::string>()) +
         line_of("draws", pass["draws"]) + line_of("fragment shader", pass["shader_lines"], " lines") +
         bytes_line("shared by all methods", explanation["shared_bytes"]) +
         bytes_line("the method's own", explanation["method_bytes"]);
}

// The names of a choice, with a star before the selected one.
std::string text_of_choice(const Json& choice) {
  std::vector<std::string> names;
  for (const Json& name : choice["names"]) {
    const bool is_taken = choice["taken"] == names.size();
    names.push_back(fmt::format("{}{} `{}`", is_taken ? "*" : "", names.size(), name.get<std::string>()));
  }
  return fmt::format("{:<24} {}", choice["kind"].get<std::string>(), fmt::join(names, ", "));
}

std::string lines_of(std::string_view heading, const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += fmt::format("  {}\n", line);
  return text.empty() ? text : fmt::format("{}\n{}\n", heading, text);
}

std::string text_of(const Json& explanation) {
  std::vector<std::string> choices;
  std::ranges::transform(explanation["choices"], std::back_inserter(choices), text_of_choice);
  std::string text = lines_of("choices (* = selected)", choices) + lines_of("supplied", explanation["supplied"]) +
                     lines_of("warnings", explanation["warnings"]) + "effects\n";
  for (const Json& effect : explanation["effects"])
    text += fmt::format("  {:<24} {:<4} {}\n", effect["effect"].get<std::string>(), effect["on"] == true ? "on" : "off",
                        effect["reason"].get<std::string>());
  for (const Json& pass : explanation["passes"]) text += text_of_pass(pass, explanation);
  for (const Json& use : explanation["textures"])
    text += fmt::format("    {:<19} {}\n", use["name"].get<std::string>(),
                        readable_bytes(use["bytes"].get<std::uint64_t>()));
  if (!explanation["left_out"].empty())
    text += line_of("left out",
                    fmt::format("{}", fmt::join(explanation["left_out"].get<std::vector<std::string>>(), ", ")));
  text += "\nmemory of the maps\n" + bytes_line("as 32-bit floats", explanation["memory"]["decoded_maps"]) +
          bytes_line("stored, at their own depth", explanation["memory"]["kept_maps"]);
  if (!explanation.contains("cost")) return text;
  text += fmt::format("\n{:<23} {:>10} {:>12} {:>10}\n", "cost, ms per frame", "with", "without", "adds");
  for (const Json& cost : explanation["cost"])
    text +=
        fmt::format("  {:<24} {:>10.3f} {:>12.3f} {:>10.3f}\n", cost["effect"].get<std::string>(),
                    cost["with_ms"].get<double>(), cost["without_ms"].get<double>(), cost["added_ms"].get<double>());
  return text;
}

void run_explain(const ExplainArguments& arguments) {
  Json explanation;
  {
    ProgressDisplay display(progress_style(arguments.quiet));
    explanation = explain(arguments, display.callback());
  }
  write_output(arguments.json ? explanation.dump(2) + "\n" : text_of(explanation));
}

}  // namespace

void add_explain_command(CLI::App& app) {
  add_command(app, "explain", "Show which shading effects a scene uses, why, and what they cost", explain_examples,
              run_explain);
}

}  // namespace footprint
