// `footprint ndf` and what can be wrong with its input: one clear line, nothing left behind.
#include "tests/command_line/bumpy_quad.hpp"
#include "tests/command_line/program_case.hpp"

namespace footprint::test {
namespace {

// A call on a small map with some more arguments.
Case row(const std::string& name, std::vector<std::string> arguments, std::vector<std::string> errors) {
  Case added{.name = name,
             .arguments = {"ndf", "{}/bumps.png", "-o", "{}/out"},
             .exit_code = 2,
             .errors_have = std::move(errors),
             .files = {{"bumps.png", bumps_png()}}};
  added.arguments.insert(added.arguments.end(), arguments.begin(), arguments.end());
  return added;
}

std::vector<Case> footprints() {
  return {
      row("EmptyFootprint", {"--region", "0.5,0,0.5,1"}, {"--region", "is empty", "u0 < u1"}),
      row("ReversedFootprint", {"--region", "0.5,0,0.25,1"}, {"--region", "is reversed", "u0,v0,u1,v1"}),
      row("FootprintThatIsNoNumber", {"--region", "0,0,nan,1"}, {"--region", "is not finite"}),
      row("HugeFootprint", {"--region", "0,0,1e9,1"}, {"--region", "64 maps"}),
      row("FootprintOfThreeNumbers", {"--region", "0,0,1"}, {"--region", "`0,0,1` is not a rectangle", "0,0,0.5,0.5"}),
      row("FootprintOfFiveNumbers", {"--region", "0,0,1,1,1"}, {"--region", "is not a rectangle"}),
      row("FootprintInWords", {"--region", "left"}, {"--region", "`left` is not a rectangle"}),
      row("EmptyTexels", {"--texels", "1,1,1,2"}, {"--texels 1,1,1,2", "is empty"}),
      row("FootprintTwice", {"--texels", "0,0,1,1", "--region", "0,0,1,1"}, {"--texels", "--region"}),
  };
}

std::vector<Case> words() {
  return {
      row("LobeThatIsNone", {"--lobe", "phong:64"}, {"--lobe", "unknown distribution `phong`", "blinn_phong"}),
      row("LobeMisspelt", {"--lobe", "bekmann:0.1"}, {"did you mean `beckmann`?"}),
      row("LobeWithoutParameter", {"--lobe", "ggx"}, {"--lobe", "`ggx` has no parameter", "ggx:0.2"}),
      row("LobeOutOfRange", {"--lobe", "ggx:2"}, {"--lobe", "0.001 to 1"}),
      row("LobeThatIsNoNumber", {"--lobe", "vmf:nan"}, {"--lobe", "`vmf:nan`"}),
      row("NdfOfWrongMethod", {"--methods", "toxvig"}, {"toxvig", "did you mean `toksvig`?"}),
      row("NdfOfWrongMethodOption", {"--methods", "toksvig:spred=2"}, {"did you mean `spread`?"}),
      row("MaterialOfAMap", {"--material", "0"}, {"--material", "is a map"}),
      row("HeightsOfNoNumber", {"--height-scale", "nan"}, {"--height-scale"}),
      row("WrongSlopeFilter", {"--height-scale", "1", "--slope-filter", "sobl"},
          {"--slope-filter", "`sobl`", "`sobel`"}),
      row("SlopeFilterOfNormals", {"--slope-filter", "sobel"}, {"--slope-filter", "--height-scale"}),
      row("NoRings", {"--resolution", "0"}, {"--resolution", "16"}),
      row("NoPicture", {"--picture-size", "0"}, {"--picture-size", "16"}),
  };
}

std::vector<Case> sources() {
  const auto of = [](const std::string& name, const std::string& source, std::vector<std::string> errors,
                     std::map<std::string, std::string> files = {}) {
    return Case{.name = name,
                .arguments = {"ndf", source, "-o", "{}/out"},
                .exit_code = 2,
                .errors_have = std::move(errors),
                .files = std::move(files)};
  };
  return {
      of("MissingMap", "{}/missing.png", {"missing.png", "no such file"}),
      of("MissingExr", "{}/missing.exr", {"missing.exr", "no such file"}),
      of("MisspeltSceneOfNdf", "ribbed_plan", {"ribbed_plan", "did you mean `ribbed_plane`?"}),
      of("EmptyMap", "{}/empty.png", {"empty.png"}, {{"empty.png", ""}}),
      of("TextAsMap", "{}/text.exr", {"text.exr"}, {{"text.exr", "no image"}}),
      of("CutOffMap", "{}/cut.png", {"cut.png"}, {{"cut.png", bumps_png().substr(0, 40)}}),
  };
}

std::vector<Case> good() {
  Case map = row("NdfOfAMap", {"--methods", "toksvig,naive_mip:storage=fp16", "--picture-size", "32"}, {});
  map.exit_code = 0;
  map.output_has = {"toksvig", "naive_mip:storage=fp16", "energy", "lobes"};
  map.leaves = {"out/ndf.json", "out/ndf.png", "out/images/truth.exr", "out/images/toksvig_difference.png"};
  Case wrapped =
      row("NdfBeyondTheMap", {"--methods", "direct", "--region", "-1.5,0.5,0.25,2", "--picture-size", "32"}, {});
  wrapped.exit_code = 0;
  wrapped.leaves = {"out/ndf.json"};
  Case coarse = row("NdfOfACoarseGrid", {"--methods", "direct", "--lobe", "vmf:1e5", "--resolution", "16"}, {});
  coarse.exit_code = 0;
  coarse.says = {"too coarse for vmf:100000", "--resolution"};
  Case help{.name = "HelpOfNdf",
            .arguments = {"ndf", "--help"},
            .output_has = {"Examples:", "footprint ndf", "--region", "--lobe", "--material"}};
  return {map, wrapped, coarse, help};
}

const std::vector<Case> machine{
    {.name = "NdfWithoutGl",
     .arguments = {"ndf", "ribbed_plane", "--backend", "egl", "-o", "{}/out"},
     .exit_code = 3,
     .errors_have = {"egl"},
     .environment = {{"__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent"}}},
    {.name = "NdfInterrupted",
     .arguments = {"ndf", "bumps", "--methods", "toksvig", "-o", "{}/out"},
     .exit_code = 130,
     .interrupt_at = "exact sum"},
};

INSTANTIATE_TEST_SUITE_P(NdfFootprint, CommandLine, ::testing::ValuesIn(footprints()), case_name);
INSTANTIATE_TEST_SUITE_P(NdfWord, CommandLine, ::testing::ValuesIn(words()), case_name);
INSTANTIATE_TEST_SUITE_P(NdfSource, CommandLine, ::testing::ValuesIn(sources()), case_name);
INSTANTIATE_TEST_SUITE_P(NdfGood, CommandLine, ::testing::ValuesIn(good()), case_name);
INSTANTIATE_TEST_SUITE_P(NdfMachine, CommandLine, ::testing::ValuesIn(machine), case_name);

}  // namespace
}  // namespace footprint::test
