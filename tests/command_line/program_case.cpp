// Runs the program in a folder of its own and checks its exit code, what it prints and the files that it leaves.
// Starting it takes a quarter of a second, the loading of what OpenImageIO links; so it is a function in a fork of this
// process, but where a row looks at the program itself.
#include "tests/command_line/program_case.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <ostream>
#include <string_view>
#include <utility>

#include "app/commands.hpp"
#include "tests/command_line/golden_messages.hpp"
#include "tests/support/source_folder.hpp"

namespace footprint::test {
namespace {

namespace fs = std::filesystem;

// The last line: progress and notes may stand before it.
std::string last_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

void expect_parts(const std::vector<std::string>& parts, const std::string& whole) {
  for (const std::string& part : parts) {
    EXPECT_NE(whole.find(part), std::string::npos) << part << "\nis not in\n" << whole;
  }
}

}  // namespace

void PrintTo(const Case& row, std::ostream* out) { *out << row.name; }

std::string case_name(const ::testing::TestParamInfo<Case>& info) { return info.param.name; }

std::vector<Case> of_compare_and_render(const std::vector<Case>& rows) {
  const std::vector<std::string> compare_options{"--size", "16x16", "--spp", "2", "--repeats", "1", "-o", "{}/out"};
  const std::vector<std::string> render_options{"--method", "direct", "--size", "16x16", "-o", "{}/a.exr"};
  std::vector<Case> both;
  for (const Case& row : rows) {
    for (const bool compares : {true, false}) {
      Case& added = both.emplace_back(row);
      added.name += compares ? "OfCompare" : "OfRender";
      added.arguments.insert(added.arguments.begin(), compares ? "compare" : "render");
      std::ranges::copy(compares ? compare_options : render_options, std::back_inserter(added.arguments));
      if (row.exit_code == 0) added.leaves = {compares ? "out/results.json" : "a.exr"};
    }
  }
  return both;
}

void CommandLine::SetUp() {
  if (GetParam().needs_compilers && !FOOTPRINT_HAS_COMPILERS) GTEST_SKIP() << "no compilers of shaders";
  fs::create_directories(work());
  for (const auto& [name, content] : GetParam().files) {
    fs::create_directories((work() / name).parent_path());
    std::ofstream(work() / name, std::ios::binary) << content;
  }
}

std::string CommandLine::in_place(std::string text) const {
  if (const auto at = text.find("{}"); at != std::string::npos) text.replace(at, 2, work().string());
  return text;
}

std::string CommandLine::out_of_place(std::string text) const {
  const std::array<std::pair<std::string, std::string_view>, 3> names{
      {{work().string(), "{}"}, {folder_.string(), "{}/.."}, {testing::source_folder().string(), "{source}"}}};
  for (const auto& [own, name] : names) {
    for (std::size_t at = text.find(own); at != std::string::npos; at = text.find(own, at + name.size()))
      text.replace(at, own.size(), name);
  }
  return text;
}

ProcessResult CommandLine::run() const {
  const Case& row = GetParam();
  ProcessRequest request{.command = {FOOTPRINT_PROGRAM},
                         .function = row.starts_program ? nullptr : run_program,
                         .folder = folder_,
                         .standard_output = row.standard_output,
                         .file_size_limit = row.file_size_limit,
                         .interrupt_at = row.interrupt_at};
  for (const std::string& argument : row.arguments) request.command.push_back(in_place(argument));
  for (const auto& [name, value] : row.environment) request.environment[name] = in_place(value);
  return run_process(request);
}

std::set<std::string> CommandLine::left_behind() const {
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(work())) {
    names.insert(fs::relative(entry.path(), work()).string());
  }
  for (const auto& [name, content] : GetParam().files) {
    for (fs::path path = name; !path.empty(); path = path.parent_path()) names.erase(path.string());
  }
  return names;
}

void CommandLine::expect_untouched_inputs() const {
  for (const auto& [name, content] : GetParam().files) {
    std::ifstream in(work() / name, std::ios::binary);
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), content) << name;
  }
}

TEST_P(CommandLine, EndsAsItShould) {
  const Case& row = GetParam();
  const ProcessResult result = run();
  EXPECT_EQ(result.exit_code, row.exit_code) << result.errors;
  EXPECT_EQ(result.signal, 0);
  EXPECT_LT(result.duration.count(), row.seconds);
  EXPECT_EQ(result.interrupted, !row.interrupt_at.empty());
  expect_parts(row.output_has, result.output);
  expect_parts(row.says, result.output + result.errors);
  expect_untouched_inputs();
  const std::set<std::string> left = left_behind();
  for (const std::string& file : row.leaves) EXPECT_TRUE(left.contains(file)) << file;
  if (row.exit_code == 0) {
    for (const std::string& file : left) EXPECT_EQ(file.find(".partial"), std::string::npos) << file;
    return;
  }
  const std::string line = last_line(result.errors);
  EXPECT_TRUE(line.starts_with("footprint: ")) << result.errors;
  EXPECT_LT(line.size(), 600U) << line;
  expect_parts(row.errors_have, line);
  expect_golden_message(out_of_place(line));
  if (row.keeps_results) return;
  if (row.keeps_work) {
    EXPECT_TRUE(left.contains("out/kept")) << "no finished work";
    std::set<std::string> allowed{"out/kept"};
    for (const std::string& file : row.leaves) allowed.insert(fs::path(file).parent_path().string());
    const auto may_stay = [&](const std::string& file) {
      return file == "out" ||
             std::ranges::any_of(allowed, [&](const std::string& name) { return file.starts_with(name); });
    };
    for (const std::string& file : left) EXPECT_TRUE(may_stay(file)) << file;
  } else {
    EXPECT_EQ(left, std::set<std::string>{});
  }
}

}  // namespace footprint::test
