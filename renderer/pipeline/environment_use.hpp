// How a program takes light from an environment.
#pragma once

#include <string>
#include <string_view>

namespace footprint {

enum class EnvironmentUse {
  prefiltered,  ///< by the module's lobes and prefiltered maps: methods
  sampled,      ///< directions drawn anew for every sample: the reference
  dense,        ///< as 6 x 32 x 32 directional lights, all of them for every sample: the reference, where asked for
};

/// "sampled" or "dense": how the reference integrates. Errors (usage) with the nearest right word.
[[nodiscard]] EnvironmentUse parse_environment_use(const std::string& word);

[[nodiscard]] std::string_view environment_use_name(EnvironmentUse use);

}  // namespace footprint
