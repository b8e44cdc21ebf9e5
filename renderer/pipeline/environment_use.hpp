// How a program takes light from an environment.
#pragma once

#include <array>

#include "renderer/core/words.hpp"

namespace footprint {

enum class EnvironmentUse {
  prefiltered,  ///< by the module's lobes and prefiltered maps: methods
  sampled,      ///< directions drawn anew for every sample: the reference
  dense,        ///< as 6 x 32 x 32 directional lights, all of them for every sample: the reference, where asked for
};

/// How the reference integrates, as users write it.
inline constexpr std::array<Word<EnvironmentUse>, 2> reference_integrals{{
    {EnvironmentUse::sampled, "sampled"},
    {EnvironmentUse::dense, "dense"},
}};

}  // namespace footprint
