// The machine that the process runs on, Ctrl-C, turned into an Error at the next safe point, and a watch over a driver.
#pragma once

#include <chrono>
#include <iosfwd>
#include <string>
#include <thread>

namespace footprint {

/// The network name of this machine; "?" if it has none.
[[nodiscard]] std::string host_name();

/// A processor as Linux describes it.
struct CpuInfo {
  std::string model;      ///< "Intel(R) Xeon(R) Processor"; the architecture if the system names no model
  int logical_cores = 1;  ///< including hyper-threads
};

/// Reads the format of /proc/cpuinfo.
[[nodiscard]] CpuInfo parse_cpu_info(std::istream& in);

/// This machine's processor, "MODEL, N cores".
[[nodiscard]] std::string describe_cpu();

/// Installs handlers for SIGINT, SIGTERM and SIGHUP (unless it is ignored) that set a flag. A second signal ends the
/// process at once.
void watch_interrupts();

/// Throws Error (interrupted) after such a signal. It is cheap, so call it in every long loop.
void throw_if_interrupted();

/// Ends the process with exit code 3 and one message if work takes longer than a limit, or all memory: for calls of a
/// driver, which nothing can interrupt.
class DriverWatch {
 public:
  /// place, work: "PLACE: takes more than 60 s to WORK".
  DriverWatch(std::chrono::milliseconds limit, std::string place, std::string work);

 private:
  std::jthread watch_;
};

}  // namespace footprint
