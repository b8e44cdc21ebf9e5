// One way to call the program and what must come of it: exit code, one clear error line, nothing half-written.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tests/support/fresh_folder.hpp"
#include "tests/support/process.hpp"

namespace footprint::test {

/// A row of a table. `{}` in arguments and in the environment is the case's own folder.
struct Case {
  std::string name;
  std::vector<std::string> arguments{};
  int exit_code = 0;
  std::vector<std::string> output_has{};       ///< texts on standard output
  std::vector<std::string> errors_have{};      ///< its place in the error line, whose words are in messages.golden
  std::vector<std::string> says{};             ///< texts on either
  std::map<std::string, std::string> files{};  ///< input files: path in the case's folder, content
  std::map<std::string, std::string> environment{};
  std::string standard_output{};                   ///< a device to write to
  std::optional<std::uint64_t> file_size_limit{};  ///< bytes a file may have: a full disk
  std::string interrupt_at{};                      ///< Ctrl-C at this text on standard error
  std::set<std::string> leaves{};                  ///< files that must be there afterwards
  bool keeps_work = false;       ///< of a run that failed, what it had finished stays in out/kept, and beside `leaves`
  bool keeps_results = false;    ///< of a run that lost a file, everything else is there
  double seconds = 120;          ///< it must have ended by then
  bool needs_compilers = false;  ///< skipped in a build without compilers of shaders
  bool starts_program = false;   ///< by its file, as a shell does: rows of processes that start themselves,
                                 ///< and of variables that the loader of libraries reads
};

void PrintTo(const Case& row, std::ostream* out);

/// Rows for both subcommands that render: NameOfCompare and NameOfRender, with a small frame and an output. A row's
/// arguments are the scene and what goes with it.
[[nodiscard]] std::vector<Case> of_compare_and_render(const std::vector<Case>& rows);

/// For INSTANTIATE_TEST_SUITE_P.
[[nodiscard]] std::string case_name(const ::testing::TestParamInfo<Case>& info);

/// Runs a row in a folder of its own.
class CommandLine : public ::testing::TestWithParam<Case> {
 protected:
  void SetUp() override;

  [[nodiscard]] ProcessResult run() const;
  /// Everything below the case's folder but the input files and their folders.
  [[nodiscard]] std::set<std::string> left_behind() const;
  void expect_untouched_inputs() const;
  /// A message without the paths of the case's folder and of the sources.
  [[nodiscard]] std::string out_of_place(std::string text) const;

 private:
  [[nodiscard]] std::filesystem::path work() const { return folder_ / "work"; }
  [[nodiscard]] std::string in_place(std::string text) const;

  const std::filesystem::path folder_ = fresh_folder();
};

}  // namespace footprint::test
