// FNV-1a of 64 bits; each field's length goes in before its bytes, so that fields cannot run together.
#include "renderer/core/hash.hpp"

#include <fmt/format.h>

namespace footprint {

std::uint64_t fnv1a(std::span<const std::byte> bytes, std::uint64_t state) {
  constexpr std::uint64_t prime = 0x100000001b3U;
  for (const std::byte byte : bytes) state = (state ^ std::to_integer<std::uint64_t>(byte)) * prime;
  return state;
}

void ContentHash::add(std::span<const std::byte> field) {
  const std::uint64_t length = field.size();
  state_ = fnv1a(std::as_bytes(std::span(&length, 1)), state_);
  state_ = fnv1a(field, state_);
}

void ContentHash::add(std::string_view field) { add(std::as_bytes(std::span(field))); }

std::string ContentHash::hex() const { return fmt::format("{:016x}", state_); }

}  // namespace footprint
