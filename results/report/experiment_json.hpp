// The part of results.json that an experiment adds, there and back.
#pragma once

#include <nlohmann/json.hpp>

#include "results/report/experiment_report.hpp"
#include "results/report/json_node.hpp"

namespace footprint {

/// The value of the key `experiment`, keys in the order of docs/results.schema.json.
[[nodiscard]] nlohmann::ordered_json experiment_json(const ExperimentReport& report);

/// The inverse. Errors (usage) as those of JsonNode.
[[nodiscard]] ExperimentReport parse_experiment(const JsonNode& node);

}  // namespace footprint
