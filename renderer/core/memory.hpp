// How much memory there is left, asked before a frame takes more than that.
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

/// Nothing where there is no such limit. Files are looked up under `root`.
[[nodiscard]] std::optional<AddressSpace> limited_address_space(const std::filesystem::path& root = "/");

/// Bytes that this process may still take without swapping: /proc/meminfo's MemAvailable, or what the limits of its
/// control groups (versions 1 and 2, every parent counted) or of its address space leave, where that is less. Files are
/// looked up under `root`. The largest std::uint64_t where the system tells nothing.
[[nodiscard]] std::uint64_t available_memory(const std::filesystem::path& root = "/");

/// Bytes of width x height pixels of `bytes_per_pixel`; the largest std::uint64_t if that does not fit.
[[nodiscard]] std::uint64_t frame_bytes(std::uint64_t width, std::uint64_t height, std::uint64_t bytes_per_pixel);

/// "0 B", "640 B", "1.50 KiB", "12.3 MiB", "640 GiB": three figures, binary multiples.
[[nodiscard]] std::string readable_bytes(std::uint64_t bytes);

/// What was taken at most, and what limits it: for one who is told that there was no more.
[[nodiscard]] std::string taken_memory_text(const std::filesystem::path& root = "/");

/// Throws Error{machine} if `bytes` is more than `available_memory()`; `what` is what they are for ("a frame of 8192 x
/// 8192") and `hint` says how to need less.
void require_memory(std::uint64_t bytes, std::string_view what,
                    std::string_view hint = "ask for a smaller --size, or free memory");

}  // namespace footprint
