// What claims, thresholds and published figures ask of a run: `error(toksvig, distance=4)` over its records.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "results/report/records.hpp"

namespace footprint {

/// One call of an expression: a figure of one method, the mean over the records that the selectors leave.
struct Measure {
  std::string function;  ///< one of measure_functions()
  std::string method;    ///< a method as the experiment writes it, its name alone where only one has it, or `*`
  std::optional<double> distance;
  std::optional<int> frame;
  std::optional<std::string> footprint;  ///< of the NDF's functions alone
  std::optional<std::string> quantity;   ///< `quantity` alone: its name in the experiment
  std::optional<int> spp;  ///< `error`: against the reference of so many samples, none: the experiment's own;
                           ///< `supersampling_time`: of so many samples, which must be given
};

/// The functions by name, in the order of the documentation.
[[nodiscard]] const std::vector<std::string>& measure_functions();

/// Whether a function takes `spp`.
[[nodiscard]] bool takes_spp(const std::string& function);

/// Whether a function is one of a footprint's NDF: it takes `footprint`, and no other selector.
[[nodiscard]] bool is_of_ndf(const std::string& function);

/// Whether a function is a figure that no picture shows: it takes `name`, and no other selector.
[[nodiscard]] bool is_quantity(const std::string& function);

/// "error(toksvig:storage=fp16, distance=4)".
[[nodiscard]] std::string measure_text(const Measure& measure);

/// The place in `methods` of the one that is written `wanted`, else of the only one with that name. Errors (usage,
/// no place): none, with the nearest; more than one.
[[nodiscard]] std::size_t select_method(const std::string& wanted, std::span<const std::string> methods);

/// Whether a function is of plain supersampling beside the methods: it needs `spp`.
[[nodiscard]] bool is_of_supersampling(const std::string& function);

/// What a run says to a measure.
struct Measured {
  std::optional<double> value;
  std::string problem;          ///< why there is none
  bool at_noise_floor = false;  ///< `error` that the reference's own noise explains, in every record that counts
};

/// The mean over the records of the method that match; those without the figure do not count. `measure.method` must be
/// one of the run's.
[[nodiscard]] Measured measured(const Measure& measure, const Results& results);

}  // namespace footprint
