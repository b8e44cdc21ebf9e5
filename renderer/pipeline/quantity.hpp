// Figures of a method that no picture shows, which experiments ask for by name.
#pragma once

#include <span>
#include <string>
#include <vector>

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

/// What a method is besides that has such figures.
class HasQuantities {
 public:
  HasQuantities() = default;
  HasQuantities(const HasQuantities&) = delete;
  HasQuantities& operator=(const HasQuantities&) = delete;
  virtual ~HasQuantities() = default;

  [[nodiscard]] virtual std::span<const Quantity> quantities() const = 0;
};

}  // namespace footprint
