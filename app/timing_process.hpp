// Frame times taken by further processes of this program: code that a driver compiles can differ in speed from process
// to process.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/studies/compare.hpp"

namespace footprint {

/// The option that makes a command take times, write them to its file and do nothing else.
inline constexpr const char* timing_file_option = "--timing-file";

/// The member of an experiment that such a process of `run` or `check` times.
inline constexpr const char* timing_member_option = "--timing-member";

/// Weight of the main process in the progress of a run; a further process has 1.
inline constexpr double main_process_weight = 10;

/// Writes times for the process that started this one. Errors (machine): the file cannot be written.
void write_frame_times(const std::filesystem::path& file, const FrameTimes& times);

/// Runs this program `count` times, one after the other, each with this process's own arguments, `further` ones, and
/// `--timing-file` in `scratch`, which exists; nothing is left there. Errors: those of such a process, or
/// Error{interrupted}.
[[nodiscard]] std::vector<FrameTimes> times_of_processes(int count, const std::vector<std::string>& further,
                                                         const std::filesystem::path& scratch,
                                                         const Progress& progress);

}  // namespace footprint
