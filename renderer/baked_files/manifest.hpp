// The manifest of a bake: what a program needs to know to draw from its files (docs/bake.schema.json).
#pragma once

#include <string>

#include "renderer/baked_files/baked_files.hpp"

namespace footprint {

/// The document, "schema": "footprint-bake/1"; pretty-printed, key order fixed. Nothing in it depends on when or how
/// fast the bake was made.
[[nodiscard]] std::string manifest_json(const BakeToFiles& bake, const BakeListing& listing);

}  // namespace footprint
