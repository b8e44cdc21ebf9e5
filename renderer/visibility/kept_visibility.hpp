// The visibility field of a scene, from the disk where an earlier run kept it there.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/core/disk_cache.hpp"
#include "renderer/visibility/visibility_field.hpp"

namespace footprint {

/// Names a scene's field by all that it depends on: this very program, triangles and normals, what alpha masks cut out
/// of them, and the light of the environment. Texture coordinates, materials and lights do not count else.
[[nodiscard]] std::string visibility_key(const Scene& scene, const Environment& environment);

/// The field with a checksum, in this machine's byte order. Equal fields give equal bytes.
[[nodiscard]] std::vector<std::uint8_t> to_bytes(const VisibilityField& field);

/// The field that `to_bytes` wrote; none where the bytes are cut short, overlong, damaged, of another form, or do not
/// have a value for each vertex of `scene`.
[[nodiscard]] std::optional<VisibilityField> visibility_from_bytes(const StoredBytes& bytes, const Scene& scene);

/// From `cache`, or asked of the scene and then kept there; without a cache asked. Errors: those of visibility_field.
[[nodiscard]] VisibilityField kept_visibility_field(const Scene& scene, const Environment& environment,
                                                    const DiskCache* cache, const Progress& progress);

}  // namespace footprint
