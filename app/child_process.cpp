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
#include <system_error>
#include <thread>
#include <utility>

#include "app/commands.hpp"
#include "renderer/core/files.hpp"
#include "renderer/languages/compilers.hpp"

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

// The last line that a process wrote, without its own prefix.
std::string last_message(const std::string& errors) {
  constexpr std::string_view prefix = "footprint: ";
  const std::string line = errors.substr(errors.rfind('\n') + 1);
  return line.starts_with(prefix) ? line.substr(prefix.size()) : line;
}

// The error that the process printed, as this process's own.
Error failure_of(const ChildResult& result) {
  const bool known = result.exit_code >= static_cast<int>(ErrorKind::check) &&
                     result.exit_code <= static_cast<int>(ErrorKind::machine);
  return {known ? static_cast<ErrorKind>(result.exit_code) : ErrorKind::machine, "--processes",
          result.errors.empty() ? "a timing process ended without a message" : last_message(result.errors)};
}

FrameTimes times_of_one(const std::vector<std::string>& further, const fs::path& scratch,
                        const std::function<void()>& tick) {
  const fs::path file = scratch / "times.json";
  std::vector<std::string> arguments = own_arguments();
  arguments.insert(arguments.end(), further.begin(), further.end());
  arguments.insert(arguments.end(), {timing_file_option, file.string(), "--quiet"});
  const ChildResult result = run_child(
      {.program = "/proc/self/exe", .arguments = std::move(arguments), .errors = scratch / "times.log"},
      Error(ErrorKind::machine, "--processes", "a timing process cannot be started", "give fewer --processes"), tick);
  if (result.exit_code != 0) throw failure_of(result);
  FrameTimes times = nlohmann::json::parse(file_text(file)).get<FrameTimes>();
  fs::remove(file);
  return times;
}

constexpr std::array<const char*, 3> driver_folders{"/usr/share/vulkan/icd.d", "/etc/vulkan/icd.d",
                                                    "/usr/local/share/vulkan/icd.d"};

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

ChildResult run_compiler(const Chip& chip, const fs::path& driver, const fs::path& folder,
                         const std::function<void()>& tick) {
  return run_child({.program = "/proc/self/exe",
                    .arguments = {"footprint", compile_command, folder.string()},
                    .errors = folder / "log.txt",
                    .variables = {fmt::format("RADV_FORCE_FAMILY={}", chip.family),
                                  fmt::format("VK_ICD_FILENAMES={}", driver.string()),
                                  fmt::format("VK_DRIVER_FILES={}", driver.string()), "VK_INSTANCE_LAYERS=",
                                  "RADV_DEBUG=", "RADV_PERFTEST=", "MESA_SHADER_CACHE_DISABLE=true"}},
                   Error(ErrorKind::machine, "--gpu", "the compiling process cannot be started", "free memory"), tick);
}

ChipOutcomes compile(const Chip& chip, std::span<const GlslProgram> programs, const Progress& progress) {
  require_compilers("--gpu");
  const fs::path driver = driver_file();
  const OutputFolder scratch(fs::temp_directory_path() / "footprint-gpu");  // never moved to its place
  write_programs(programs, scratch.path());
  const auto tick = [&] {
    progress(fmt::format("compiling for {}", chip.name),
             static_cast<double>(compiled_count(scratch.path())) / static_cast<double>(programs.size()));
  };
  const std::string place = fmt::format("--gpu {}", chip.name);
  // A crash leaves one more outcome, unless it comes before the first program.
  for (std::size_t done = 0; done < programs.size();) {
    const ChildResult result = run_compiler(chip, driver, scratch.path(), tick);
    if (result.exit_code > 0) throw Error(ErrorKind::machine, place, last_message(result.errors));
    const std::size_t now = compiled_count(scratch.path());
    if (now == done)
      throw Error(ErrorKind::machine, place, "the driver crashes before it compiles",
                  "install another version of mesa-vulkan-drivers");
    done = now;
  }
  return read_outcomes(scratch.path(), programs.size());
}

}  // namespace

ChildResult run_child(ChildCommand command, const Error& failure, const std::function<void()>& tick) {
  std::vector<char*> arguments;
  for (std::string& argument : command.arguments) arguments.push_back(argument.data());
  arguments.push_back(nullptr);
  std::vector<char*> variables = environment_with(command.variables);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, command.errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (!command.folder.empty()) posix_spawn_file_actions_addchdir_np(&actions, command.folder.c_str());
  pid_t id = 0;
  const int status = posix_spawn(&id, command.program.c_str(), &actions, nullptr, arguments.data(), variables.data());
  posix_spawn_file_actions_destroy(&actions);
  if (status != 0) throw failure;
  int ending = 0;
  try {
    do {
      tick();
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    } while (waitpid(id, &ending, WNOHANG) == 0);
  } catch (...) {
    kill(id, SIGKILL);
    waitpid(id, nullptr, 0);
    throw;
  }
  std::string errors = file_text(command.errors);
  errors.erase(errors.find_last_not_of('\n') + 1);
  fs::remove(command.errors);
  return {WIFEXITED(ending) ? WEXITSTATUS(ending) : -1, std::move(errors)};
}

void write_frame_times(const fs::path& file, const FrameTimes& times) {
  write_file_atomically(file, std::string_view(nlohmann::json(times).dump()));
}

FurtherTimes times_of_processes(int count, const std::vector<std::string>& further, const fs::path& scratch,
                                const Progress& progress) {
  return [=] {
    std::vector<FrameTimes> times;
    for (int process = 0; process < count; ++process) {
      const std::string what = fmt::format("timing in process {} of {}", process + 2, count + 1);
      times.push_back(times_of_one(further, scratch, [&] { progress(what, static_cast<double>(process) / count); }));
    }
    return times;
  };
}

GpuCompiler amd_compiler() { return compile; }

GpuCompiler amd_compiler_if_installed() {
  return [](const Chip& chip, std::span<const GlslProgram> programs, const Progress& progress) {
    try {
      return compile(chip, programs, progress);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::machine) throw;
      return ChipOutcomes{.programs = {programs.size(), {.failure = error.what()}}};
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
