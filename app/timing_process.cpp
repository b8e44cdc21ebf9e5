// Starts this program again, waits for it, and reads back what it measured.
#include "app/timing_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>

#include "renderer/core/error.hpp"
#include "renderer/core/files.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;

std::string read_text(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// The arguments that this process was started with; they are separated by zero bytes.
std::vector<std::string> own_arguments() {
  std::ifstream in("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> arguments;
  for (std::string argument; std::getline(in, argument, '\0');) arguments.push_back(argument);
  return arguments;
}

// A child process that does not outlive its owner.
class Child {
 public:
  // Starts this program with other arguments, its standard error in a file.
  Child(std::vector<std::string> arguments, const fs::path& errors) {
    std::vector<char*> pointers;
    pointers.reserve(arguments.size() + 1);
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int failure = posix_spawn(&id_, "/proc/self/exe", &actions, nullptr, pointers.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failure == 0) return;
    id_ = 0;
    throw Error(ErrorKind::machine, "--processes", "a process for timing cannot be started",
                "ask for fewer --processes");
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    if (id_ == 0) return;
    kill(id_, SIGKILL);
    waitpid(id_, nullptr, 0);
  }

  // The exit code, or -1 if a signal ended it. Empty while it runs.
  [[nodiscard]] std::optional<int> poll() {
    int status = 0;
    if (waitpid(id_, &status, WNOHANG) == 0) return std::nullopt;
    id_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  pid_t id_ = 0;
};

// What the process said was wrong, as this process's own error.
Error failure_of(int exit_code, std::string text) {
  constexpr std::string_view prefix = "footprint: ";
  while (!text.empty() && text.back() == '\n') text.pop_back();
  if (const auto at = text.rfind(prefix); at != std::string::npos) text = text.substr(at + prefix.size());
  if (text.empty()) text = "a process for timing ended without a word";
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
  Child child(std::move(arguments), errors);
  std::optional<int> exit_code;
  while (!exit_code) {
    tick();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    exit_code = child.poll();
  }
  if (*exit_code != 0) throw failure_of(*exit_code, read_text(errors));
  FrameTimes times = nlohmann::json::parse(read_text(file)).get<FrameTimes>();
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
