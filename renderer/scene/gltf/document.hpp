// A glTF file, read by tinygltf and checked.
#pragma once

#include <tiny_gltf.h>

#include <filesystem>

namespace footprint {

/// A checked document: every index in it is in range, every buffer view lies within its buffer's data. Compressed
/// geometry (draco.hpp, meshopt.hpp) is decoded: accessors read it as any other.
/// `model.images[i].image` holds the encoded bytes, empty where an external file could not be read.
struct GltfDocument {
  tinygltf::Model model;
  std::filesystem::path file;
};

/// Reads a .gltf or .glb file (told apart by content) with its buffers and the bytes of its images.
/// Errors (usage): missing, empty, over 2 GiB, not glTF 2.0, a broken GLB container, whatever `check_gltf_json`
/// refuses, a buffer that is missing or has another size than the file says, compressed geometry that is damaged.
[[nodiscard]] GltfDocument read_gltf(const std::filesystem::path& file);

}  // namespace footprint
