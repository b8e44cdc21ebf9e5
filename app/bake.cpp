// `footprint bake`: a method's maps as files, with the GLSL that reads them, for other renderers.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "app/commands.hpp"
#include "app/messages.hpp"
#include "app/output.hpp"
#include "app/progress_display.hpp"
#include "app/run_options.hpp"
#include "app/standard_output.hpp"
#include "experiments/studies/stage.hpp"
#include "methods/registry.hpp"
#include "renderer/baked_files/baked_files.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/memory.hpp"
#include "renderer/scene/assembly/load_scene.hpp"

namespace footprint {
namespace {

constexpr const char* bake_examples =
    "SCENE is a folder of scenes/, a path to a scene.toml, or a .gltf or .glb file. DIR must not hold anything yet.\n"
    "It gets maps/MATERIAL/NAME.exr and .ktx2 (and .png of storage=unorm8) with whole mip chains, METHOD.glsl that\n"
    "reads them, and manifest.json (docs/baking.md).\n"
    "\n"
    "Examples:\n"
    "  footprint bake model.gltf --method toksvig -o maps\n"
    "  footprint bake model.gltf --method lean:storage=fp16 --footprint trilinear -o maps";

struct BakeArguments {
  explicit BakeArguments(CLI::App& command) : run(command) {}

  RunOptions run;
  std::string output;
  bool quiet = false;
};

// Maps of another bake among these would be taken for its own.
void require_room(const std::string& output) {
  std::error_code ignored;  // what is no folder, OutputFolder refuses
  if (!std::filesystem::is_directory(output, ignored) || std::filesystem::is_empty(output, ignored)) return;
  throw Error(ErrorKind::usage, output, "holds other things", "give a new or an empty folder");
}

BakedMethod bake_settings(const RunSettings& run, const Scene& scene, const EffectSet& effects,
                          const Progress& progress) {
  const MethodSpec& spec = run.methods.front();
  const std::optional<DiskCache> files = cache_of(run);
  const std::optional<BakeCache> cache = files ? std::optional<BakeCache>(*files) : std::nullopt;
  return bake(find_method(spec.name), spec, scene, effects, progress, cache ? &*cache : nullptr);
}

std::string texture_line(const PrefilteredTexture& texture) {
  const TextureLevel& finest = texture.levels.front();
  const std::string layers = texture.layers > 0 ? fmt::format(", {} layers", texture.layers) : std::string();
  return fmt::format("  {}: {}x{}, {} levels{}, {} x {}, {}\n", texture.name, finest.width, finest.height,
                     texture.levels.size(), layers, texture.channels, storage_name(texture.storage),
                     readable_bytes(byte_count(texture)));
}

std::string summary(const BakeToFiles& bake) {
  std::string text = fmt::format("{}: {}\n", bake.baked.spec.text, readable_bytes(bake.baked.bytes));
  for (std::size_t i = 0; i < bake.scene.materials.size(); ++i) {
    const Prefiltered& prefiltered = bake.baked.materials[i];
    text +=
        fmt::format("{}{}\n", bake.scene.materials[i].name, prefiltered.textures.empty() ? ": nothing to filter" : "");
    for (const PrefilteredTexture& texture : prefiltered.textures) text += texture_line(texture);
    for (const std::string& note : prefiltered.notes) text += fmt::format("  {}\n", note);
  }
  return text;
}

void run_bake(const BakeArguments& arguments) {
  const RunSettings run = arguments.run.settings();
  require_room(arguments.output);
  ProgressDisplay display(progress_style(arguments.quiet));
  const auto [text, path] = write_whole(arguments.output, [&](OutputFolder& folder) {
    const Scene scene = load_scene(run.scene, run.scene_library);
    const EffectSet effects = effects_on(derive_effects(scene));
    const BakedMethod baked = bake_settings(run, scene, effects, display.callback());
    const BakeToFiles bake{.scene = scene,
                           .baked = baked,
                           .effects = effects,
                           .footprint = footprint_filter_of(run, scene),
                           .version = FOOTPRINT_VERSION};
    write_bake(bake, folder.path());
    keep(folder);
    display.finish();
    write_scene_notes(scene, arguments.quiet);
    return summary(bake);
  });
  write_output(fmt::format("{}manifest: {}\n", text, (path / "manifest.json").string()));
}

}  // namespace

void add_bake_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("bake", "Write a method's maps as files, with the GLSL that reads them");
  const auto arguments = std::make_shared<BakeArguments>(*command);
  command->add_option("-o,--output", arguments->output, "Folder for manifest.json, METHOD.glsl, maps/")->required();
  add_quiet_flag(*command, arguments->quiet);
  command->footer(bake_examples);
  command->callback([arguments] { run_bake(*arguments); });
}

}  // namespace footprint
