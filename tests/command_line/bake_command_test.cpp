// Maps as files through the program: written whole, refused where they make no sense.
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
};

std::vector<Case> wrong_bakes() {
  const auto row = [](const std::string& name, std::vector<std::string> arguments, std::vector<std::string> errors) {
    arguments.insert(arguments.begin(), "bake");
    arguments.insert(arguments.end(), {"-o", "{}/maps"});
    return Case{.name = name, .arguments = std::move(arguments), .exit_code = 2, .errors_have = std::move(errors)};
  };
  Case other_things = row("BakeOverOtherThings", {"v_grooves", "--method", "toksvig"},
                          {"maps", "holds other things", "new or an empty folder"});
  other_things.files = {{"maps/mine.txt", "mine"}};
  Case a_file = row("BakeOverAFile", {"v_grooves", "--method", "toksvig"}, {"maps"});
  a_file.files = {{"maps", "mine"}};
  Case nothing = row("BakeNothing", {"{}/scene.toml", "--method", "toksvig"},
                     {"scene.toml", "toksvig", "bakes nothing", "normal map"});
  nothing.files = {{"scene.toml", "[plane]\n"}};
  return {
      other_things,
      a_file,
      row("BakeByNoMethod", {"v_grooves"}, {"--method"}),
      row("BakeByAWrongMethod", {"v_grooves", "--method", "toxvig"}, {"`toxvig`", "did you mean `toksvig`?"}),
      row("BakeByAWrongOption", {"v_grooves", "--method", "toksvig:storag=fp16"}, {"storag", "storage"}),
      row("BakeByTwoMethods", {"v_grooves", "--method", "toksvig,lean"}, {"--method", "name one"}),
      row("BakeTheReference", {"v_grooves", "--method", "reference"}, {"reference"}),
      row("BakeWhatIsBuiltEachFrame", {"v_grooves", "--method", "xu_vmf"}, {"xu_vmf", "anew for each frame"}),
      nothing,
      row("BakeAMissingScene", {"{}/missing.gltf", "--method", "toksvig"}, {"missing.gltf"}),
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
INSTANTIATE_TEST_SUITE_P(WrongBake, CommandLine, ::testing::ValuesIn(wrong_bakes()), case_name);

}  // namespace
}  // namespace footprint::test
