// Prefiltered as bytes and back: what the disk keeps of a bake.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "renderer/bake/prefiltered.hpp"

namespace footprint {

/// The value with a checksum, in this machine's byte order. Equal values give equal bytes.
[[nodiscard]] std::vector<std::uint8_t> to_bytes(const Prefiltered& prefiltered);

/// The value that `to_bytes` wrote; none where the bytes are cut short, overlong, damaged or of another form.
[[nodiscard]] std::optional<Prefiltered> from_bytes(std::span<const std::uint8_t> bytes);

}  // namespace footprint
