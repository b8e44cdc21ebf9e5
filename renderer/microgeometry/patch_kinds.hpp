// The kinds of patches that a scene.toml may name.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "renderer/core/options.hpp"
#include "renderer/microgeometry/patch.hpp"

namespace footprint {

/// One kind of patch. Lengths among the parameters are in periods.
struct PatchKind {
  std::string name;
  std::string summary;  ///< one sentence
  std::vector<OptionSpec> parameters;
  /// Same parameters and seed, same triangles.
  Patch (*build)(const Options& parameters, std::uint64_t seed) = nullptr;
};

/// `flat`, `grooves`, `pyramids`, `spheres`, `weave` and `noise`.
[[nodiscard]] std::span<const PatchKind> patch_kinds();

/// The kind of a name. Errors (usage): unknown, with the nearest right one.
[[nodiscard]] const PatchKind& find_patch_kind(const std::string& name);

/// Builds a patch of a kind with `given` parameters by name. Errors (usage): as of Options.
[[nodiscard]] Patch make_patch(const PatchKind& kind, const std::map<std::string, std::string>& given,
                               std::uint64_t seed = 1);

}  // namespace footprint
