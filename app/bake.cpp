// `footprint bake`: a method's maps as files with the GLSL that reads them, for other renderers.
#include <algorithm>
#include <sstream>

#include "app/subcommand.hpp"
#include "experiments/studies/frame_setup.hpp"
#include "experiments/studies/stage.hpp"
#include "renderer/baked_files/baked_files.hpp"
#include "renderer/core/memory.hpp"
#include "renderer/core/names.hpp"
#include "renderer/languages/compilers.hpp"
#include "renderer/pipeline/surface_program.hpp"
#include "renderer/scene/assembly/load_scene.hpp"

namespace footprint {
namespace {

constexpr const char* bake_examples =
    R"(The output folder must be new or empty. It gets maps/MATERIAL/NAME.exr and .ktx2 with all mip levels (.png too with
storage=unorm8), METHOD.glsl that reads them, and manifest.json (docs/guides/baking.md).

For lean and leadr, SCENE may also be an EXR written by OpenImageIO's `maketx --bumpslopes`.

Examples:
  footprint bake model.gltf --method toksvig -o maps
  footprint bake model.gltf --method lean:storage=fp16 --footprint trilinear -o maps
  footprint bake model.gltf --method roughness_bake:preset=filament --gltf --gltf-level 2 -o maps
  footprint bake model.gltf --method lean --language hlsl,msl -o maps
  footprint bake bumps_slopes.exr --method lean -o maps)";

constexpr int coarsest_level = 16;

struct BakeArguments : RunArguments {
  explicit BakeArguments(CLI::App& command) : RunArguments(command) {
    add_output_folder(command, output, "Folder for manifest.json, METHOD.glsl, maps/")->required();
    add_value(command, "--language", languages, "LIST",
              "Also write METHOD.LANGUAGE, a shader with an entry point: essl, hlsl, msl, spirv");
    auto* copy =
        command.add_flag("--gltf", gltf, "Also write a copy of the model, with the roughness maps that engines import");
    command.add_option("--gltf-level", gltf_level, "Mip level of the copy's maps; 0 is the finest")
        ->check(within(0, coarsest_level))
        ->needs(copy)
        ->capture_default_str();
  }

  std::string output;
  std::string languages;
  bool gltf = false;
  int gltf_level = 0;
};

// Other than GLSL, which every bake has; each once.
std::vector<ShaderLanguage> parse_languages(const std::string& list) {
  std::vector<ShaderLanguage> languages;
  std::istringstream words(list);
  for (std::string word; std::getline(words, word, ',');) {
    const ShaderLanguage language = word_value(shader_languages, word, "language", "--language");
    const bool is_new = std::ranges::find(languages, language) == languages.end();
    if (language != ShaderLanguage::glsl && is_new) languages.push_back(language);
  }
  if (!languages.empty()) require_compilers("--language " + list);
  return languages;
}

// Requires a new or empty folder, because maps of another bake would be mistaken for this one's.
void require_room(const std::string& output) {
  std::error_code ignored;  // OutputFolder refuses a path that is not a folder
  if (!std::filesystem::is_directory(output, ignored) || std::filesystem::is_empty(output, ignored)) return;
  throw Error(ErrorKind::usage, output, "is not empty", "give a new or an empty folder");
}

void require_gltf(const std::string& scene) {
  if (lower_extension(scene) == ".gltf" || lower_extension(scene) == ".glb") return;
  throw Error(ErrorKind::usage, "--gltf", fmt::format("{} is not a glTF file, so it cannot be copied", scene),
              "name the .gltf or .glb itself, or leave --gltf out");
}

// A material with the slopes of a file, which says nothing about its roughness.
Scene scene_of_slopes(const std::string& file, const ExrChain& slopes) {
  const std::filesystem::path path = file;
  Scene scene;
  scene.name = path.stem().string();
  scene.source = file;
  Material& material = scene.materials.emplace_back();
  material.name = scene.name;
  material.roughness = 0.5F;
  material.normal_map = {
      path.filename().string(), std::make_shared<const Image>(normals_of_bumpslopes(slopes, file)), {}};
  scene.defaults.emplace_back("material: GGX of roughness 0.5, which the manifest's `lobe_cutoff` says; set your own");
  return scene;
}

