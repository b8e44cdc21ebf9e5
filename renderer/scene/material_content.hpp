// What tells one material from another: what is made of a material is kept under a hash of it.
#pragma once

#include "renderer/core/hash.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// Counts everything of a material but the names in it: materials that differ in any field give different hashes.
void add_content(ContentHash& hash, const Material& material);

}  // namespace footprint
