// Where bytes go that are made piece by piece: a file, or a row in memory.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace footprint {

/// Takes the next bytes in.
using ByteSink = std::function<void(std::span<const std::uint8_t>)>;

/// Hands bytes to a sink, piece by piece.
using ByteWriter = std::function<void(const ByteSink&)>;

/// A sink that puts them behind those in `bytes`.
[[nodiscard]] inline ByteSink appending_to(std::vector<std::uint8_t>& bytes) {
  return [&bytes](std::span<const std::uint8_t> piece) { bytes.insert(bytes.end(), piece.begin(), piece.end()); };
}

}  // namespace footprint
