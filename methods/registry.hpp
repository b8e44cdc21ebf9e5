// The methods of this build, and their figures that no image shows. CMake writes both lists.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "renderer/bake/method.hpp"
#include "renderer/core/options.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// All methods, in the order of methods/CMakeLists.txt.
[[nodiscard]] std::span<const Method* const> all_methods();

/// The method of a name. Errors (usage): unknown, with the nearest right one.
[[nodiscard]] const Method& find_method(const std::string& name);

/// The method of a spec: of the file that it names, or of its name. Errors (usage): as above.
[[nodiscard]] const Method& find_method(const MethodSpec& spec);

/// A figure of a method that no picture shows, such as what its fit leaves over.
struct Quantity {
  std::string name;
  std::string summary;                 ///< one sentence, with the unit
  std::vector<OptionSpec> parameters;  ///< of the figure, beside the method's own options
  /// Pure. Errors (usage): the material does not have what the figure is about.
  std::function<double(const Material& material, const Options& options, const Options& parameters)> measure;
};

/// The figures of a method of this build; none where it has no study.
[[nodiscard]] std::span<const Quantity> quantities_of(const Method& method);

}  // namespace footprint
