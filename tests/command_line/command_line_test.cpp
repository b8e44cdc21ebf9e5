// The program as a user meets it: exit codes, one clear error each, nothing half-written. One row a case.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <ostream>
#include <set>

#include "tests/command_line/process.hpp"

namespace footprint::test {
namespace {

namespace fs = std::filesystem;

// One way to call the program and what must come of it. `{}` in arguments stands for the case's own folder.
struct Case {
  std::string name;
  std::vector<std::string> arguments{};
  int exit_code = 0;
  std::vector<std::string> output_has{};       // texts on standard output
  std::vector<std::string> errors_have{};      // texts in the error line on standard error
  std::map<std::string, std::string> files{};  // input files: name in the case's folder, content
  std::map<std::string, std::string> environment{};
  std::string standard_output{};                   // a device to write to
  std::optional<std::uint64_t> file_size_limit{};  // bytes a file may have: a full disk
  std::string interrupt_at{};                      // Ctrl-C at this text on standard error
  std::set<std::string> leaves{};                  // files that must be there afterwards
  double seconds = 120;                            // it must have ended by then
};

void PrintTo(const Case& row, std::ostream* out) { *out << row.name; }

class CommandLine : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / ("footprint_command_line_" + GetParam().name);
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "work");
    for (const auto& [name, content] : GetParam().files) std::ofstream(folder_ / "work" / name) << content;
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] ProcessResult run() const {
    const Case& row = GetParam();
    ProcessRequest request{.command = {FOOTPRINT_PROGRAM},
                           .folder = folder_,
                           .environment = row.environment,
                           .standard_output = row.standard_output,
                           .file_size_limit = row.file_size_limit,
                           .interrupt_at = row.interrupt_at};
    for (std::string argument : row.arguments) {
      if (const auto at = argument.find("{}"); at != std::string::npos) {
        argument.replace(at, 2, (folder_ / "work").string());
      }
      request.command.push_back(argument);
    }
    return run_process(request);
  }

  // Everything below the case's folder, without the input files.
  [[nodiscard]] std::set<std::string> left_behind() const {
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / "work")) {
      names.insert(fs::relative(entry.path(), folder_ / "work").string());
    }
    for (const auto& [name, content] : GetParam().files) names.erase(name);
    return names;
  }

  fs::path folder_;
};

// The last line: progress may stand before it.
std::string last_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

TEST_P(CommandLine, EndsAsItShould) {
  const Case& row = GetParam();
  const ProcessResult result = run();
  EXPECT_EQ(result.exit_code, row.exit_code) << result.errors;
  EXPECT_EQ(result.signal, 0);
  EXPECT_LT(result.duration.count(), row.seconds);
  EXPECT_EQ(result.interrupted, !row.interrupt_at.empty());
  for (const std::string& text : row.output_has) {
    EXPECT_NE(result.output.find(text), std::string::npos) << text << "\nis not in\n" << result.output;
  }
  const std::set<std::string> left = left_behind();
  for (const std::string& file : row.leaves) EXPECT_TRUE(left.contains(file)) << file;
  if (row.exit_code == 0) return;
  const std::string line = last_line(result.errors);
  EXPECT_TRUE(line.starts_with("footprint: ")) << result.errors;
  for (const std::string& text : row.errors_have) {
    EXPECT_NE(line.find(text), std::string::npos) << text << "\nis not in\n" << line;
  }
  EXPECT_EQ(left, std::set<std::string>{});
}

const std::vector<Case> help_cases{
    {.name = "Help",
     .arguments = {"--help"},
     .output_has = {"Examples:", "Exit codes:", "compare", "render", "explain", "list", "info"}},
    {.name = "HelpOfCompare",
     .arguments = {"compare", "--help"},
     .output_has = {"Examples:", "footprint compare", "--methods", "--spp", "--distance", "--seed", "after_shading"}},
    {.name = "HelpOfRender",
     .arguments = {"render", "--help"},
     .output_has = {"Examples:", "footprint render", "--method", "--size", "--output"}},
    {.name = "HelpOfExplain",
     .arguments = {"explain", "--help"},
     .output_has = {"Examples:", "footprint explain", "--cost", "--json"}},
    {.name = "HelpOfList", .arguments = {"list", "--help"}, .output_has = {"Examples:", "footprint list", "--json"}},
    {.name = "HelpOfInfo", .arguments = {"info", "--help"}, .output_has = {"Examples:", "footprint info"}},
    {.name = "Version", .arguments = {"--version"}, .output_has = {"footprint 0."}},
};

const std::vector<Case> listing_cases{
    {.name = "ListMethods", .arguments = {"list", "methods"}, .output_has = {"direct", "naive_mip", "toksvig"}},
    {.name = "ListEverything", .arguments = {"list"}, .output_has = {"methods\n", "scenes\n", "backends\n"}},
    {.name = "ListAsJson", .arguments = {"list", "methods", "--json"}, .output_has = {"\"methods\"", "\"options\""}},
    {.name = "Info", .arguments = {"info"}, .output_has = {"backends\n", "OpenGL 4.5", "processor", "memory"}},
};

