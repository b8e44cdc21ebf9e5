// A method's own shader functions over one material, without a frame: what tests of densities and terms need.
#pragma once

#include <array>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "renderer/bake/method.hpp"

namespace footprint::testing {

/// A method with options over one material.
struct ProbedMethod {
  const Method* method;
  const Material* material;
  std::map<std::string, std::string> options{};
  EffectSet effects = default_effects();

  /// `normal_variation`, `diffuse`, `fresnel` and `masking_shadowing`.
  [[nodiscard]] static EffectSet default_effects();
};

/// Bakes the material, takes `Effective e` of a footprint that covers the whole of each map once, and evaluates
/// `vec4 probe(vec4 a, vec4 b, vec4 c) { <e is there> <body> }` over the inputs.
[[nodiscard]] std::vector<glm::vec4> probe_method(const ProbedMethod& probed, const std::string& body,
                                                  std::span<const std::array<glm::vec4, 3>> inputs);

/// The method's `ndf` at unit vectors.
[[nodiscard]] std::vector<double> probe_ndf(const ProbedMethod& probed, const std::vector<glm::dvec3>& directions);

/// |density - exact| over |exact|.
[[nodiscard]] double relative_l2(const std::vector<double>& density, const std::vector<double>& exact);

/// A grid over the upper hemisphere, cells of equal solid angle 2 pi / size: rings of equal height, cut into sectors.
[[nodiscard]] std::vector<glm::dvec3> hemisphere_grid(int rings, int sectors);

}  // namespace footprint::testing
