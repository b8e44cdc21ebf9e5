// A glTF file, read by tinygltf and checked, and its accessors.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <filesystem>
#include <vector>

namespace footprint {

/// A checked document: every index in it is in range, every buffer view lies within its buffer's data. Compressed
/// geometry (compressed.hpp) is decoded: accessors read it as any other.
/// `model.images[i].image` holds the encoded bytes, empty where an external file could not be read.
struct GltfDocument {
  tinygltf::Model model;
  std::filesystem::path file;
};

/// Reads a .gltf or .glb file (told apart by content) with its buffers and the bytes of its images.
/// Throws Error (usage): missing, empty, over 2 GiB, not glTF 2.0, a broken GLB container, whatever `check_gltf_json`
/// refuses, a buffer that is missing or has another size than the file says, compressed geometry that is damaged.
[[nodiscard]] GltfDocument read_gltf(const std::filesystem::path& file);

/// The most elements that one accessor, and the most triangles and vertices that one scene, may have.
inline constexpr std::uint64_t largest_element_count = std::uint64_t{1} << 26U;

/// All elements of an accessor, interleaved, `components` floats each: normalised integers as the numbers that they
/// stand for, plain integers as they are, sparse substitutions applied, zeros where there is no buffer view.
/// Throws Error (usage) that names the accessor: another type than `components` wide, a component type that is not
/// float, 8 or 16 bit, no element, more than `largest_element_count` (2^20 without a buffer view), reaching outside its
/// buffer view, sparse indices that do not rise or reach past the end.
[[nodiscard]] std::vector<float> read_floats(const tinygltf::Model& model, int accessor, int components);

/// All elements of a scalar accessor of unsigned 8, 16 or 32 bit integers. Throws as in read_floats.
[[nodiscard]] std::vector<std::uint32_t> read_indices(const tinygltf::Model& model, int accessor);

}  // namespace footprint
