// One material, as a frame build finds it on the GPU.
#pragma once

#include <span>

#include "renderer/gl/functions.hpp"

namespace footprint {

struct GpuBatch;
struct GpuTexture;
struct Prefiltered;
struct View;

/// What FrameBuild::run is handed.
struct FrameBuildJob {
  const GpuBatch& batch;                 ///< the material's block, and whether its triangles have two sides
  GLuint vertex_array;                   ///< its triangles, with their surface coordinates where it has some
  const Prefiltered& baked;              ///< what the precompute made of it
  std::span<const GpuTexture> textures;  ///< the textures of `baked`, in its order, on the GPU
  const View& view;                      ///< what is to be drawn
};

}  // namespace footprint
