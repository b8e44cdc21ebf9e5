// Mip chains as EXR files, as OpenImageIO's texture system has them: one file, tiled, every level in it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "renderer/image/image.hpp"

namespace footprint {

/// How a channel of an EXR is stored.
enum class ExrTexel { half, full };

/// The levels of a map, finest first, and what its channels are called.
struct ExrChain {
  std::vector<Image> levels;
  std::vector<std::string> channels;
};

/// Writes all levels (sizes as mip_level_count has them, from the finest on; or the finest alone) into one EXR, tiled
/// and mip-mapped where there is more than one; whole or not at all. Channels come back in alphabetical order, but
/// for R, G, B and A. `half` rounds to nearest. Errors (machine): the folder cannot be written, the disk is full;
/// std::logic_error: as many names as channels are not there, or the sizes are no chain.
void write_exr_chain(const std::filesystem::path& file, const ExrChain& chain, ExrTexel texel);

/// Reads all levels of an EXR with at most `most_channels`, mip-mapped or not. Errors (usage): missing, no EXR,
/// damaged, more channels, over 16384 texels a side; (machine): not enough memory.
[[nodiscard]] ExrChain read_exr_chain(const std::filesystem::path& file, int most_channels = 16);

}  // namespace footprint
