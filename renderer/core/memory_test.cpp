// Memory limits read from made-up /proc and /sys trees.
#include "renderer/core/memory.hpp"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <fstream>
#include <limits>
#include <string>

#include "renderer/core/error.hpp"
#include "tests/support/fresh_folder.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

class MemoryTest : public testing::Test {
 protected:
  void file(const fs::path& path, const std::string& text) const {
    fs::create_directories((root_ / path).parent_path());
    std::ofstream(root_ / path) << text;
  }

  const fs::path root_ = test::fresh_folder();
};

TEST_F(MemoryTest, AnUnknownLimitIsNone) { EXPECT_EQ(available_memory(root_), unlimited); }

TEST_F(MemoryTest, ReadsAvailableNotFree) {
  file("proc/meminfo", "MemTotal:  8000 kB\nMemFree:  100 kB\nMemAvailable:    4000 kB\n");
  EXPECT_EQ(available_memory(root_), 4000U * 1024U);
}

TEST_F(MemoryTest, TightestParentOfVersion2Counts) {
  file("proc/meminfo", "MemAvailable: 4000 kB\n");
  file("proc/self/cgroup", "0::/outer/inner\n");
  file("sys/fs/cgroup/outer/memory.max", "1000000\n");
  file("sys/fs/cgroup/outer/memory.current", "400000\n");
  file("sys/fs/cgroup/outer/memory.stat", "anon 1\ninactive_file 100000\nactive_file 7\n");
  file("sys/fs/cgroup/outer/inner/memory.max", "max\n");
  file("sys/fs/cgroup/outer/inner/memory.current", "400000\n");
  EXPECT_EQ(available_memory(root_), 1000000U - 300000U);
}

TEST_F(MemoryTest, Version1InsideAContainer) {
  file("proc/self/cgroup", "4:cpu,memory:/docker/0123\n2:cpuset:/\n");
  file("sys/fs/cgroup/memory/memory.limit_in_bytes", "5000\n");
  file("sys/fs/cgroup/memory/memory.usage_in_bytes", "6000\n");
  EXPECT_EQ(available_memory(root_), 0U);
}

TEST_F(MemoryTest, LimitOfTheAddressSpace) {
  file("proc/meminfo", "MemAvailable: 4000000 kB\n");
  file("proc/self/status", "Name: footprint\nVmPeak:\t 900 kB\nVmSize:\t 700 kB\nVmHWM:\t 300 kB\n");
  file("proc/self/limits", "Limit  Soft  Hard  Units\nMax address space         1024000   unlimited   bytes\n");
  EXPECT_EQ(available_memory(root_), 300U * 1024U);
  ASSERT_TRUE(limited_address_space(root_).has_value());
  EXPECT_EQ(limited_address_space(root_)->limit, 1024000U);
  EXPECT_EQ(taken_memory_text(root_),
            "up to 900 KiB of address space was taken of the 1000 KiB that `ulimit -v` grants");
  file("proc/self/limits", "Max address space         unlimited            unlimited            bytes\n");
  EXPECT_FALSE(limited_address_space(root_).has_value());
  EXPECT_EQ(available_memory(root_), 4000000ULL * 1024U);
  EXPECT_EQ(taken_memory_text(root_), "up to 300 KiB was taken, 3.81 GiB is available now");
}

TEST(FrameBytes, SaturatesInsteadOfWrapping) {
  EXPECT_EQ(frame_bytes(512, 256, 16), 512U * 256U * 16U);
  EXPECT_EQ(frame_bytes(1000000, 1000000, 16), 16000000000000U);
  EXPECT_EQ(frame_bytes(unlimited, 2, 1), unlimited);
  EXPECT_EQ(frame_bytes(1ULL << 31, 1ULL << 31, 16), unlimited);
}

TEST(ReadableBytes, PicksTheUnit) {
  EXPECT_EQ(readable_bytes(0), "0 B");
  EXPECT_EQ(readable_bytes(1023), "1023 B");
  EXPECT_EQ(readable_bytes(1536), "1.50 KiB");
  EXPECT_EQ(readable_bytes(1024 * 1024 - 1), "1.00 MiB");
  EXPECT_EQ(readable_bytes(unlimited), "16.0 EiB");
}

TEST(RequireMemory, RefusesWhatNoMachineHas) {
  EXPECT_NO_THROW(require_memory(1, "a byte"));
  try {
    require_memory(frame_bytes(1000000, 1000000, 16), "a frame of 1000000 x 1000000");
    FAIL() << "14.6 TiB were granted";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::machine);
    EXPECT_NE(error.message().find("a frame of 1000000 x 1000000 needs 14.6 TiB"), std::string::npos) << error.what();
    EXPECT_NE(error.hint().find("--size"), std::string::npos);
  }
}

// The soft limit of this process's address space, lowered to what it uses now and `more`; restored at the end.
class LoweredLimit {
 public:
  explicit LoweredLimit(std::uint64_t more) {
    getrlimit(RLIMIT_AS, &before_);
    limit_growth(more);
  }
  LoweredLimit(const LoweredLimit&) = delete;
  LoweredLimit& operator=(const LoweredLimit&) = delete;
  ~LoweredLimit() { setrlimit(RLIMIT_AS, &before_); }

 private:
  rlimit before_{};
};

TEST(LimitGrowth, RefusesMoreAndLiftsNoLowerLimit) {
  constexpr std::uint64_t mebibyte = 1 << 20;
  const auto is_granted = [](std::uint64_t bytes) {
    void* const found = mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (found == MAP_FAILED) return false;
    munmap(found, bytes);
    return true;
  };
  ASSERT_TRUE(is_granted(512 * mebibyte));
  const LoweredLimit limit(256 * mebibyte);
  EXPECT_TRUE(is_granted(128 * mebibyte));
  EXPECT_FALSE(is_granted(512 * mebibyte));
  limit_growth(1024 * mebibyte);
  EXPECT_FALSE(is_granted(512 * mebibyte));
}

TEST(RequireTexels, RefusesWhatTheAddressSpaceDoesNotHave) {
  constexpr std::uint64_t mebibyte = 1 << 20;
  const LoweredLimit limit(100 * mebibyte);
  EXPECT_NO_THROW(require_texels(2048, 2048, 64 * mebibyte, "a map"));
  EXPECT_NO_THROW(require_texels(1, 1, 64 * mebibyte - 1, "a small map"));
  try {
    require_texels(4096, 4096, 256 * mebibyte, "a map");
    FAIL() << "256 MiB were granted";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::machine);
    EXPECT_NE(error.message().find("a map of 4096x4096 texels needs 256 MiB"), std::string::npos) << error.what();
    EXPECT_NE(error.message().find("`ulimit -v`"), std::string::npos) << error.what();
    EXPECT_NE(error.hint().find("smaller textures"), std::string::npos);
  }
}

}  // namespace
}  // namespace footprint
