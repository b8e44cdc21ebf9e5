// `footprint shader`: a method's module in a shader language, for other renderers.
#include "app/subcommand.hpp"
#include "experiments/studies/frame_setup.hpp"
#include "experiments/studies/stage.hpp"
#include "renderer/baked_files/baked_files.hpp"
#include "renderer/core/names.hpp"
#include "renderer/languages/compilers.hpp"
#include "renderer/scene/assembly/load_scene.hpp"

namespace footprint {
namespace {

constexpr const char* shader_examples =
    R"(glsl is the module that `footprint bake` writes: functions for a fragment shader. The other languages are translated
from it, with an entry point for one lamp and their inputs listed in the first lines (docs/guides/baking.md).

Examples:
  footprint shader lean --language hlsl -o lean.hlsl
  footprint shader toksvig:storage=fp16 --language essl --footprint trilinear
  footprint shader lean --language spirv --scene model.gltf -o lean.spv)";

struct ShaderArguments : RunArguments {
  explicit ShaderArguments(CLI::App& command) : RunArguments(command) {
    add_value(command, "--language", language, "WORD", "glsl, essl, hlsl, msl or spirv")->capture_default_str();
    add_value(command, "-o,--output", output, "FILE", "The file; default: standard output");
  }

  std::string language = "glsl";
  std::string output;  // empty: standard output
};

// A model with the maps that most have, in two texels: only their kinds matter.
Scene common_scene() {
  Scene scene;
  scene.name = scene.source = "the common material";
  scene.horizon = Horizon::open;
  Material& material = scene.materials.emplace_back();
  material.name = "common";
  Image normals(2, 1, 4), roughness(2, 1, 2);
  normals.texels = {0.6F, 0.0F, 0.8F, 1.0F, 0.0F, 0.0F, 1.0F, 1.0F};
  roughness.texels = {0.4F, 0.0F, 0.6F, 0.0F};
  material.normal_map = {"normals", std::make_shared<const Image>(std::move(normals)), {}};
  material.metallic_roughness_map = {"roughness", std::make_shared<const Image>(std::move(roughness)), {}};
  return scene;
}

void write_shader(const BakeToFiles& bake, ShaderLanguage language, const std::string& output) {
  const std::string text = shader_text(bake, language);
  if (output.empty()) return write_output(text);
  write_file_atomically(std::filesystem::path(output), text);
  const bool is_binary = language == ShaderLanguage::spirv;
  write_output((is_binary ? inputs_text(bake, language, "") : std::string()) + output + "\n");
}

void run_shader(const ShaderArguments& arguments) {
  const RunSettings run = arguments.settings();
  const ShaderLanguage language = word_value(shader_languages, arguments.language, "language", "--language");
  if (language == ShaderLanguage::spirv && arguments.output.empty())
    throw Error(ErrorKind::usage, "--language spirv", "is binary", "name a file with -o");
  if (language != ShaderLanguage::glsl) require_compilers("--language " + arguments.language);
  ProgressDisplay display(progress_style(arguments.quiet));
  const Scene scene = run.scene.empty() ? common_scene() : load_scene(run.scene, run.scene_library, run.overrides);
  const EffectSet effects = effects_on(derive_effects(scene));
  const FootprintFilter footprint = footprint_filter_of(run.footprint, scene);
  require_one_lookup(footprint, "shader");
  const BakedMethod baked = bake_by_cache(run.cache, run.methods.front(), scene, effects, display.callback());
  display.finish();
  write_scene_notes(scene, arguments.quiet);
  write_shader(
      {.scene = scene, .baked = baked, .effects = effects, .footprint = footprint, .version = FOOTPRINT_VERSION},
      language, arguments.output);
}

}  // namespace

void add_shader_command(CLI::App& app) {
  add_command(app, "shader", "Write a method's shader in GLSL, ESSL, HLSL, Metal or SPIR-V", shader_examples,
              run_shader);
}

}  // namespace footprint
