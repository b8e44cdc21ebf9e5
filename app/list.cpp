// The subcommands about this program: `list`, `info` and `completions`.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "app/commands.hpp"
#include "app/folders.hpp"
#include "app/help.hpp"
#include "app/messages.hpp"
#include "app/run_options.hpp"
#include "experiments/runner/experiment.hpp"
#include "methods/registry.hpp"
#include "renderer/bake/method_file.hpp"
#include "renderer/core/memory.hpp"
#include "renderer/core/names.hpp"
#include "renderer/core/process.hpp"
#include "renderer/gl/context.hpp"
#include "renderer/scene/assembly/load_scene.hpp"
#include "scenes/surfaces/registry.hpp"

namespace footprint {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* list_examples =
    R"(Examples:
  footprint list                               everything
  footprint list methods                       the methods and their options
  footprint list ./mine.glsl                   a method in a file (docs/guides/method-files.md)
  footprint list scenes --json                 for programs)";

constexpr const char* info_examples =
    R"(Examples:
  footprint info                               backends with their limits, processor, memory
  footprint info | grep egl-device             the GPUs, with their numbers for --device)";

constexpr const char* completions_examples =
    R"(Installed packages bring these already.

Examples:
  source <(footprint completions bash)
  footprint completions zsh > ~/.zfunc/_footprint
  footprint completions fish > ~/.config/fish/completions/footprint.fish)";

const std::vector<std::string> kinds{"methods", "scenes", "surfaces", "experiments", "backends"};

struct ListArguments {
  explicit ListArguments(CLI::App& command) {
    add_value(command, "kind", kind, "KIND",
              "methods, scenes, surfaces, experiments, backends, or a method's FILE.glsl; default: all");
    command.add_flag("--json", json, "Print JSON");
  }

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

// A line per option; `prefix` precedes an option when it is written.
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

// A line with renderer and version and one with its limits, or one line that says why it is not available.
std::string backend_text(const gl::BackendReport& report) {
  std::string name{gl::backend_name(report.backend)};
  if (report.backend == gl::Backend::egl_device) name += fmt::format(" --device {}", report.device);
  if (!report.info) return fmt::format("  {:<22} not available: {}\n", name, report.why_not);
  const gl::ContextInfo& info = *report.info;
  return fmt::format(
      "  {:<22} {}, OpenGL {}{}\n"
      "  {:<22} textures up to {} texels per side, frames up to {} without tiles, {} texture units, uniform blocks up "
      "to {} bytes\n",
      name, info.renderer, info.version, info.software ? ", software" : "", "", info.max_texture_size,
      info.max_framebuffer_size, info.max_texture_units, info.max_uniform_block_bytes);
}

Json backend_json(const gl::BackendReport& report) {
  Json json{
      {"name", gl::backend_name(report.backend)}, {"device", report.device}, {"available", report.info.has_value()}};
  if (!report.info) {
    json["why_not"] = report.why_not;
    return json;
  }
  const gl::ContextInfo& info = *report.info;
  json["vendor"] = info.vendor;
  json["renderer"] = info.renderer;
  json["version"] = info.version;
  json["glsl_version"] = info.glsl_version;
  json["software"] = info.software;
  json["max_texture_size"] = info.max_texture_size;
  json["max_framebuffer_size"] = info.max_framebuffer_size;
  json["max_texture_units"] = info.max_texture_units;
  json["max_uniform_block_bytes"] = info.max_uniform_block_bytes;
  return json;
}

std::string backends_text() {
  std::string text = "backends\n";
  for (const gl::BackendReport& report : gl::probe_backends()) text += backend_text(report);
  return text;
}

Json kind_json(std::string_view kind) {
  if (kind == "scenes") return list_scenes(scene_library().folder);
  if (kind == "experiments") return list_experiments(experiments_folder());
  Json json = Json::array();
  if (kind == "methods") {
    for (const Method* method : all_methods()) json.push_back(method_json(method->info));
  } else if (kind == "surfaces") {
    for (const Surface& surface : all_surfaces()) json.push_back(surface_json(surface));
  } else {
    for (const gl::BackendReport& report : gl::probe_backends()) json.push_back(backend_json(report));
  }
  return json;
}

std::vector<std::string> names_of(std::string_view kind) {
  std::vector<std::string> names;
  for (const Json& entry : kind_json(kind)) names.push_back(entry.is_object() ? entry["name"] : entry);
  return names;
}

std::string kind_text(const std::string& kind) {
  if (kind == "backends") return backends_text();
  std::string text = kind + "\n";
  if (kind == "methods") {
    for (const Method* method : all_methods()) text += method_text(method->info);
  } else if (kind == "surfaces") {
    for (const Surface& surface : all_surfaces()) text += surface_text(surface);
  } else {
    for (const std::string& name : names_of(kind)) text += fmt::format("  {}\n", name);
  }
  return text;
}

void run_list(const ListArguments& arguments) {
  if (names_method_file(arguments.kind)) {
    const MethodInfo info = read_method_file(arguments.kind)->info;
    return write_output(arguments.json ? method_json(info).dump(2) + "\n" : method_text(info));
  }
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

void run_info() {
  write_output(fmt::format("footprint {}\n\n{}\nmachine\n  {:<22} {}\n  {:<22} {} available\n", FOOTPRINT_VERSION,
                           backends_text(), "processor", describe_cpu(), "memory", readable_bytes(available_memory())));
}

struct CompletionsArguments {
  std::string shell;
  std::vector<std::string> words;  // the words typed so far, for `offer`
};

}  // namespace

void add_list_command(CLI::App& app) {
  add_command(app, "list", "List the methods, scenes, surfaces, experiments and backends", list_examples, run_list);
}

void add_info_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("info", "Show version, OpenGL backends and limits");
  command->footer(info_examples);
  command->callback(run_info);
}

void add_completions_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("completions", "Print the completions of the command line for a shell");
  const auto arguments = std::make_shared<CompletionsArguments>();
  command->add_option("shell", arguments->shell, "bash, zsh or fish")->type_name("SHELL")->required();
  command->add_option("words", arguments->words)->group("");  // `completions offer -- WORD...`, which the scripts call
  command->footer(completions_examples);
  command->callback([arguments, &app] {
    write_output(arguments->shell == "offer" ? offered_words(app, arguments->words, names_of)
                                             : completion_script(arguments->shell));
  });
}

}  // namespace footprint
