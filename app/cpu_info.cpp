// Counts processors and takes the first model name in /proc/cpuinfo; without one, the architecture.
#include "app/cpu_info.hpp"

#include <fmt/format.h>
#include <sys/utsname.h>

#include <algorithm>
#include <fstream>
#include <istream>
#include <string_view>

namespace footprint {
namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::string architecture() {
  utsname system{};
  return uname(&system) == 0 ? system.machine : "unknown processor";
}

}  // namespace

CpuInfo parse_cpu_info(std::istream& in) {
  CpuInfo cpu{.model = {}, .logical_cores = 0};
  for (std::string line; std::getline(in, line);) {
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos) continue;
    const std::string_view key = trimmed(std::string_view(line).substr(0, colon));
    const std::string_view value = trimmed(std::string_view(line).substr(colon + 1));
    if (key == "processor") ++cpu.logical_cores;
    if (key == "model name" && cpu.model.empty()) cpu.model = value;
  }
  if (cpu.model.empty()) cpu.model = architecture();
  cpu.logical_cores = std::max(cpu.logical_cores, 1);
  return cpu;
}

std::string describe_cpu() {
  std::ifstream in("/proc/cpuinfo");
  const CpuInfo cpu = parse_cpu_info(in);
  return fmt::format("{}, {} {}", cpu.model, cpu.logical_cores, cpu.logical_cores == 1 ? "core" : "cores");
}

}  // namespace footprint
