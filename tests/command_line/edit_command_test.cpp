// `edit` as a user meets it: help, wrong parameters and scenes, an interrupt, a full disk.
#include "tests/command_line/program_case.hpp"

namespace footprint::test {
namespace {

// A method with few facets: what is tested here is not its picture.
const std::string quick_method = "iwasaki_sg:j=2:directions=4:facets=500";

std::vector<std::string> edit(const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"edit",     "woven_cloth", "--size", "16x16",
                                     "--method", quick_method,  "-o",     "{}/out"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

const std::vector<Case> edit_cases{
    {.name = "HelpOfEdit",
     .arguments = {"edit", "--help"},
     .output_has = {"Examples:", "footprint edit woven_cloth", "--set", "--frames", "KIND.PARAMETER=FROM:TO"}},
    {.name = "NothingToEdit", .arguments = edit({}), .exit_code = 2, .errors_have = {"--set"}},
    {.name = "WrongParameter",
     .arguments = edit({"--set", "weave.warp_widht=0.1:0.5"}),
     .exit_code = 2,
     .errors_have = {"--set weave.warp_widht=0.1:0.5", "`warp_width`"}},
    {.name = "WrongKind",
     .arguments = edit({"--set", "weeve.warp_width=0.1:0.5"}),
     .exit_code = 2,
     .errors_have = {"`weave`"}},
    {.name = "KindOfAnotherScene",
     .arguments = edit({"--set", "noise.slope=0.1:0.5"}),
     .exit_code = 2,
     .errors_have = {"--set noise.slope"}},
    {.name = "ParameterOutOfRange",
     .arguments = edit({"--set", "weave.warp_width=0.1:5"}),
     .exit_code = 2,
     .errors_have = {"option warp_width"}},
    {.name = "ParameterTwice",
     .arguments = edit({"--set", "weave.height=0.1", "--set", "weave.height=0.2"}),
     .exit_code = 2,
     .errors_have = {"--set weave.height"}},
    {.name = "NoFramesToEdit",
     .arguments = edit({"--set", "weave.height=0.1", "--frames", "0"}),
     .exit_code = 2,
     .errors_have = {"--frames"}},
    {.name = "SceneWithoutSmallScaleGeometry",
     .arguments = {"edit", "ribbed_plane", "--set", "weave.height=0.1", "-o", "{}/out"},
     .exit_code = 2,
     .errors_have = {"ribbed_plane", "[microgeometry]"}},
    {.name = "EditByTheReference",
     .arguments = {"edit", "woven_cloth", "--set", "weave.height=0.1", "--method", "reference", "-o", "{}/out"},
     .exit_code = 2,
     .errors_have = {"--method"}},
    {.name = "Edit",
     .arguments = edit({"--set", "weave.warp_width=0.1:0.5", "--set", "weave.height=0.1", "--frames", "2"}),
     .output_has = {"visibility", "BVNDF", "NDF", "amplitudes", "upload", "frame", "edits per second", "frames: "},
     .leaves = {"out/edit.json", "out/edit.csv", "out/table.md", "out/images"}},
    {.name = "EditByAMethodOfMaps",
     .arguments = {"edit", "woven_cloth", "--size", "16x16", "--set", "weave.warp_width=0.1:0.5", "--frames", "2",
                   "--method", "toksvig", "-o", "{}/out"},
     .output_has = {"toksvig", "edits per second"},
     .leaves = {"out/edit.json", "out/images/toksvig_0001.exr"}},
    {.name = "EditOfTheBrdf",
     .arguments = {"edit", "ribbed_plane", "--size", "16x16", "--set", "brdf.specular=0.02:0.5", "--frames", "2",
                   "--method", "xu_vmf", "-o", "{}/out"},
     .output_has = {"BRDF", "upload", "frame", "edits per second"},
     .leaves = {"out/edit.json", "out/images/xu_vmf_0001.exr"}},
    {.name = "EditOfAnotherDistribution",
     .arguments = {"edit", "ribbed_plane", "--set", "brdf.kappa=9", "-o", "{}/out"},
     .exit_code = 2,
     .errors_have = {"--set brdf.kappa"}},
    {.name = "EditToAMissingTable",
     .arguments = edit({"--set", "brdf.measured={}/a.binary:{}/b.binary"}),
     .exit_code = 2,
     .errors_have = {"a.binary"}},
    {.name = "FullDiskUnderEdit",
     .arguments = edit({"--set", "weave.height=0.1", "--frames", "1"}),
     .exit_code = 3,
     .errors_have = {"work/out/edit.json"},
     .file_size_limit = 256},
    {.name = "ControlCOfEdit",
     .arguments = {"edit", "woven_cloth", "--set", "weave.warp_width=0.1:0.5", "--frames", "1000", "-o", "{}/out"},
     .exit_code = 130,
     .errors_have = {"interrupted"},
     .interrupt_at = "of 1000"},
};

INSTANTIATE_TEST_SUITE_P(Edit, CommandLine, ::testing::ValuesIn(edit_cases), case_name);

}  // namespace
}  // namespace footprint::test
