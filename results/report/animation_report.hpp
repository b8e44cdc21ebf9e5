// What `footprint animate` measured, frame by frame: animation.json, animation.csv, the table, and the film's page.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "results/report/record_fields.hpp"

namespace footprint {

/// Flicker over some of the object's pixels; docs/metrics.md.
struct PartFlicker {
  double mean = 0, p99 = 0;
};

/// What flicker is made of, as ErrorCauses has it of errors. None: no such pixel in both frames, or what tells it was
/// not drawn.
struct FlickerCauses {
  std::optional<PartFlicker> shading;  ///< over pixels that are interior in both frames
  std::optional<PartFlicker> edges;    ///< over the object's other pixels
  std::optional<PartFlicker> filter;   ///< of `exact` under the same footprint filter, over its pixels in both frames
  std::optional<PartFlicker> method;   ///< of the picture against that of `exact`, over the same
};

/// The error of one method in one frame, as in RecordError.
struct FrameError {
  double normalized_color = 0;
  std::optional<double> noise_floor;
  ErrorCauses causes;
};

/// The flicker of one method from the frame before, with its causes.
struct FrameFlicker {
  Flicker whole;
  FlickerCauses causes;
};

/// One method in one frame.
struct AnimationRecord {
  int frame = 0;
  std::string method;
  std::optional<FrameError> error;      ///< none: the object covers no whole pixel
  std::optional<FrameFlicker> flicker;  ///< none in the first frame
  std::optional<double> highlight_energy;
  std::string image;  ///< EXR, from the output folder; next to it a .png of the same stem
};

/// What all methods share in one frame.
struct AnimationFrame {
  int frame = 0;
  double distance = 1;  ///< factor on the camera's distance
  double degrees = 0;   ///< that camera or lights have turned by
  PixelCounts pixels;
  std::optional<double> standard_error;    ///< of the reference, relative
  std::optional<double> highlight_energy;  ///< of the reference
  std::string image;                       ///< of the reference, EXR
};

/// Which way an animation goes.
struct AnimationWay {
  std::string path;                           ///< zoom, orbit or light
  std::optional<std::array<double, 3>> axis;  ///< of what turns
};

/// The frames of a path, rendered by some methods and by the reference.
struct Animation {
  ToolInfo tool;
  BackendInfo backend;
  SceneInfo scene;
  ReferenceInfo reference;
  std::string footprint;  ///< the footprint filter
  AnimationWay way;
  int width = 0, height = 0;
  std::string film;                      ///< file, from the output folder; empty: none was asked for
  std::vector<AnimationFrame> frames;    ///< in their order
  std::vector<AnimationRecord> records;  ///< frame by frame, in each in the order of the methods
};

template <class Archive>
void fields(Archive& archive, Is<PartFlicker> auto& value) {
  archive("mean", value.mean);
  archive("p99", value.p99);
}

template <class Archive>
void fields(Archive& archive, Is<FrameError> auto& value) {
  archive("normalized_color", value.normalized_color);
  archive("noise_floor", value.noise_floor);
  archive("shading", value.causes.shading);
  archive("shading_floor", value.causes.shading_floor);
  archive("edges", value.causes.edges);
  archive("filter", value.causes.filter);
  archive("method", value.causes.method);
}

template <class Archive>
void fields(Archive& archive, Is<FrameFlicker> auto& value) {
  fields(archive, value.whole);
  archive("shading", value.causes.shading);
  archive("edges", value.causes.edges);
  archive("filter", value.causes.filter);
  archive("method", value.causes.method);
}

template <class Archive>
void fields(Archive& archive, Is<AnimationRecord> auto& value) {
  archive("frame", value.frame);
  archive("method", value.method);
  archive("error", value.error);
  archive("flicker", value.flicker);
  archive("highlight_energy", value.highlight_energy);
  archive("image", value.image);
}

template <class Archive>
void fields(Archive& archive, Is<AnimationFrame> auto& value) {
  archive("frame", value.frame);
  archive("distance", value.distance);
  archive("degrees", value.degrees);
  archive.group("pixels", [&](auto& pixels) {
    pixels("object", value.pixels.object);
    pixels("unresolved", value.pixels.unresolved);
    pixels("interior", value.pixels.interior);
    pixels("bound", value.pixels.bound);
  });
  archive("standard_error", value.standard_error);
  archive("highlight_energy", value.highlight_energy);
  archive("image", value.image);
}

/// The document of docs/animation.schema.json, "schema": "footprint-animation/2".
[[nodiscard]] std::string animation_json(const Animation& animation);

/// One line a record, RFC 4180.
[[nodiscard]] std::string animation_csv(const Animation& animation);

/// Two tables in Markdown, one line a method: means over the frames, the worst frame's flicker; what flicker is made
/// of.
[[nodiscard]] std::string animation_table(const Animation& animation);

/// The film as one page that opens from disk, with its figures along the path.
[[nodiscard]] std::string animation_page(const Animation& animation);

/// Writes animation.json, animation.csv, table.md and index.html into `folder`, each whole or not at all. Errors
/// (machine).
void write_animation(const Animation& animation, const std::filesystem::path& folder);

}  // namespace footprint
