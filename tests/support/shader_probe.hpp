// GLSL functions evaluated over a list of inputs, so that a test can compare them with golden numbers and C++ twins.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "renderer/gl/context.hpp"

namespace footprint::testing {

/// Runs `functions` followed by `vec4 probe(vec4 a, vec4 b, vec4 c) { <body> }` over the inputs, three vectors each.
/// Errors (machine): the text does not compile.
[[nodiscard]] std::vector<glm::vec4> evaluate_glsl(const std::string& functions, const std::string& body,
                                                   std::span<const std::array<glm::vec4, 3>> inputs);

}  // namespace footprint::testing
