// The patch kinds of scene.toml.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "renderer/core/options.hpp"
#include "renderer/microgeometry/patch.hpp"

namespace footprint {

/// A kind of patch. Parameters that are lengths are in periods.
struct PatchKind {
  std::string name;
  std::string summary;  ///< one sentence
  std::vector<OptionSpec> parameters;
  /// Deterministic for its parameters and seed.
  Patch (*build)(const Options& parameters, std::uint64_t seed) = nullptr;
};

/// `flat`, `grooves`, `pyramids`, `spheres`, `weave` and `noise`.
[[nodiscard]] std::span<const PatchKind> patch_kinds();

/// Finds a kind by name. Throws Error (usage) with the nearest name if it is unknown.
[[nodiscard]] const PatchKind& find_patch_kind(const std::string& name);

/// Builds a patch of a kind with the `given` parameters. Throws Error (usage) as Options does.
[[nodiscard]] Patch make_patch(const PatchKind& kind, const std::map<std::string, std::string>& given,
                               std::uint64_t seed = 1);

}  // namespace footprint