void take_slopes(const ExrChain& slopes, BakedMethod& baked) {
  const auto& options = baked.options.all();
  const auto roughness = options.find("roughness");
  const bool joined = roughness != options.end() && roughness->second == std::variant<double, std::string>("moments");
  if (joined || !holds_slope_moments(baked.materials.front())) {
    throw Error(ErrorKind::usage, fmt::format("method {}", baked.spec.text),
                "does not store exactly the slope moments that the file has",
                "use lean or leadr, with roughness=stretched or roughness=shading");
  }
  replace_moments(slopes, baked.materials.front());
}

std::vector<EngineMaps> make_engine_maps(const Scene& scene, const BakedMethod& baked) {
  std::vector<EngineMaps> maps;
  for (const Material& material : scene.materials) maps.push_back(engine_maps(baked, material));
  return maps;
}

// Writes the copy of the model, with the maps of all materials that have some. Returns its path in the folder.
std::string copy_gltf(const BakeToFiles& bake, int level, const std::filesystem::path& folder) {
  std::vector<ReplacedMaps> maps;
  for (std::size_t i = 0; i < bake.engine.size(); ++i) {
    if (bake.engine[i].textures.empty()) continue;
    maps.push_back(replaced_maps(bake.engine[i], bake.scene.materials[i], level));
  }
  if (maps.empty()) {
    throw Error(ErrorKind::usage, "--gltf",
                fmt::format("{} has no maps that an engine imports for any of the materials", bake.baked.spec.text),
                "use roughness_bake, and a model with normal maps");
  }
  std::filesystem::create_directories(folder / "gltf");
  return "gltf/" + write_gltf_copy(bake.scene.source, maps, folder / "gltf");
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
    for (const PrefilteredTexture& texture : bake.engine[i].textures) text += texture_line(texture);
    for (const std::string& note : prefiltered.notes) text += fmt::format("  {}\n", note);
    if (!bake.engine[i].missing.empty()) text += fmt::format("  {}\n", bake.engine[i].missing);
  }
  return text;
}

void run_bake(const BakeArguments& arguments) {
  const RunSettings run = arguments.settings();
  const std::vector<ShaderLanguage> languages = parse_languages(arguments.languages);
  require_room(arguments.output);
  if (arguments.gltf) require_gltf(run.scene);
  ProgressDisplay display(progress_style(arguments.quiet));
  const auto [text, path, lost] = write_whole(arguments.output, [&](OutputFolder& folder) {
    const std::optional<ExrChain> slopes =
        lower_extension(run.scene) == ".exr" ? std::optional(read_exr_chain(run.scene)) : std::nullopt;
    const Scene scene =
        slopes ? scene_of_slopes(run.scene, *slopes) : load_scene(run.scene, run.scene_library, run.overrides);
    require_one_lookup(footprint_filter_of(run.footprint, scene), "bake");
    const EffectSet effects = effects_on(derive_effects(scene));
    BakedMethod baked = bake_by_cache(run.cache, run.methods.front(), scene, effects, display.callback());
    if (slopes) take_slopes(*slopes, baked);
    if (waits_for_build(baked)) take_built_maps(gl::Context(run.backend.context), scene, effects, baked);
    const BakeToFiles bake{.scene = scene,
                           .baked = baked,
                           .effects = effects,
                           .footprint = footprint_filter_of(run.footprint, scene),
                           .version = FOOTPRINT_VERSION,
                           .engine = make_engine_maps(scene, baked),
                           .languages = languages};
    write_bake(bake, folder.path());
    std::string copy;
    if (arguments.gltf)
      copy = fmt::format("glTF: {}\n",
                         (folder.final_path() / copy_gltf(bake, arguments.gltf_level, folder.path())).string());
    keep(folder);
    display.finish();
    write_scene_notes(scene, arguments.quiet);
    return summary(bake) + copy;
  });
  write_output(fmt::format("{}manifest: {}\n", text, (path / "manifest.json").string()));
}

}  // namespace

void add_bake_command(CLI::App& app) {
  add_command(app, "bake", "Write a method's maps as files, with the GLSL that reads them", bake_examples, run_bake);
}

}  // namespace footprint
