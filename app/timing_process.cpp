// Starts this program again, waits for it, and reads back what it measured.
#include "app/timing_process.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/child_process.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/files.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;

// The arguments that this process was started with; they are separated by zero bytes.
std::vector<std::string> own_arguments() {
  std::ifstream in("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> arguments;
  for (std::string argument; std::getline(in, argument, '\0');) arguments.push_back(argument);
  return arguments;
}

// The error that the process printed, as this process's own.
Error failure_of(int exit_code, std::string text) {
  constexpr std::string_view prefix = "footprint: ";
  while (!text.empty() && text.back() == '\n') text.pop_back();
  if (const auto at = text.rfind(prefix); at != std::string::npos) text = text.substr(at + prefix.size());
  if (text.empty()) text = "a timing process ended without a message";
  const bool known =
      exit_code >= static_cast<int>(ErrorKind::check) && exit_code <= static_cast<int>(ErrorKind::machine);
  return {known ? static_cast<ErrorKind>(exit_code) : ErrorKind::machine, "--processes", text};
}

FrameTimes times_of_one(const std::vector<std::string>& further, const fs::path& scratch,
                        const std::function<void()>& tick) {
  const fs::path file = scratch / "times.json";
  const fs::path errors = scratch / "times.log";
  std::vector<std::string> arguments = own_arguments();
  arguments.insert(arguments.end(), further.begin(), further.end());
  arguments.insert(arguments.end(), {timing_file_option, file.string(), "--quiet"});
  ChildProcess child(
      {.program = "/proc/self/exe", .arguments = std::move(arguments), .errors = errors, .folder = {}},
      Error(ErrorKind::machine, "--processes", "a timing process cannot be started", "give fewer --processes"));
  const int exit_code = child.wait(tick);
  if (exit_code != 0) throw failure_of(exit_code, file_text(errors));
  FrameTimes times = nlohmann::json::parse(file_text(file)).get<FrameTimes>();
  fs::remove(file);
  fs::remove(errors);
  return times;
}

}  // namespace

void write_frame_times(const fs::path& file, const FrameTimes& times) {
  write_file_atomically(file, std::string_view(nlohmann::json(times).dump()));
}

std::vector<FrameTimes> times_of_processes(int count, const std::vector<std::string>& further, const fs::path& scratch,
                                           const Progress& progress) {
  std::vector<FrameTimes> times;
  for (int process = 0; process < count; ++process) {
    const std::string what = fmt::format("timing in process {} of {}", process + 2, count + 1);
    times.push_back(times_of_one(further, scratch, [&] { progress(what, static_cast<double>(process) / count); }));
  }
  return times;
}

}  // namespace footprint
