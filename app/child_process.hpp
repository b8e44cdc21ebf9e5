// Further processes of this program, which time frames or compile for GPUs: code that a driver compiles can differ in
// speed from process to process, a driver chooses its chip once, and it may crash.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "experiments/studies/compare.hpp"
#include "renderer/core/error.hpp"
#include "renderer/gpu_cost/compiled_programs.hpp"

namespace footprint {

/// A command to start.
struct ChildCommand {
  std::filesystem::path program;         ///< absolute
  std::vector<std::string> arguments;    ///< with the program's name first
  std::filesystem::path errors;          ///< file for its standard error, which is removed
  std::filesystem::path folder{};        ///< working directory; empty: this program's own
  std::vector<std::string> variables{};  ///< NAME=VALUE, in the place of this program's own
};

/// The end of a command.
struct ChildResult {
  int exit_code = 0;   ///< -1: a signal ended it
  std::string errors;  ///< its standard error, without an end of the line
};

/// Runs a command to its end. Calls `tick` meanwhile, which may throw: the process is killed then. Errors: `failure` if
/// it cannot be started.
[[nodiscard]] ChildResult run_child(ChildCommand command, const Error& failure, const std::function<void()>& tick);

/// The option that makes a command take times, write them to its file and do nothing else.
inline constexpr const char* timing_file_option = "--timing-file";

/// The member of an experiment that such a process of `run` or `check` times.
inline constexpr const char* timing_member_option = "--timing-member";

/// Weight of the main process in the progress of a run; a further process has 1.
inline constexpr double main_process_weight = 10;

/// Writes times for the process that started this one. Errors (machine): the file cannot be written.
void write_frame_times(const std::filesystem::path& file, const FrameTimes& times);

/// Runs this program `count` times when the times are needed, one after the other, each with this process's own
/// arguments, `further` ones, and `--timing-file` in `scratch`, which exists; nothing is left there. Errors: those of
/// such a process, or Error{interrupted}.
[[nodiscard]] FurtherTimes times_of_processes(int count, const std::vector<std::string>& further,
                                              const std::filesystem::path& scratch, const Progress& progress);

/// The hidden subcommand that a compiling process runs.
inline constexpr const char* compile_command = "compile-for-gpu";

/// Starts this program for each chip with Mesa's driver for AMD and the chip's name in its environment. A process that
/// crashes is started again for the programs after the one that crashed it.
/// Throws Error (machine): the build has no compilers, or the driver is not installed, with the package; a process
/// cannot be started.
[[nodiscard]] GpuCompiler amd_compiler();

/// amd_compiler() whose outcomes have the reason if it cannot compile.
[[nodiscard]] GpuCompiler amd_compiler_if_installed();

}  // namespace footprint
