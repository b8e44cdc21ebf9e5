// Prefiltered as bytes and back: what the disk keeps of a bake. Texture by texture, so that no second copy of it lies
// in memory.
#pragma once

#include <optional>

#include "renderer/bake/prefiltered.hpp"
#include "renderer/core/byte_sink.hpp"
#include "renderer/core/stored_bytes.hpp"

namespace footprint {

/// Writes the value with a checksum, in this machine's byte order. Equal values give equal bytes.
void write_bytes(const Prefiltered& prefiltered, const ByteSink& sink);

/// The value that `write_bytes` wrote; none where the bytes are cut short, overlong, damaged or of another form.
[[nodiscard]] std::optional<Prefiltered> from_bytes(const StoredBytes& bytes);

}  // namespace footprint
