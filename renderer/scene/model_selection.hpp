// What of a model file is taken where it holds several: a scene, a camera, a variant of its materials.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace footprint {

/// Each by its name or by its number from 0; none: the file's own choice (docs/scenes.md).
struct ModelSelection {
  std::optional<std::string> scene, camera, variant;

  [[nodiscard]] bool empty() const { return !scene && !camera && !variant; }
};

/// What a file offers of one kind, and which of it is taken.
struct ModelChoice {
  std::string kind;                  ///< "scene", "camera", "variant"
  std::vector<std::string> names;    ///< in the file's order; "camera 2" for one without a name
  std::optional<std::size_t> taken;  ///< none: the file has none to take, or its own materials are taken
};

/// The place in `choice` of what `wanted` names. Errors (usage): neither a name nor a number of it, with the nearest.
[[nodiscard]] std::size_t find_choice(const ModelChoice& choice, const std::string& wanted);

}  // namespace footprint