const std::vector<Case> wrong_words{
    {.name = "NoSubcommand", .exit_code = 2, .errors_have = {"ubcommand", "footprint --help"}},
    {.name = "WrongSubcommand",
     .arguments = {"compere", "x"},
     .exit_code = 2,
     .errors_have = {"unknown subcommand `compere`", "did you mean `compare`?"}},
    {.name = "WrongOption",
     .arguments = {"compare", "{}/a.gltf", "--distanse", "1,2", "-o", "{}/out"},
     .exit_code = 2,
     .errors_have = {"compare: unknown option `--distanse`", "did you mean `--distance`?"}},
    {.name = "WrongOptionWithValue",
     .arguments = {"render", "{}/a.gltf", "--metod=direct", "-o", "{}/a.exr"},
     .exit_code = 2,
     .errors_have = {"render: unknown option `--metod`", "did you mean `--method`?"}},
    {.name = "ArgumentTooMany",
     .arguments = {"info", "extra"},
     .exit_code = 2,
     .errors_have = {"one argument too many"}},
    {.name = "NoScene", .arguments = {"compare"}, .exit_code = 2, .errors_have = {"scene", "footprint compare --help"}},
    {.name = "NoMethod",
     .arguments = {"render", "{}/a.gltf", "-o", "{}/a.exr"},
     .exit_code = 2,
     .errors_have = {"--method"}},
    {.name = "WrongKind",
     .arguments = {"list", "metods"},
     .exit_code = 2,
     .errors_have = {"`metods`", "did you mean `methods`?"}},
    {.name = "WrongMethod",
     .arguments = {"compare", "{}/a.gltf", "--methods", "direct,toxvig", "-o", "{}/out"},
     .exit_code = 2,
     .errors_have = {"toxvig", "did you mean `toksvig`?"}},
    {.name = "WrongBackend",
     .arguments = {"compare", "{}/a.gltf", "--backend", "osmessa", "-o", "{}/out"},
     .exit_code = 2,
     .errors_have = {"osmessa", "did you mean `osmesa`?"}},
    {.name = "WrongFilter",
     .arguments = {"compare", "{}/a.gltf", "--filter", "bilinaer", "-o", "{}/out"},
     .exit_code = 2,
     .errors_have = {"--filter", "did you mean `bilinear`?"}},
};

const std::vector<Case> wrong_values{
    {.name = "NoPixels",
     .arguments = {"compare", "{}/a.gltf", "--size", "0x0", "-o", "{}/out"},
     .exit_code = 2,
     .errors_have = {"--size", "0x0", "512x512"}},
    {.name = "SizeOverflow",
     .arguments = {"render", "{}/a.gltf", "--method", "direct", "--size", "1x99999999999999999999", "-o", "{}/a.exr"},
     .exit_code = 2,
     .errors_have = {"--size", "10000000"}},
    {.name = "NoSamples",
     .arguments = {"compare", "{}/a.gltf", "--spp", "0", "-o", "{}/out"},
     .exit_code = 2,
     .errors_have = {"--spp"}},
    {.name = "TooManySamples",
     .arguments = {"compare", "{}/a.gltf", "--spp", "4097", "-o", "{}/out"},
     .exit_code = 2,
     .errors_have = {"--spp", "4096"}},
    {.name = "SamplesInWords",
     .arguments = {"compare", "{}/a.gltf", "--spp", "many", "-o", "{}/out"},
     .exit_code = 2,
     .errors_have = {"--spp", "many"}},
    {.name = "NegativeDistance",
     .arguments = {"compare", "{}/a.gltf", "--distance", "1,-2", "-o", "{}/out"},
     .exit_code = 2,
     .errors_have = {"--distance", "`-2`"}},
    {.name = "NegativeExposure",
     .arguments = {"compare", "{}/a.gltf", "--exposure", "0", "-o", "{}/out"},
     .exit_code = 2,
     .errors_have = {"--exposure"}},
    {.name = "MissingFile",
     .arguments = {"compare", "{}/missing.gltf", "-o", "{}/out"},
     .exit_code = 2,
     .errors_have = {"missing.gltf"}},
    {.name = "MissingFileOfRender",
     .arguments = {"render", "{}/missing.gltf", "--method", "direct", "-o", "{}/a.exr"},
     .exit_code = 2,
     .errors_have = {"missing.gltf"}},
    {.name = "MissingFileOfExplain",
     .arguments = {"explain", "{}/missing.gltf"},
     .exit_code = 2,
     .errors_have = {"missing.gltf"}},
    {.name = "WrongPictureFormat",
     .arguments = {"render", "{}/a.gltf", "--method", "direct", "-o", "{}/a.jpg"},
     .exit_code = 2,
     .errors_have = {"a.jpg", ".exr", ".png"}},
};

const std::string model = "/usr/share/assimp/models/glTF2/ClearCoat-glTF/ClearCoatTest.gltf";

