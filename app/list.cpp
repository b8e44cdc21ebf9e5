// The subcommands about this program: `list`, `info` and `completions`; and the colours of methods, for figures.
#include <nlohmann/json.hpp>
#include <variant>

#include "app/folders.hpp"
#include "app/help.hpp"
#include "app/subcommand.hpp"
#include "experiments/runner/experiment.hpp"
#include "methods/registry.hpp"
#include "renderer/bake/method_file.hpp"
#include "renderer/core/memory.hpp"
#include "renderer/core/names.hpp"
#include "renderer/core/process.hpp"
#include "renderer/gl/context.hpp"
#include "renderer/scene/assembly/load_scene.hpp"
#include "results/report/method_colors.hpp"
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

// The following write the JSON as text.

std::string word(const Json& entry, const char* key) {
  return entry[key].is_string() ? entry[key].get<std::string>() : fmt::format("{}", entry[key].get<double>());
}

// prefix: precedes an option when it is written.
std::string option_text(const Json& option, std::string_view prefix) {
  const std::string values = option.contains("choices")
                                 ? fmt::format("{}", fmt::join(option["choices"].get<std::vector<std::string>>(), ", "))
                                 : fmt::format("{} to {}", word(option, "minimum"), word(option, "maximum"));
  return fmt::format("      {}{}={}  ({})  {}\n", prefix, word(option, "name"), word(option, "default"), values,
                     word(option, "meaning"));
}

// A line with renderer and version and one with its limits, or one line that says why it is not available.
std::string backend_text(const Json& backend) {
  std::string name = word(backend, "name");
  if (name == gl::backend_name(gl::Backend::egl_device)) name += " --device " + word(backend, "device");
  if (!backend["available"]) return fmt::format("  {:<22} not available: {}\n", name, word(backend, "why_not"));
  return fmt::format(
      "  {:<22} {}, OpenGL {}{}\n"
      "  {:<22} textures up to {} texels per side, frames up to {} without tiles, {} texture units, uniform blocks up "
      "to {} bytes\n",
      name, word(backend, "renderer"), word(backend, "version"), backend["software"] ? ", software" : "", "",
      word(backend, "max_texture_size"), word(backend, "max_framebuffer_size"), word(backend, "max_texture_units"),
      word(backend, "max_uniform_block_bytes"));
}

std::string entry_text(const Json& entry) {
  if (entry.is_string()) return fmt::format("  {}\n", entry.get<std::string>());
  if (entry.contains("device")) return backend_text(entry);
  std::string text = fmt::format("  {}\n      {}\n", word(entry, "name"), word(entry, "summary"));
  if (entry.contains("parameters")) {
    for (const Json& parameter : entry["parameters"]) text += option_text(parameter, "");
    return text;
  }
  if (const std::string paper = word(entry, "paper"); !paper.empty()) text += fmt::format("      {}\n", paper);
  if (entry["slow_precompute"]) text += "      bake takes seconds; cached on disk\n";
  if (entry["slow_frame"]) text += "      slow: seconds per frame; not part of `all`\n";
  for (const Json& option : entry["options"]) text += option_text(option, ":");
  return text;
}

std::string kind_text(const std::string& kind) {
  std::string text = kind + "\n";
  for (const Json& entry : kind_json(kind)) text += entry_text(entry);
  return text;
}

void run_list(const ListArguments& arguments) {
  if (names_method_file(arguments.kind)) {
    const Json method = method_json(read_method_file(arguments.kind)->info);
    return write_output(arguments.json ? method.dump(2) + "\n" : entry_text(method));
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

// {method: {theme: colour}}.
Json colors_json(const std::vector<std::string>& methods) {
  const std::vector<std::size_t> places = color_places(methods);
  Json json = Json::object();
  for (std::size_t i = 0; i < methods.size(); ++i) {
    json[methods[i]] = {{"light", report_palette().light[places[i]]}, {"dark", report_palette().dark[places[i]]}};
  }
  return json;
}

void run_info() {
  write_output(fmt::format("footprint {}\n\n{}\nmachine\n  {:<22} {}\n  {:<22} {} available\n", FOOTPRINT_VERSION,
                           kind_text("backends"), "processor", describe_cpu(), "memory",
                           readable_bytes(available_memory())));
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

void add_colors_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("method-colors", "Print the colours of methods in reports, as JSON");
  const auto methods = std::make_shared<std::vector<std::string>>();
  command->add_option("methods", *methods)->required();
  command->group("");  // no part of the help: the figures of the documents are drawn by it
  command->callback([methods] { write_output(colors_json(*methods).dump() + "\n"); });
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
