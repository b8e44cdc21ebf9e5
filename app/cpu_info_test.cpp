// /proc/cpuinfo of several architectures.
#include "app/cpu_info.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace footprint {
namespace {

TEST(CpuInfo, CountsProcessorsAndTakesTheFirstModel) {
  std::istringstream in(
      "processor\t: 0\nmodel name\t: A (R) Processor: fast \ncpu cores\t: 1\n\n"
      "processor\t: 1\nmodel name\t: B\nflags\t\t: fpu vme\n");
  const CpuInfo cpu = parse_cpu_info(in);
  EXPECT_EQ(cpu.model, "A (R) Processor: fast");
  EXPECT_EQ(cpu.logical_cores, 2);
}

TEST(CpuInfo, NamesTheArchitectureWhereThereIsNoModel) {
  std::istringstream in("processor\t: 0\nBogoMIPS\t: 243.75\nCPU implementer\t: 0x41\n");
  const CpuInfo cpu = parse_cpu_info(in);
  EXPECT_FALSE(cpu.model.empty());
  EXPECT_EQ(cpu.logical_cores, 1);
}

TEST(CpuInfo, SurvivesAnEmptyFile) {
  std::istringstream in;
  EXPECT_EQ(parse_cpu_info(in).logical_cores, 1);
}

}  // namespace
}  // namespace footprint
