// The costs that `footprint cost` estimates: cost.json, cost.csv and the table.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "results/report/record_fields.hpp"

namespace footprint {

/// Mean rounds per pixel of the loops that depend on the pixel; 0 if the method has no such loop.
struct LoopTrips {
  double probes = 0, lobes = 0, rounds = 0;
};

/// The costs of one method.
struct MethodCosts {
  std::string method;
  LoopTrips trips;
  double lookups = 0;  ///< texture lookups per pixel, counted on the software renderer
  double map_bytes = 0;
  double pixels = 0;  ///< that the object covers
  std::vector<GpuCost> gpus;
};

/// The costs of some methods over one scene.
struct CostReport {
  ToolInfo tool;
  BackendInfo backend;
  SceneInfo scene;
  std::string footprint, compiler;
  int width = 0, height = 0;
  double distance = 1;
  std::vector<MethodCosts> methods;
};

template <class Archive>
void fields(Archive& archive, Is<LoopTrips> auto& value) {
  archive("probes", value.probes);
  archive("lobes", value.lobes);
  archive("rounds", value.rounds);
}

template <class Archive>
void fields(Archive& archive, Is<MethodCosts> auto& value) {
  archive("method", value.method);
  archive("trips", value.trips);
  archive("lookups", value.lookups);
  archive("map_bytes", value.map_bytes);
  archive("pixels", value.pixels);
  archive("gpus", value.gpus);
}

/// The document of docs/explanation/gpu-cost.md, "schema": "footprint-cost/1".
[[nodiscard]] std::string cost_json(const CostReport& report);

/// One line per method and GPU, RFC 4180.
[[nodiscard]] std::string cost_csv(const CostReport& report);

/// One Markdown table per GPU: a line per method, with its cost over that of the first method.
[[nodiscard]] std::string cost_table(const CostReport& report);

/// The same tables for each distance of a run, as a section of table.md and of the page; empty without estimates.
[[nodiscard]] std::string gpu_costs_markdown(const Results& results);
[[nodiscard]] std::string gpu_costs_html(const Results& results);

/// Writes cost.json, cost.csv and table.md into `folder`, each atomically. Throws Error (machine).
void write_cost(const CostReport& report, const std::filesystem::path& folder);

}  // namespace footprint
