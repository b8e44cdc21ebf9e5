// `run`, `check` and `animate` as a user meets them: help, wrong files and values, an interrupt, a full disk.
#include "tests/command_line/program_case.hpp"

namespace footprint::test {
namespace {

const std::string small =
    "[experiment]\ntitle = \"t\"\nscene = \"ribbed_plane\"\nsize = [16, 16]\nmethods = [\"direct\"]\nrepeats = 1\n"
    "[zoom]\ndistances = [1]\n[reference]\nspp = 2\n";
const std::string large =
    "[experiment]\ntitle = \"t\"\nscene = \"ribbed_plane\"\nsize = [256, 256]\nmethods = [\"direct\"]\n"
    "[reference]\nspp = 4096\n";

std::vector<std::string> animate(const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"animate", "ribbed_plane", "--size", "16x16", "--spp", "2", "-o", "{}/out"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

const std::vector<Case> experiment_cases{
    {.name = "HelpOfRun",
     .arguments = {"run", "--help"},
     .output_has = {"Examples:", "footprint run", "--quick", "docs/experiments.md"}},
    {.name = "HelpOfCheck",
     .arguments = {"check", "--help"},
     .output_has = {"Examples:", "footprint check quick", "Exit code 1"}},
    {.name = "HelpOfAnimate",
     .arguments = {"animate", "--help"},
     .output_has = {"Examples:", "footprint animate", "--frames", "--from", "--to", "ffmpeg"}},
    {.name = "ListExperiments", .arguments = {"list", "experiments"}, .output_has = {"experiments\n", "\n  quick\n"}},
    {.name = "ExperimentsOfAnotherFolder",
     .arguments = {"list", "experiments", "--json"},
     .output_has = {"\"mine\""},
     .files = {{"mine.toml", small}},
     .environment = {{"FOOTPRINT_EXPERIMENTS", "{}"}}},
    {.name = "NoExperiment", .arguments = {"check"}, .exit_code = 2, .errors_have = {"footprint check --help"}},
    {.name = "WrongExperiment",
     .arguments = {"run", "quik", "-o", "{}/out"},
     .exit_code = 2,
     .errors_have = {"quik: no such experiment or file", "did you mean `quick`?"}},
    {.name = "EmptyExperiment", .arguments = {"run", "", "-o", "{}/out"}, .exit_code = 2, .errors_have = {"no such"}},
    {.name = "WrongBackendOfRun",
     .arguments = {"run", "{}/mine.toml", "--backend", "elg", "-o", "{}/out"},
     .exit_code = 2,
     .errors_have = {"did you mean `egl`?"},
     .files = {{"mine.toml", small}}},
    {.name = "WrongKeyOfAnExperiment",
     .arguments = {"run", "{}/mine.toml", "-o", "{}/out"},
     .exit_code = 2,
     .errors_have = {"mine.toml:11: unknown key `fingure`", "did you mean `figure`?"},
     .files = {{"mine.toml", small + "[fingure]\n"}}},
    {.name = "WrongSceneOfAnExperiment",
     .arguments = {"check", "{}/mine.toml", "-o", "{}/out"},
     .exit_code = 2,
     .errors_have = {"ribed_plane: no such scene", "did you mean `ribbed_plane`?"},
     .files = {{"mine.toml", "[experiment]\ntitle = \"t\"\nscene = \"ribed_plane\"\nmethods = [\"direct\"]\n"}}},
    {.name = "FigureOfAFrameThatTheSceneLacks",
     .arguments = {"run", "{}/mine.toml", "-o", "{}/out"},
     .exit_code = 2,
     .errors_have = {"mine.toml", "frame 7", "zoom path is shorter"},
     .files = {{"mine.toml",
                "[experiment]\ntitle = \"t\"\nscene = \"ribbed_plane\"\nsize = [8, 8]\nmethods = [\"direct\"]\n"
                "[reference]\nspp = 1\n[[figure.row]]\npictures = [{ method = \"direct\", frame = 7 }]\n"}}},
    {.name = "RunASmallExperiment",
     .arguments = {"run", "{}/mine.toml", "-o", "{}/out"},
     .output_has = {"## Experiment mine", "page: "},
     .files = {{"mine.toml", small}},
     .leaves = {"out/index.html", "out/results.json", "out/results.csv", "out/table.md", "out/images"}},
    {.name = "TimesOfSeveralProcesses",
     .arguments = {"check", "{}/mine.toml", "--processes", "3", "-o", "{}/out"},
     .output_has = {"## Experiment a", "## Experiment b", "Timing: 1 frame of each method in each of 3 processes"},
     .files = {{"mine.toml", "[experiment]\ntitle = \"t\"\nmembers = [\"a\", \"b\"]\n"},
               {"a.toml", small},
               {"b.toml", small}},
     .leaves = {"out/a/results.json", "out/b/results.json"}},
    {.name = "NoProcesses",
     .arguments = {"run", "{}/mine.toml", "--processes", "0", "-o", "{}/out"},
     .exit_code = 2,
     .errors_have = {"--processes"},
     .files = {{"mine.toml", small}}},
    {.name = "FullDiskUnderAnExperiment",
     .arguments = {"check", "{}/mine.toml", "-o", "{}/out"},
     .exit_code = 3,
     .errors_have = {"work/out/", "free some space"},
     .files = {{"mine.toml", small}},
     .file_size_limit = 4096},
    {.name = "ControlCOfRun",
     .arguments = {"run", "{}/mine.toml", "-o", "{}/out"},
     .exit_code = 130,
     .errors_have = {"interrupted"},
     .files = {{"mine.toml", large}},
     .interrupt_at = "reference"},
    {.name = "ControlCOfCheckKeepsWhatWasThere",
     .arguments = {"check", "{}/mine.toml", "-o", "{}/out"},
     .exit_code = 130,
     .errors_have = {"interrupted"},
     .files = {{"mine.toml", large}, {"out/results.json", "an earlier run's"}},
     .interrupt_at = "reference"},
};

const std::vector<Case> animate_cases{
    {.name = "NoMethodToAnimate", .arguments = animate({}), .exit_code = 2, .errors_have = {"--method"}},
    {.name = "WrongMethodToAnimate",
     .arguments = animate({"--method", "toksvg"}),
     .exit_code = 2,
     .errors_have = {"did you mean `toksvig`"}},
    {.name = "OneFrame",
     .arguments = animate({"--method", "direct", "--frames", "1"}),
     .exit_code = 2,
     .errors_have = {"--frames"}},
    {.name = "WrongFilterOfAnimate",
     .arguments = animate({"--method", "direct", "--filter", "neerest"}),
     .exit_code = 2,
     .errors_have = {"did you mean `nearest`?"}},
    {.name = "ZoomThatDoesNotMove",
     .arguments = animate({"--method", "direct", "--from", "2", "--to", "2"}),
     .exit_code = 2,
     .errors_have = {"--to", "where it starts"}},
    {.name = "ZoomFromNowhere",
     .arguments = animate({"--method", "direct", "--from", "0"}),
     .exit_code = 2,
     .errors_have = {"--from", "`0`"}},
    {.name = "Animate",
     .arguments = animate({"--method", "direct,toksvig:storage=fp16", "--frames", "2"}),
     .output_has = {"toksvig:storage=fp16", "Flicker", "frames: "},
     .leaves = {"out/animation.json", "out/animation.csv", "out/table.md", "out/images/reference_0001.exr",
                "out/images/direct_0000.png", "out/images/toksvig_storage_fp16_0001.exr"}},
    {.name = "FullDiskUnderAnimate",
     .arguments = animate({"--method", "direct", "--frames", "2"}),
     .exit_code = 3,
     .errors_have = {"work/out/images/", "free some space"},
     .file_size_limit = 256},
    {.name = "ControlCOfAnimate",
     .arguments = {"animate", "ribbed_plane", "--method", "direct", "--spp", "4096", "--frames", "100", "-o", "{}/out"},
     .exit_code = 130,
     .errors_have = {"interrupted"},
     .interrupt_at = "frame 1 of 100"},
};

INSTANTIATE_TEST_SUITE_P(Experiment, CommandLine, ::testing::ValuesIn(experiment_cases), case_name);
INSTANTIATE_TEST_SUITE_P(Animation, CommandLine, ::testing::ValuesIn(animate_cases), case_name);

}  // namespace
}  // namespace footprint::test
