// Maps as files through the program: written whole, refused where they make no sense.
#include "tests/command_line/bumpy_quad.hpp"
#include "tests/command_line/program_case.hpp"

namespace footprint::test {
namespace {

const std::vector<Case> good_bakes{
    {.name = "HelpOfBake",
     .arguments = {"bake", "--help"},
     .output_has = {"Examples:", "footprint bake", "--method", "--footprint", "--no-cache", "manifest.json"}},
    {.name = "Bake",
     .arguments = {"bake", "v_grooves", "--method", "fixed_brdf", "-o", "{}/maps"},
     .output_has = {"v_grooves", "mean_normal", "manifest: "},
     .leaves = {"maps/manifest.json", "maps/fixed_brdf.glsl", "maps/maps/v_grooves/mean_normal.exr",
                "maps/maps/v_grooves/mean_normal.ktx2"}},
    {.name = "BakeInOtherLanguages",
     .arguments = {"bake", "v_grooves", "--method", "fixed_brdf", "--language", "glsl,hlsl,msl,hlsl", "-o", "{}/maps"},
     .output_has = {"manifest: "},
     .leaves = {"maps/fixed_brdf.glsl", "maps/fixed_brdf.hlsl", "maps/fixed_brdf.msl"},
     .needs_compilers = true},
    {.name = "HelpOfShader",
     .arguments = {"shader", "--help"},
     .output_has = {"METHOD", "--language WORD", "--scene", "Examples:"}},
    {.name = "ShaderOfTheCommonMaterial",
     .arguments = {"shader", "lean:storage=fp16", "--language", "essl"},
     .output_has = {"#version 310 es", "texture 1    sampler2D slope_rest", "set it to 8"},
     .needs_compilers = true},
    {.name = "ShaderOfAScene",
     .arguments = {"shader", "toksvig", "--language", "hlsl", "--scene", "v_grooves", "--footprint", "trilinear", "-o",
                   "{}/toksvig.hlsl"},
     .output_has = {"toksvig.hlsl"},
     .leaves = {"toksvig.hlsl"},
     .needs_compilers = true},
    {.name = "ShaderAsSpirv",
     .arguments = {"shader", "xu_vmf", "--language", "spirv", "-o", "{}/xu_vmf.spv"},
     .output_has = {"texture n has binding n + 1", "sampler2DArray", "xu_vmf.spv"},
     .leaves = {"xu_vmf.spv"},
     .needs_compilers = true},
};

const std::vector<Case> wrong_shaders{
    {.name = "ShaderOfNoMethod", .arguments = {"shader"}, .exit_code = 2, .errors_have = {"method"}},
    {.name = "ShaderOfAWrongMethod",
     .arguments = {"shader", "leen"},
     .exit_code = 2,
     .errors_have = {"`leen`", "`lean`"}},
    {.name = "ShaderInAWrongLanguage",
     .arguments = {"shader", "lean", "--language", "hslsl"},
     .exit_code = 2,
     .errors_have = {"--language", "`hslsl`", "`hlsl`"}},
    {.name = "ShaderInWgsl",
     .arguments = {"shader", "lean", "--language", "wgsl"},
     .exit_code = 2,
     .errors_have = {"--language", "`wgsl`", "known: glsl, essl, hlsl, msl, spirv"}},
    {.name = "BinaryShaderToTheTerminal",
     .arguments = {"shader", "lean", "--language", "spirv"},
     .exit_code = 2,
     .errors_have = {"--language spirv", "-o"}},
    {.name = "ShaderOfAMissingScene",
     .arguments = {"shader", "lean", "--scene", "{}/missing.gltf"},
     .exit_code = 2,
     .errors_have = {"missing.gltf"}},
    {.name = "ShaderIntoAClosedFolder",
     .arguments = {"shader", "lean", "-o", "/proc/lean.glsl"},
     .exit_code = 3,
     .errors_have = {"/proc"}},
    {.name = "BakeInAWrongLanguage",
     .arguments = {"bake", "v_grooves", "--method", "toksvig", "--language", "hlsl,cg", "-o", "{}/maps"},
     .exit_code = 2,
     .errors_have = {"--language", "`cg`"}},
};

const std::vector<Case> bakes_for_engines{
    {.name = "BakeWithACopyOfTheModel",
     .arguments = {"bake", "{}/quad.gltf", "--method", "roughness_bake:preset=godot", "--gltf", "--gltf-level", "1",
                   "-o", "{}/maps"},
     .output_has = {"engine_normal", "engine_roughness", "glTF: ", "work/maps/gltf/quad.gltf"},
     .files = {{"quad.gltf", make_bumpy_quad().text()}, {"bumps.png", bumps_png()}},
     .leaves = {"maps/gltf/quad.gltf", "maps/gltf/bumpy.normal.png", "maps/gltf/bumpy.metallic_roughness.png",
                "maps/maps/bumpy/engine_roughness.mip1.png"}},
    {.name = "BakeWithADirectionIntoACopy",
     .arguments = {"bake", "{}/quad.gltf", "--method", "roughness_bake:anisotropic=on", "--gltf", "-o", "{}/maps"},
     .output_has = {"engine_anisotropy", "glTF: "},
     .files = {{"quad.gltf", make_bumpy_quad().text()}, {"bumps.png", bumps_png()}},
     .leaves = {"maps/gltf/quad.gltf", "maps/gltf/bumpy.anisotropy.png", "maps/gltf/bumpy.anisotropy.dds",
                "maps/gltf/bumpy.anisotropy.ktx2", "maps/gltf/bumpy.normal.ktx2"}},
    {.name = "BakeInBlocks",
     .arguments = {"bake", "v_grooves", "--method", "roughness_bake:storage=bc5", "-o", "{}/maps"},
     .output_has = {"2 x bc5"},
     .leaves = {"maps/maps/v_grooves/mean_normal.ktx2"}},
};

std::vector<Case> wrong_bakes() {
  const auto row = [](const std::string& name, std::vector<std::string> arguments, std::vector<std::string> errors) {
    arguments.insert(arguments.begin(), "bake");
    arguments.insert(arguments.end(), {"-o", "{}/maps"});
    return Case{.name = name, .arguments = std::move(arguments), .exit_code = 2, .errors_have = std::move(errors)};
  };
  Case other_things = row("BakeOverOtherThings", {"v_grooves", "--method", "toksvig"},
                          {"maps", "is not empty", "new or an empty folder"});
  other_things.files = {{"maps/mine.txt", "mine"}};
  Case a_file = row("BakeOverAFile", {"v_grooves", "--method", "toksvig"}, {"maps"});
  a_file.files = {{"maps", "mine"}};
  Case nothing = row("BakeNothing", {"{}/scene.toml", "--method", "toksvig"},
                     {"scene.toml", "toksvig", "bakes nothing", "normal map"});
  nothing.files = {{"scene.toml", "[plane]\n"}};
  Case no_maps = row("CopyByAMethodWithoutMapsForEngines", {"{}/quad.gltf", "--method", "toksvig", "--gltf"},
                     {"--gltf", "toksvig", "roughness_bake"});
  no_maps.files = {{"quad.gltf", make_bumpy_quad().text()}, {"bumps.png", bumps_png()}};
  Case no_slopes = row("SlopesThatAreText", {"{}/slopes.exr", "--method", "lean"}, {"slopes.exr", "is not an EXR"});
  no_slopes.files = {{"slopes.exr", "text"}};
  return {
      other_things,
      a_file,
      row("BakeByNoMethod", {"v_grooves"}, {"--method"}),
      row("BakeByAWrongMethod", {"v_grooves", "--method", "toxvig"}, {"`toxvig`", "did you mean `toksvig`?"}),
      row("BakeByAWrongOption", {"v_grooves", "--method", "toksvig:storag=fp16"}, {"storag", "storage"}),
      row("BakeByTwoMethods", {"v_grooves", "--method", "toksvig,lean"}, {"--method", "name one"}),
      row("BakeTheReference", {"v_grooves", "--method", "reference"}, {"reference"}),
      row("BakeWhatIsBuiltForAView", {"v_grooves", "--method", "xu_vmf:space=camera"},
          {"xu_vmf:space=camera", "builds its maps for each view", "serve every view"}),
      nothing,
      row("BakeAMissingScene", {"{}/missing.gltf", "--method", "toksvig"}, {"missing.gltf"}),
      row("BakeADirectionOfALobeWithoutOne", {"v_grooves", "--method", "roughness_bake:anisotropic=on"},
          {"anisotropic=on", "one width", "anisotropic=off"}),
      row("CopyOfNoGltf", {"v_grooves", "--method", "roughness_bake", "--gltf"},
          {"--gltf", "v_grooves", "not a glTF file"}),
      row("LevelWithoutACopy", {"v_grooves", "--method", "roughness_bake", "--gltf-level", "2"}, {"--gltf"}),
      row("LevelOfTheCopyOutOfRange", {"a.gltf", "--method", "roughness_bake", "--gltf", "--gltf-level", "-1"},
          {"--gltf-level"}),
      no_maps,
      row("MissingSlopes", {"{}/missing.exr", "--method", "lean"}, {"missing.exr", "no such file"}),
      no_slopes,
      {.name = "BakeWithoutOutput",
       .arguments = {"bake", "v_grooves", "--method", "toksvig"},
       .exit_code = 2,
       .errors_have = {"--output"}},
      {.name = "BakeOnAFullDisk",
       .arguments = {"bake", "v_grooves", "--method", "toksvig", "-o", "{}/maps"},
       .exit_code = 3,
       .errors_have = {"maps"},
       .file_size_limit = 4096},
      {.name = "BakeIntoAClosedFolder",
       .arguments = {"bake", "v_grooves", "--method", "toksvig", "-o", "/proc/maps"},
       .exit_code = 3,
       .errors_have = {"/proc"}},
      {.name = "BakeInterrupted",
       .arguments = {"bake", "carved_disk", "--method", "fournier", "--no-cache", "-o", "{}/maps"},
       .exit_code = 130,
       .errors_have = {"interrupted"},
       .interrupt_at = "fitting peaks"},
  };
}

INSTANTIATE_TEST_SUITE_P(GoodBake, CommandLine, ::testing::ValuesIn(good_bakes), case_name);
INSTANTIATE_TEST_SUITE_P(BakeForEngines, CommandLine, ::testing::ValuesIn(bakes_for_engines), case_name);
INSTANTIATE_TEST_SUITE_P(WrongShader, CommandLine, ::testing::ValuesIn(wrong_shaders), case_name);
INSTANTIATE_TEST_SUITE_P(WrongBake, CommandLine, ::testing::ValuesIn(wrong_bakes()), case_name);

}  // namespace
}  // namespace footprint::test
