// A prefiltered texture as a KTX 2.0 file (Khronos' KTX File Format Specification, version 2.0): all levels and layers
// in the texture's own storage, without supercompression. Also as a DDS file, for readers without KTX2.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/bake/prefiltered.hpp"

namespace footprint {

/// The linear Vulkan format (VkFormat) of a storage with 1 to 4 channels; a storage of blocks has its own number.
[[nodiscard]] std::uint32_t vk_format(Storage storage, int channels);

/// The file's bytes: header, level index, data format descriptor, the keys KTXorientation (`rd`: the first row is v =
/// 0) and KTXwriter, and the levels, coarsest first. Equal textures give equal bytes. Throws std::logic_error: a
/// texture of a frame build.
[[nodiscard]] std::vector<std::uint8_t> ktx2_bytes(const PrefilteredTexture& texture);

/// A plain texture of `unorm8` with 4 channels as a DirectDraw surface with all its levels: the header of 2001, which
/// every reader knows.
[[nodiscard]] std::vector<std::uint8_t> dds_bytes(const PrefilteredTexture& texture);

}  // namespace footprint
