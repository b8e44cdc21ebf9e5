// How much memory a method takes for a normal map, told before it takes it: what the estimate of memory goes by.
#pragma once

#include <cstddef>
#include <cstdint>

#include "renderer/scene/material.hpp"

namespace footprint {

/// Bytes.
struct BakeMemory {
  /// Of textures on the GPU, and of texels that stay in memory because a frame build reads them.
  std::uint64_t kept = 0;
  /// At most until all of it lies on the GPU: what is baked, what that is made from, and what of it lies there already.
  std::uint64_t baking = 0;

  friend bool operator==(const BakeMemory&, const BakeMemory&) = default;
};

/// What keeps `kept` and makes it in `making`. What is on its way to the GPU lies in memory and there.
[[nodiscard]] BakeMemory bake_memory(double kept, double making);

/// Texels of a material's normal map, as a factor.
[[nodiscard]] double normal_texels(const Material& material);

/// A whole mip chain over its finest level.
inline constexpr double mip_chain_share = 4.0 / 3.0;

/// Bytes a texel of a normal map as it is decoded, four channels of 32-bit floats.
inline constexpr double decoded_normal = 16.0;

/// Bytes a texel at most while a chain of mean normals is made: a weighted chain, and its finest level once more
/// without the weight.
inline constexpr double mean_normals_in_the_making = decoded_normal * mip_chain_share + 12.0;

/// Of mean normals in so many bytes a channel, with nothing beside them.
[[nodiscard]] BakeMemory mean_normal_memory(const Material& material, std::size_t channel_bytes);

}  // namespace footprint
