// `footprint info`: the program, the ways to OpenGL on this machine, and the machine.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>

#include "app/backend_text.hpp"
#include "app/commands.hpp"
#include "app/cpu_info.hpp"
#include "app/standard_output.hpp"
#include "renderer/core/memory.hpp"

namespace footprint {
namespace {

constexpr const char* info_examples =
    "Examples:\n"
    "  footprint info                               backends with their limits, processor, memory\n"
    "  footprint info | grep egl-device             the GPUs, with their numbers for --device";

void run_info() {
  std::string text = "footprint " FOOTPRINT_VERSION "\n\nbackends\n";
  for (const gl::BackendReport& report : gl::probe_backends()) text += backend_text(report);
  text += fmt::format("\nmachine\n  {:<22} {}\n  {:<22} {} available\n", "processor", describe_cpu(), "memory",
                      readable_bytes(available_memory()));
  write_output(text);
}

}  // namespace

void add_info_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("info", "Show version, OpenGL backends and limits");
  command->footer(info_examples);
  command->callback(run_info);
}

}  // namespace footprint
