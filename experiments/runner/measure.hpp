// A call in an expression, `error(toksvig, distance=4)`: a function, a method and what narrows it down.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>

namespace footprint {

struct FigureFunction;

/// One call of an expression: a figure of one method, the mean over the records that the selectors leave.
struct Measure {
  const FigureFunction* function = nullptr;  ///< a row of figure_functions() (functions.hpp); null in no call
  std::string method;  ///< a method as the experiment writes it, its name alone where only one has it, or `*`
  std::optional<double> distance;
  std::optional<int> frame;
  std::optional<int> spp;                      ///< above 0; of the reference, or of plain supersampling
  std::map<std::string, std::string> slice{};  ///< of a matrix: by an axis' key the value that members must have
  std::optional<std::string> footprint;        ///< of an NDF: its name in the experiment
  std::optional<std::string> name;             ///< of a quantity in the experiment
  std::optional<std::string> gpu;              ///< of an estimated cost; none: the experiment's only one
};

/// "error(toksvig:storage=fp16, distance=4)".
[[nodiscard]] std::string measure_text(const Measure& measure);

/// The index in `methods` of the one that is written `wanted`, else of the only one with that name. Errors (usage,
/// no place): none, with the nearest; more than one.
[[nodiscard]] std::size_t select_method(const std::string& wanted, std::span<const std::string> methods);

}  // namespace footprint
