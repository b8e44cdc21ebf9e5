// The processor, without which times cannot be compared.
#pragma once

#include <iosfwd>
#include <string>

namespace footprint {

/// A processor as Linux describes it.
struct CpuInfo {
  std::string model;      ///< "Intel(R) Xeon(R) Processor"; the architecture if the system names no model
  int logical_cores = 1;  ///< including hyper-threads
};

/// Reads the format of /proc/cpuinfo.
[[nodiscard]] CpuInfo parse_cpu_info(std::istream& in);

/// This machine's processor, "MODEL, N cores".
[[nodiscard]] std::string describe_cpu();

}  // namespace footprint
