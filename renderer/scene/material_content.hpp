// What tells one material from another, and one scene: what is made of them is kept under a hash of it.
#pragma once

#include "renderer/core/hash.hpp"
#include "renderer/scene/material.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint {

/// Counts everything of a material but the names in it: materials that differ in any field give different hashes.
void add_content(ContentHash& hash, const Material& material);

/// Counts everything of a loaded scene, the names and notes that reports print too, but for where it was loaded from
/// and the choices that its model files offered.
void add_content(ContentHash& hash, const Scene& scene);

}  // namespace footprint
