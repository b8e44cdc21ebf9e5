// `footprint compile-for-gpu FOLDER`, hidden, and what starts it.
#include "app/gpu_compiler.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cstdlib>
#include <memory>
#include <string>
#include <system_error>

#include "app/child_process.hpp"
#include "app/commands.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/files.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;

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
