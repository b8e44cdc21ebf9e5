// Figures of a method that no image shows, for experiments, by name. CMake writes the list of the methods
// that have some: one footprint_add_method line with STUDY per method.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "renderer/bake/method.hpp"
#include "renderer/core/options.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// A figure of a method that no picture shows, such as what its fit leaves over.
struct Quantity {
  std::string name;
  std::string summary;                 ///< one sentence, with the unit
  std::vector<OptionSpec> parameters;  ///< of the figure, beside the method's own options
  /// Pure. Errors (usage): the material does not have what the figure is about.
  double (*measure)(const Material& material, const Options& options, const Options& parameters) = nullptr;
};

/// The figures of a method of this build; none where it has no study.
[[nodiscard]] std::span<const Quantity> quantities_of(const Method& method);

}  // namespace footprint
