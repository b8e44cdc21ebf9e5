// Results with the times that are estimated for a GPU in place of the measured ones.
#pragma once

#include <string>
#include <vector>

#include "results/report/records.hpp"

namespace footprint {

/// The GPUs that the records have estimates for, in their order.
[[nodiscard]] std::vector<std::string> estimated_gpus(const Results& results);

/// Replaces the frame time of each record by its estimated cost times the pixels of the object, and the time of N
/// samples by N frames of `direct`. Times without an estimate become NaN. `ratio_to_direct` stays as measured. gpu: of
/// estimated_gpus.
[[nodiscard]] Results with_estimated_times(Results results, const std::string& gpu);

}  // namespace footprint
