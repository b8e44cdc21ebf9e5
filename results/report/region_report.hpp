// The region of the settings that a paper leaves open in which its claims are true: `footprint check EXPERIMENT
// --region`.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "renderer/core/run_folder.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// The admissible values of one setting, as the experiment's file writes them.
struct RegionAxis {
  std::string key;  ///< the setting: "distance", "size", or a method of which options vary
  std::vector<std::string> values = {};
};
void fields(auto& archive, Is<RegionAxis> auto& value) {
  archive("key", value.key);
  archive("values", value.values);
}

/// One point of the grid.
struct RegionSetting {
  std::string name;  ///< its folder
  Coordinates values;
};
void fields(auto& archive, Is<RegionSetting> auto& value) {
  archive("name", value.name);
  archive("values", value.values);
}

/// The outcome of one claim over the grid.
struct RegionClaim {
  std::string name, text, inequality = {};
  ClaimSource source = ClaimSource::ours;
  Verdict stated = Verdict::undecided;  ///< at the experiment's own setting
  std::vector<Verdict> outcomes = {};   ///< one per setting of the grid, in their order
  std::string sentence = {};            ///< region_sentence; region_json sets it

  /// How many settings have an outcome.
  [[nodiscard]] std::size_t count(Verdict verdict) const;
};
void fields(auto& archive, Is<RegionClaim> auto& value) {
  archive("name", value.name);
  archive("text", value.text);
  archive("inequality", value.inequality);
  archive("source", value.source);
  archive("stated", value.stated);
  archive("outcomes", value.outcomes);
  archive("sentence", value.sentence);
}

/// The content of region.json.
struct RegionReport {
  ToolInfo tool = {};
  BackendInfo backend = {};
  std::string experiment = {}, title = {}, file = {};
  bool quick = false;                        ///< smaller than the file says: no measurement
  std::vector<RegionAxis> axes = {};         ///< the last one changes first
  std::vector<RegionSetting> settings = {};  ///< all combinations
  std::vector<RegionClaim> claims = {};
};

/// "True in 9 of 40 settings, all of them with distance 0.5 or 1; at the stated setting it is false." A value
/// that all settings with the outcome have is named only where the axis has others.
[[nodiscard]] std::string region_sentence(const RegionReport& report, const RegionClaim& claim);

/// The document of docs/region.schema.json.
[[nodiscard]] std::string region_json(const RegionReport& report);

/// A section per claim in Markdown: the sentence, and a map of the grid with the last axis to the right.
[[nodiscard]] std::string region_table(const RegionReport& report);

/// The sections as a page.
[[nodiscard]] std::string region_page(const RegionReport& report);

/// Writes region.json, table.md and index.html. Errors (machine): region.json cannot be written.
void write_region(const RegionReport& report, const RunFolder& folder);

}  // namespace footprint
