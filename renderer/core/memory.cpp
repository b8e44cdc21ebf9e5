// Reads the limits of memory from /proc and /sys.
#include "renderer/core/memory.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <string>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

// The files that limit memory in one version of control groups.
struct GroupFiles {
  std::string_view mount, limit, usage, reclaimable;  // `reclaimable` is a key of the group's memory.stat
};
constexpr GroupFiles version_1{"sys/fs/cgroup/memory", "memory.limit_in_bytes", "memory.usage_in_bytes",
                               "total_inactive_file"};
constexpr GroupFiles version_2{"sys/fs/cgroup", "memory.max", "memory.current", "inactive_file"};

std::optional<std::uint64_t> read_number(const fs::path& file) {
  std::ifstream in(file);
  std::uint64_t number = 0;
  if (in >> number) return number;
  return std::nullopt;  // also for the word `max`: unlimited
}

// The number after `key` in a file of "key number" lines.
std::optional<std::uint64_t> read_keyed_number(const fs::path& file, std::string_view key) {
  std::ifstream in(file);
  std::string word, rest;
  while (in >> word) {
    std::uint64_t number = 0;
    if (word == key && in >> number) return number;
    std::getline(in, rest);
  }
  return std::nullopt;
}

// Bytes that a group leaves to its processes. Cached file pages count as available, because the kernel frees them on
// demand.
std::uint64_t left_in_group(const fs::path& folder, const GroupFiles& files) {
  const auto limit = read_number(folder / files.limit);
  const auto usage = read_number(folder / files.usage);
  if (!limit || !usage) return unlimited;
  const std::uint64_t reclaimable = read_keyed_number(folder / "memory.stat", files.reclaimable).value_or(0);
  const std::uint64_t used = *usage - std::min(*usage, reclaimable);
  return *limit - std::min(*limit, used);
}

// The tightest limit from the group `group` up to the root. Only groups that have a folder count, because a container
// shows its own group as the root.
std::uint64_t left_in_groups(const fs::path& root, const GroupFiles& files, std::string_view group) {
  const fs::path mount = root / files.mount;
  std::uint64_t left = left_in_group(mount, files);
  for (fs::path path = fs::path(group).relative_path(); !path.empty(); path = path.parent_path()) {
    left = std::min(left, left_in_group(mount / path, files));
  }
  return left;
}

std::uint64_t left_by_groups(const fs::path& root) {
  std::ifstream in(root / "proc/self/cgroup");  // lines "number:controllers:group"
  std::uint64_t left = unlimited;
  for (std::string line; std::getline(in, line);) {
    const std::size_t first = line.find(':');
    const std::size_t second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = fmt::format(",{},", line.substr(first + 1, second - first - 1));
    const std::string_view group = std::string_view(line).substr(second + 1);
    if (controllers == ",,") left = std::min(left, left_in_groups(root, version_2, group));
    if (controllers.find(",memory,") != std::string::npos) {
      left = std::min(left, left_in_groups(root, version_1, group));
    }
  }
  return left;
}

std::uint64_t own_bytes(const fs::path& root, std::string_view key) {
  return 1024 * read_keyed_number(root / "proc/self/status", key).value_or(0);
}

// Without the limit of address space, which threads change from one reading to the next.
std::uint64_t left_by_machine(const fs::path& root) {
  const auto kibibytes = read_keyed_number(root / "proc/meminfo", "MemAvailable:");
  return std::min(kibibytes ? *kibibytes * 1024 : unlimited, left_by_groups(root));
}

}  // namespace

std::optional<AddressSpace> limited_address_space(const fs::path& root) {
  std::ifstream in(root / "proc/self/limits");  // lines "Max address space     SOFT     HARD     bytes"
  constexpr std::string_view name = "Max address space";
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with(name)) continue;
    std::uint64_t limit = 0;
    if (!(std::istringstream(line.substr(name.size())) >> limit)) return {};  // the word `unlimited`
    return AddressSpace{limit, limit - std::min(limit, own_bytes(root, "VmSize:"))};
  }
  return {};
}

void limit_growth(std::uint64_t bytes) {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0) return;
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_cur, own_bytes("/", "VmSize:") + bytes);
  setrlimit(RLIMIT_AS, &limit);
}

std::uint64_t available_memory(const fs::path& root) {
  const auto space = limited_address_space(root);
  return std::min(left_by_machine(root), space ? space->left : unlimited);
}

std::string taken_memory_text(const fs::path& root) {
  if (const auto space = limited_address_space(root))
    return fmt::format("up to {} of address space was taken of the {} that `ulimit -v` grants",
                       readable_bytes(own_bytes(root, "VmPeak:")), readable_bytes(space->limit));
  return fmt::format("up to {} was taken, {} is available now", readable_bytes(own_bytes(root, "VmHWM:")),
                     readable_bytes(available_memory(root)));
}

std::uint64_t frame_bytes(std::uint64_t width, std::uint64_t height, std::uint64_t bytes_per_pixel) {
  std::uint64_t bytes = 0;
  const bool too_many =
      __builtin_mul_overflow(width, height, &bytes) || __builtin_mul_overflow(bytes, bytes_per_pixel, &bytes);
  return too_many ? unlimited : bytes;
}

std::string readable_bytes(std::uint64_t bytes) {
  if (bytes < 1024) return fmt::format("{} B", bytes);
  constexpr std::array<std::string_view, 6> units{"KiB", "MiB", "GiB", "TiB", "PiB", "EiB"};
  double number = static_cast<double>(bytes) / 1024.0;
  std::size_t unit = 0;
  for (; number >= 1023.5 && unit + 1 < units.size(); ++unit) number /= 1024.0;
  const int decimals = number < 9.995 ? 2 : number < 99.95 ? 1 : 0;
  return fmt::format("{:.{}f} {}", number, decimals, units[unit]);
}

void require_memory(std::uint64_t bytes, std::string_view what, std::string_view hint) {
  const auto space = limited_address_space();
  const std::uint64_t available = std::min(left_by_machine("/"), space ? space->left : unlimited);
  if (bytes <= available) return;
  const std::string limit = space && space->left == available
                                ? fmt::format(" of the {} that `ulimit -v` grants", readable_bytes(space->limit))
                                : std::string();
  throw Error(ErrorKind::machine, {},
              fmt::format("{} needs {} of memory, and {}{} is available", what, readable_bytes(bytes),
                          readable_bytes(available), limit),
              std::string(hint));
}

void require_texels(int width, int height, std::uint64_t bytes, std::string_view what) {
  constexpr std::uint64_t least_checked = std::uint64_t{64} << 20;
  if (bytes < least_checked) return;
  require_memory(bytes, fmt::format("{} of {}x{} texels", what, width, height), "use smaller textures, or free memory");
}

}  // namespace footprint
