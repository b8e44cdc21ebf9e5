// Numbers out of glTF accessors, with every range checked in 64 bits before a byte is touched.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <vector>

namespace footprint {

/// The most elements that one accessor, and the most triangles and vertices that one scene, may have.
inline constexpr std::uint64_t largest_element_count = std::uint64_t{1} << 26U;

/// All elements of an accessor, interleaved, `components` floats each: normalised integers as the numbers that they
/// stand for, plain integers as they are, sparse substitutions applied, zeros where there is no buffer view.
/// Errors (usage) name the accessor: another type than `components` wide, a component type that is not float, 8 or
/// 16 bit, no element, more than `largest_element_count` (2^20 without a buffer view), reaching outside its buffer
/// view, sparse indices that do not rise or reach past the end.
[[nodiscard]] std::vector<float> read_floats(const tinygltf::Model& model, int accessor, int components);

/// All elements of a scalar accessor of unsigned 8, 16 or 32 bit integers. Errors as in read_floats.
[[nodiscard]] std::vector<std::uint32_t> read_indices(const tinygltf::Model& model, int accessor);

}  // namespace footprint
