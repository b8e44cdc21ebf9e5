// What `footprint animate` measured, frame by frame: animation.json, animation.csv and the table.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "results/report/records.hpp"

namespace footprint {

/// One method in one frame.
struct AnimationRecord {
  int frame = 0;
  double distance = 1;
  std::string method;
  std::optional<double> normalized_color;  ///< none: the object covers no whole pixel
  std::optional<double> noise_floor;
  std::optional<Flicker> flicker;  ///< none in the first frame
  std::string image;               ///< EXR, from the output folder; a .png of the same stem lies beside it
};

/// A zoom, rendered by some methods and by the reference.
struct Animation {
  ToolInfo tool;
  BackendInfo backend;
  SceneInfo scene;
  ReferenceInfo reference;
  int width = 0, height = 0;
  std::vector<std::string> reference_images;  ///< EXR, one a frame
  std::vector<AnimationRecord> records;       ///< frame by frame, in each in the order of the methods
};

/// The document of docs/results.md, "schema": "footprint-animation/1".
[[nodiscard]] std::string animation_json(const Animation& animation);

/// One line a record, RFC 4180.
[[nodiscard]] std::string animation_csv(const Animation& animation);

/// One line a method in Markdown: means over the frames, the worst frame's flicker.
[[nodiscard]] std::string animation_table(const Animation& animation);

/// Writes animation.json, animation.csv and table.md into `folder`, each whole or not at all. Errors (machine).
void write_animation(const Animation& animation, const std::filesystem::path& folder);

}  // namespace footprint
