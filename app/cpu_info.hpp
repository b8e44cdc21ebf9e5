// Which processor this is: times mean nothing without it.
#pragma once

#include <iosfwd>
#include <string>

namespace footprint {

/// A processor as Linux describes it.
struct CpuInfo {
  std::string model;      ///< "Intel(R) Xeon(R) Processor"; the architecture where the system names no model
  int logical_cores = 1;  ///< those that the system runs, hyper-threads counted
};

/// Reads the format of /proc/cpuinfo.
[[nodiscard]] CpuInfo parse_cpu_info(std::istream& in);

/// This machine's processor, "MODEL, N cores".
[[nodiscard]] std::string describe_cpu();

}  // namespace footprint
