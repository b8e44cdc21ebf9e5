// The measurements of `footprint edit`, frame by frame: edit.json, edit.csv and the table.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "renderer/core/progress.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// One edit: from new parameters of the small-scale geometry to a picture.
struct EditRecord {
  int frame = 0;
  std::map<std::string, std::string> parameters;  ///< those that are set, by name
  std::vector<StageTime> stages;                  ///< one after the other, from the geometry to the frame
  std::uint64_t bytes = 0;                        ///< of the baked maps
  std::vector<std::string> notes;                 ///< what the method says of each material, by material
  std::string image;                              ///< EXR, from the output folder; with a .png of the same stem

  /// The sum of the stages, seconds.
  [[nodiscard]] double seconds() const;
};

/// The frames of an edit by one method.
struct EditRun {
  ToolInfo tool;
  BackendInfo backend;
  SceneInfo scene;
  std::string kind;    ///< of the small-scale geometry
  std::string method;  ///< as written
  int width = 0, height = 0;
  std::vector<EditRecord> records;
};

/// The names of the stages, in the order in which they first come in any record.
[[nodiscard]] std::vector<std::string> stage_names(const EditRun& run);

/// The document of docs/reference/results.md, "schema": "footprint-edit/1".
[[nodiscard]] std::string edit_json(const EditRun& run);

/// One line per frame, one column per parameter and stage (milliseconds), RFC 4180.
[[nodiscard]] std::string edit_csv(const EditRun& run);

/// One line per stage in Markdown: median, least and most milliseconds over the frames; edits per second.
[[nodiscard]] std::string edit_table(const EditRun& run);

/// Writes edit.json, edit.csv and table.md into `folder`, each whole or not at all. Errors (machine).
void write_edit(const EditRun& run, const std::filesystem::path& folder);

}  // namespace footprint
