// Starts the program by posix_spawn with standard error in a file, and polls it so that interrupts are noticed.
#include "app/child_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "app/commands.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/files.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;

// This program's environment with some variables replaced; null at the end.
std::vector<char*> environment_with(std::vector<std::string>& replaced) {
  const auto name_of = [](std::string_view variable) { return variable.substr(0, variable.find('=')); };
  std::vector<char*> variables;
  variables.reserve(replaced.size());
  for (std::string& own : replaced) variables.push_back(own.data());
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const bool is_replaced =
        std::ranges::any_of(replaced, [&](const std::string& own) { return name_of(own) == name_of(*variable); });
    if (!is_replaced) variables.push_back(*variable);
  }
  variables.push_back(nullptr);
  return variables;
}

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

constexpr std::array<const char*, 3> driver_folders{"/usr/share/vulkan/icd.d", "/etc/vulkan/icd.d",
                                                    "/usr/local/share/vulkan/icd.d"};

// A folder of this process that is removed at the end.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string path = (fs::temp_directory_path() / "footprint-gpu-XXXXXX").string();
    if (mkdtemp(path.data()) == nullptr)
      throw Error(ErrorKind::machine, path, "cannot be created", "set TMPDIR to a folder that can be written");
    path_ = path;
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder() {
    std::error_code none;
    fs::remove_all(path_, none);
  }
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

// The file with the path of Mesa's driver for AMD, for Vulkan's loader: that of VK_DRIVER_FILES if it is set.
fs::path driver_file() {
  if (const char* own = std::getenv("VK_DRIVER_FILES"); own != nullptr && *own != 0) {
    if (fs::exists(own)) return own;
    throw Error(ErrorKind::machine, "VK_DRIVER_FILES", fmt::format("{} does not exist", own),
                "unset it, or name the file radeon_icd.*.json of Mesa's driver for AMD");
  }
  for (const char* folder : driver_folders) {
    std::error_code none;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with("radeon_icd.") && name.ends_with(".json")) return entry.path();
    }
  }
  throw Error(ErrorKind::machine, "Vulkan", "Mesa's driver for AMD is not installed",
              "install the packages mesa-vulkan-drivers and libvulkan1");
}

// The last line that the process wrote, without its own prefix.
std::string last_message(const fs::path& log) {
  std::string text = file_text(log);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  const auto line = text.rfind('\n');
  if (line != std::string::npos) text = text.substr(line + 1);
  constexpr std::string_view prefix = "footprint: ";
  return text.starts_with(prefix) ? text.substr(prefix.size()) : text;
}

int run_process(const Chip& chip, const fs::path& driver, const fs::path& folder, const std::function<void()>& tick) {
  ChildProcess child({.program = "/proc/self/exe",
                      .arguments = {"footprint", compile_command, folder.string()},
                      .errors = folder / "log.txt",
                      .folder = {},
                      .variables = {fmt::format("RADV_FORCE_FAMILY={}", chip.family),
                                    fmt::format("VK_ICD_FILENAMES={}", driver.string()),
                                    fmt::format("VK_DRIVER_FILES={}", driver.string()), "VK_INSTANCE_LAYERS=",
                                    "RADV_DEBUG=", "RADV_PERFTEST=", "MESA_SHADER_CACHE_DISABLE=true"}},
                     Error(ErrorKind::machine, "--gpu", "the compiling process cannot be started", "free memory"));
  return child.wait(tick);
}

ChipOutcomes compile(const Chip& chip, std::span<const SpirvProgram> programs, const Progress& progress) {
  const fs::path driver = driver_file();
  const ScratchFolder scratch;
  write_programs(programs, scratch.path());
  const auto tick = [&] {
    progress(fmt::format("compiling for {}", chip.name),
             static_cast<double>(compiled_count(scratch.path())) / static_cast<double>(programs.size()));
  };
  const std::string place = fmt::format("--gpu {}", chip.name);
  // A crash leaves one more outcome, unless it comes before the first program.
  for (std::size_t done = 0; done < programs.size();) {
    const int exit_code = run_process(chip, driver, scratch.path(), tick);
    if (exit_code > 0) throw Error(ErrorKind::machine, place, last_message(scratch.path() / "log.txt"));
    const std::size_t now = compiled_count(scratch.path());
    if (now == done)
      throw Error(ErrorKind::machine, place, "the driver crashes before it compiles",
                  "install another version of mesa-vulkan-drivers");
    done = now;
  }
  return read_outcomes(scratch.path(), programs.size());
}

}  // namespace

ChildProcess::ChildProcess(ChildCommand command, const Error& failure) {
  std::vector<char*> pointers;
  pointers.reserve(command.arguments.size() + 1);
  for (std::string& argument : command.arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  std::vector<char*> variables = environment_with(command.variables);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, command.errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (!command.folder.empty()) posix_spawn_file_actions_addchdir_np(&actions, command.folder.c_str());
  const int status = posix_spawn(&id_, command.program.c_str(), &actions, nullptr, pointers.data(), variables.data());
  posix_spawn_file_actions_destroy(&actions);
  if (status == 0) return;
  id_ = 0;
  throw failure;
}

ChildProcess::~ChildProcess() {
  if (id_ == 0) return;
  kill(id_, SIGKILL);
  waitpid(id_, nullptr, 0);
}

std::optional<int> ChildProcess::poll() {
  int status = 0;
  if (waitpid(id_, &status, WNOHANG) == 0) return std::nullopt;
  id_ = 0;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

int ChildProcess::wait(const std::function<void()>& tick) {
  for (;;) {
    tick();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    if (const std::optional<int> exit_code = poll()) return *exit_code;
  }
}

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

GpuCompiler amd_compiler() { return compile; }

GpuCompiler amd_compiler_if_installed() {
  return [](const Chip& chip, std::span<const SpirvProgram> programs, const Progress& progress) {
    try {
      return compile(chip, programs, progress);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::machine) throw;
      return ChipOutcomes{.device = {}, .programs = {programs.size(), {.stage = {}, .failure = error.what()}}};
    }
  };
}

void add_compile_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(compile_command, "Compile the programs in a folder");
  const auto folder = std::make_shared<std::string>();
  command->add_option("folder", *folder)->required();
  command->group("");  // no part of the help
  command->callback([folder] { compile_programs(*folder); });
}

}  // namespace footprint