const std::vector<Case> machine_cases{
    {.name = "FullDiskUnderStandardOutput",
     .arguments = {"list", "methods"},
     .exit_code = 3,
     .errors_have = {"standard output"},
     .standard_output = "/dev/full"},
    {.name = "FrameOverMemory",
     .arguments = {"compare", model, "--size", "1000000x1000000", "-o", "{}/out"},
     .exit_code = 3,
     .errors_have = {"1000000x1000000", "TiB", "--size"},
     .seconds = 1},
    {.name = "FrameOverMemoryOfRender",
     .arguments = {"render", model, "--method", "direct", "--size", "1000000x1000000", "-o", "{}/a.exr"},
     .exit_code = 3,
     .errors_have = {"1000000x1000000", "TiB", "--size"},
     .seconds = 1},
    {.name = "NoGl",
     .arguments = {"render", model, "--method", "direct", "--backend", "egl", "-o", "{}/a.exr"},
     .exit_code = 3,
     .errors_have = {"egl"},
     .environment = {{"__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent"}}},
    {.name = "NoSuchDevice",
     .arguments = {"render", model, "--method", "direct", "--backend", "egl-device", "--device", "99", "-o",
                   "{}/a.exr"},
     .exit_code = 2,
     .errors_have = {"99"}},
    {.name = "FolderThatCannotBeMade",
     .arguments = {"compare", model, "-o", "{}/file/out"},
     .exit_code = 3,
     .errors_have = {"file"},
     .files = {{"file", "a file, not a folder"}}},
    {.name = "PictureWhereNoFolderIs",
     .arguments = {"render", model, "--method", "direct", "--size", "16x16", "-o", "{}/missing/a.exr"},
     .exit_code = 3,
     .errors_have = {"missing"}},
    {.name = "FullDiskUnderPicture",
     .arguments = {"render", model, "--method", "direct", "--size", "256x256", "-o", "{}/a.exr"},
     .exit_code = 3,
     .errors_have = {"a.exr"},
     .file_size_limit = 4096},
    {.name = "FullDiskUnderResults",
     .arguments = {"compare", model, "--size", "64x64", "--spp", "1", "--repeats", "1", "-o", "{}/out"},
     .exit_code = 3,
     .errors_have = {"out"},
     .file_size_limit = 4096},
    {.name = "ControlC",
     .arguments = {"compare", model, "--size", "256x256", "--spp", "4096", "-o", "{}/out"},
     .exit_code = 130,
     .errors_have = {"interrupted"},
     .interrupt_at = "reference"},
    {.name = "ControlCOfRender",
     .arguments = {"render", model, "--method", "reference", "--spp", "4096", "-o", "{}/a.exr"},
     .exit_code = 130,
     .errors_have = {"interrupted"},
     .interrupt_at = "samples a pixel"},
    {.name = "ReferenceOptionWithAMethod",
     .arguments = {"render", model, "--method", "direct", "--spp", "64", "-o", "{}/a.exr"},
     .exit_code = 2,
     .errors_have = {"--spp", "--method reference"}},
    {.name = "NoSuchFrame",
     .arguments = {"render", model, "--method", "direct", "--frame", "999", "-o", "{}/a.exr"},
     .exit_code = 2,
     .errors_have = {"--frame", "999"}},
};

// Small jobs that go well.
const std::vector<Case> good_cases{
    {.name = "RenderAMethod",
     .arguments = {"render", model, "--method", "direct", "--size", "64x48", "-o", "{}/a.exr"},
     .output_has = {"a.exr"},
     .leaves = {"a.exr"}},
    {.name = "RenderTheReference",
     .arguments = {"render", model, "--method", "reference", "--spp", "4", "--size", "64x48", "-o", "{}/a.png"},
     .output_has = {"a.png"},
     .leaves = {"a.png"}},
    {.name = "Explain",
     .arguments = {"explain", model, "--size", "64x64"},
     .output_has = {"normal_variation", "a normal map that is not flat", "base_normal"}},
    {.name = "ExplainCost",
     .arguments = {"explain", model, "--size", "64x64", "--cost", "--repeats", "1", "--json"},
     .output_has = {"\"cost\"", "\"added_ms\""}},
    {.name = "CompareInTwoProcesses",
     .arguments = {"compare", model, "--size", "64x64", "--spp", "4", "--repeats", "1", "--processes", "2", "-o",
                   "{}/out"},
     .output_has = {"direct", "naive_mip", "toksvig", "page: "},
     .leaves = {"out/index.html", "out/results.json", "out/results.csv", "out/table.md", "out/images"}},
};

std::string case_name(const testing::TestParamInfo<Case>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(Help, CommandLine, testing::ValuesIn(help_cases), case_name);
INSTANTIATE_TEST_SUITE_P(Listing, CommandLine, testing::ValuesIn(listing_cases), case_name);
INSTANTIATE_TEST_SUITE_P(WrongWord, CommandLine, testing::ValuesIn(wrong_words), case_name);
INSTANTIATE_TEST_SUITE_P(WrongValue, CommandLine, testing::ValuesIn(wrong_values), case_name);
INSTANTIATE_TEST_SUITE_P(Good, CommandLine, testing::ValuesIn(good_cases), case_name);
INSTANTIATE_TEST_SUITE_P(Machine, CommandLine, testing::ValuesIn(machine_cases), case_name);

}  // namespace
}  // namespace footprint::test
