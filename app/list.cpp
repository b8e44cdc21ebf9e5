// `footprint list`: the methods with their options, the scenes, the surfaces with their parameters, the experiments,
// the backends.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "app/backend_text.hpp"
#include "app/commands.hpp"
#include "app/folders.hpp"
#include "app/standard_output.hpp"
#include "experiments/runner/experiment.hpp"
#include "methods/registry.hpp"
#include "renderer/core/words.hpp"
#include "renderer/scene/assembly/load_scene.hpp"
#include "scenes/surfaces/registry.hpp"

namespace footprint {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* list_examples =
    "Examples:\n"
    "  footprint list                               everything\n"
    "  footprint list methods                       the methods and their options\n"
    "  footprint list scenes --json                 for programs";

const std::vector<std::string> kinds{"methods", "scenes", "surfaces", "experiments", "backends"};

struct ListArguments {
  std::string kind;  // empty: all
  bool json = false;
};

std::string default_text(const OptionSpec& option) {
  if (const auto* number = std::get_if<double>(&option.default_value)) return fmt::format("{}", *number);
  return std::get<std::string>(option.default_value);
}

std::string range_text(const OptionSpec& option) {
  if (option.choices.empty()) return fmt::format("{} to {}", option.minimum, option.maximum);
  return fmt::format("{}", fmt::join(option.choices, ", "));
}

// `prefix` is what stands before an option where it is written.
std::string options_text(const std::vector<OptionSpec>& options, std::string_view prefix) {
  std::string text;
  for (const OptionSpec& option : options) {
    text += fmt::format("      {}{}={}  ({})  {}\n", prefix, option.name, default_text(option), range_text(option),
                        option.meaning);
  }
  return text;
}

std::string method_text(const MethodInfo& method) {
  std::string text = fmt::format("  {}\n      {}\n", method.name, method.summary);
  if (!method.paper.empty()) text += fmt::format("      {}\n", method.paper);
  if (method.slow_precompute) text += "      bake takes seconds; cached on disk\n";
  if (method.slow_frame) text += "      slow: seconds per frame; not part of `all`\n";
  return text + options_text(method.options, ":");
}

std::string surface_text(const Surface& surface) {
  return fmt::format("  {}\n      {}\n", surface.name, surface.summary) + options_text(surface.parameters, "");
}

Json option_json(const OptionSpec& option) {
  Json json{{"name", option.name}, {"meaning", option.meaning}};
  if (const auto* number = std::get_if<double>(&option.default_value)) {
    json["default"] = *number;
    json["minimum"] = option.minimum;
    json["maximum"] = option.maximum;
    json["integer"] = option.integer;
  } else {
    json["default"] = std::get<std::string>(option.default_value);
    json["choices"] = option.choices;
  }
  return json;
}

Json options_json(const std::vector<OptionSpec>& specs) {
  Json options = Json::array();
  for (const OptionSpec& spec : specs) options.push_back(option_json(spec));
  return options;
}

Json surface_json(const Surface& surface) {
  return {{"name", surface.name},
          {"summary", surface.summary},
          {"resolution", surface.default_resolution},
          {"parameters", options_json(surface.parameters)}};
}

Json method_json(const MethodInfo& method) {
  return {{"name", method.name},
          {"summary", method.summary},
          {"paper", method.paper},
          {"slow_precompute", method.slow_precompute},
          {"slow_frame", method.slow_frame},
          {"honours", effect_names(method.honours)},
          {"options", options_json(method.options)}};
}

std::string kind_text(const std::string& kind) {
  std::string text = kind + "\n";
  if (kind == "methods") {
    for (const Method* method : all_methods()) text += method_text(method->info());
  } else if (kind == "scenes") {
    for (const std::string& scene : list_scenes(scene_library().folder)) text += fmt::format("  {}\n", scene);
  } else if (kind == "experiments") {
    for (const std::string& name : list_experiments(experiments_folder())) text += fmt::format("  {}\n", name);
  } else if (kind == "surfaces") {
    for (const Surface& surface : all_surfaces()) text += surface_text(surface);
  } else {
    for (const gl::BackendReport& report : gl::probe_backends()) text += backend_text(report);
  }
  return text;
}

Json kind_json(const std::string& kind) {
  if (kind == "scenes") return list_scenes(scene_library().folder);
  if (kind == "experiments") return list_experiments(experiments_folder());
  Json json = Json::array();
  if (kind == "methods") {
    for (const Method* method : all_methods()) json.push_back(method_json(method->info()));
  } else if (kind == "surfaces") {
    for (const Surface& surface : all_surfaces()) json.push_back(surface_json(surface));
  } else {
    for (const gl::BackendReport& report : gl::probe_backends()) json.push_back(backend_json(report));
  }
  return json;
}

void run_list(const ListArguments& arguments) {
  std::vector<std::string> shown = kinds;
  if (!arguments.kind.empty()) shown = {kinds[find_word(kinds, arguments.kind, "kind", "list")]};
  Json json;
  std::string text;
  for (const std::string& kind : shown) {
    if (arguments.json) {
      json[kind] = kind_json(kind);
    } else {
      text += (text.empty() ? "" : "\n") + kind_text(kind);
    }
  }
  write_output(arguments.json ? json.dump(2) + "\n" : text);
}

}  // namespace

void add_list_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("list", "List the methods, scenes, surfaces, experiments and backends");
  const auto arguments = std::make_shared<ListArguments>();
  command->add_option("kind", arguments->kind, "methods, scenes, surfaces, experiments or backends; default: all")
      ->type_name("KIND");
  command->add_flag("--json", arguments->json, "Print JSON");
  command->footer(list_examples);
  command->callback([arguments] { run_list(*arguments); });
}

}  // namespace footprint
