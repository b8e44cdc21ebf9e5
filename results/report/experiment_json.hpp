// The part of results.json that an experiment adds.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "results/report/experiment_report.hpp"

namespace footprint {

/// The value of the key `experiment`, keys in the order of docs/results.schema.json.
[[nodiscard]] nlohmann::ordered_json experiment_json(const ExperimentReport& report);

}  // namespace footprint
