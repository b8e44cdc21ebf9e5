// Available memory, which is checked before a large allocation.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace footprint {

/// A limit of this process's address space (`ulimit -v`), in bytes.
struct AddressSpace {
  std::uint64_t limit = 0, left = 0;
};

/// The limit of the address space; none if it is unlimited. Files are read under `root`.
[[nodiscard]] std::optional<AddressSpace> limited_address_space(const std::filesystem::path& root = "/");

/// Lets this process's address space grow by `bytes` at most from here on, unless its limit is lower. Nothing if the
/// system refuses.
void limit_growth(std::uint64_t bytes);

/// Bytes that this process can allocate without swapping: the least of MemAvailable in /proc/meminfo and what the
/// limits of its control groups (versions 1 and 2, with all parents) and of its address space leave. The largest
/// std::uint64_t if the system reports none of them. Files are read under `root`.
[[nodiscard]] std::uint64_t available_memory(const std::filesystem::path& root = "/");

/// Bytes of width x height pixels of `bytes_per_pixel`; the largest std::uint64_t if the product overflows.
[[nodiscard]] std::uint64_t frame_bytes(std::uint64_t width, std::uint64_t height, std::uint64_t bytes_per_pixel);

/// "0 B", "640 B", "1.50 KiB", "12.3 MiB", "640 GiB": three digits, binary multiples.
[[nodiscard]] std::string readable_bytes(std::uint64_t bytes);

/// The peak of this process and its limit, for the message of a failed allocation. Files are read under `root`.
[[nodiscard]] std::string taken_memory_text(const std::filesystem::path& root = "/");

/// Errors (machine): `bytes` exceed available_memory(). The message begins with `what`, such as "a frame of 8192 x
/// 8192"; `hint` says how to need less.
void require_memory(std::uint64_t bytes, std::string_view what,
                    std::string_view hint = "give a smaller --size, or free memory");

/// Checks an allocation of `bytes` for a map, mip chain or texture of width x height texels, which `what` names.
/// Allocations below 64 MiB are not checked, because reading the limits would take longer than filling them.
/// Errors (machine): as require_memory.
void require_texels(int width, int height, std::uint64_t bytes, std::string_view what);

}  // namespace footprint
