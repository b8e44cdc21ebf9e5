// Runs a program as a process of its own, as a user does: arguments in, exit code and texts out; or a function in its
// place, in a process that is a copy of this one.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace footprint::test {

/// A program as a function: argc, argv to exit code.
using ProgramFunction = int (*)(int, const char* const*);

/// The start, limits and interruption of a process.
struct ProcessRequest {
  std::vector<std::string> command;                  ///< the program's path, then its arguments
  ProgramFunction function = nullptr;                ///< run in place of the program, in a fork of this process
  std::filesystem::path folder;                      ///< scratch, exists; stores its texts while it runs
  std::map<std::string, std::string> environment{};  ///< added to the caller's
  std::filesystem::path standard_output{};           ///< a file or device instead of the text that comes back
  std::optional<std::uint64_t> file_size_limit{};    ///< bytes that one file may have: simulates a full disk
  std::string interrupt_at{};                        ///< SIGINT is sent once standard error contains this text
  std::chrono::seconds timeout{120};
};

struct ProcessResult {
  int exit_code = -1;  ///< -1: a signal ended it
  int signal = 0;      ///< that signal; SIGKILL after the timeout
  bool interrupted = false;
  std::string output, errors;
  std::chrono::duration<double> duration{0};
};

/// Runs to the end. Throws std::system_error if the process cannot be started; std::logic_error where a function is to
/// run in a fork of a process that has started threads.
[[nodiscard]] ProcessResult run_process(const ProcessRequest& request);

}  // namespace footprint::test
