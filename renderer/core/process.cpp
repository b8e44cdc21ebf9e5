// Counts processors and takes the first model name in /proc/cpuinfo; without one, the architecture. The signal handler
// stores the signal in a lock-free atomic and restores its default action: the next one ends the
// process.
#include "renderer/core/process.hpp"

#include <fmt/format.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <condition_variable>
#include <csignal>
#include <fstream>
#include <mutex>
#include <string_view>
#include <utility>

#include "renderer/core/error.hpp"
#include "renderer/core/memory.hpp"

namespace footprint {
namespace {

std::atomic<int> received{0};  // the one thing a signal handler may touch; lock-free, asserted below
static_assert(std::atomic<int>::is_always_lock_free);

extern "C" void remember(int signal_number) {
  received.store(signal_number);
  std::signal(signal_number, SIG_DFL);  // the next one ends the process
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::string architecture() {
  utsname system{};
  return uname(&system) == 0 ? system.machine : "unknown processor";
}

// Neither the stack nor static objects are unwound: the thread that works may use them.
[[noreturn]] void end_process(const std::string& message) {
  const std::string line = fmt::format("{}footprint: {}\n", ::isatty(STDERR_FILENO) == 1 ? "\n" : "", message);
  static_cast<void>(::write(STDERR_FILENO, line.data(), line.size()) == 0);
  ::_exit(static_cast<int>(ErrorKind::machine));
}

}  // namespace

DriverWatch::DriverWatch(std::chrono::milliseconds limit, std::string place, std::string work)
    : watch_([limit, place = std::move(place), work = std::move(work)](const std::stop_token& stop) {
        constexpr std::chrono::milliseconds step(100);
        const std::uint64_t least_memory = std::min(std::uint64_t{512} << 20U, available_memory() / 2);
        const auto end = std::chrono::steady_clock::now() + limit;
        std::mutex mutex;
        std::unique_lock lock(mutex);
        std::condition_variable_any stopped;
        const auto ends = [&] { return stop.stop_requested(); };
        while (!stopped.wait_for(lock, stop, std::min(step, limit), ends)) {
          if (std::chrono::steady_clock::now() >= end)
            end_process(fmt::format("{}: takes more than {:g} s to {} (shorten its loops and its text)", place,
                                    std::chrono::duration<double>(limit).count(), work));
          if (available_memory() < least_memory)
            end_process(fmt::format("{}: takes all memory to {} (shorten its text)", place, work));
        }
      }) {}

std::string host_name() {
  std::array<char, 256> name{};  // POSIX: HOST_NAME_MAX is 255 at most
  if (::gethostname(name.data(), name.size() - 1) != 0 || name.front() == '\0') return "?";
  return name.data();
}

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

void watch_interrupts() {
  received.store(0);
  std::signal(SIGINT, remember);
  std::signal(SIGTERM, remember);
  if (std::signal(SIGHUP, remember) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup: the terminal may close
}

void throw_if_interrupted() {
  if (received.load() == 0) return;
  throw Error(ErrorKind::interrupted, {}, "interrupted: nothing was written");
}

}  // namespace footprint
