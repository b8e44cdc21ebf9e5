// Figures of methods that no picture shows: found by name, and measured for an experiment.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "experiments/runner/experiment.hpp"
#include "methods/quantities.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// A method's figure of that name; null where it has none.
[[nodiscard]] const Quantity* find_quantity(const Method& method, const std::string& name);

/// The names of all figures of some methods, each once.
[[nodiscard]] std::vector<std::string> quantity_names(std::span<const MethodSpec> methods);

/// The experiment's quantities, each for every method that has it. Errors (usage): of the figure, naming quantity and
/// method; a material that the scene does not have.
[[nodiscard]] std::vector<QuantityFigure> measure_quantities(const Experiment& experiment, const Scene& scene,
                                                             const Progress& progress);

}  // namespace footprint
