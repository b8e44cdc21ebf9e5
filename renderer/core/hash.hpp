// A content hash for cache keys and to compare outputs. Not for security.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace footprint {

/// FNV-1a, 64 bit (Fowler, Noll, Vo), of no bytes.
inline constexpr std::uint64_t fnv1a_start = 0xcbf29ce484222325U;

/// FNV-1a, 64 bit, continued from `state` over `bytes`.
[[nodiscard]] std::uint64_t fnv1a(std::span<const std::byte> bytes, std::uint64_t state = fnv1a_start);

/// The hash of a sequence of fields. Each field counts with its length, so ("ab", "c") differs from ("a", "bc").
class ContentHash {
 public:
  void add(std::span<const std::byte> field);
  void add(std::string_view field);

  /// 16 hexadecimal digits, lower case.
  [[nodiscard]] std::string hex() const;

 private:
  std::uint64_t state_ = fnv1a_start;
};

}  // namespace footprint
