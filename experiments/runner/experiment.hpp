// An experiment as a plain value: what its TOML says (docs/reference/experiments.md).
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/runner/expression.hpp"
#include "experiments/settings/run_settings.hpp"
#include "renderer/ndf/footprint_texels.hpp"

namespace footprint {

/// A statement, of a paper or our own, as an inequality over the records.
struct Claim {
  ClaimOutcome stated = {};                 ///< undecided
  std::vector<std::string> gpu_class = {};  ///< of a gpu_time: words of GL_RENDERER of GPUs that decide it; empty: none
  Inequality inequality;
};

/// An upper bound on an expression without `*`.
struct Threshold {
  Expression measure;
  double limit = 0;
  std::string place{};  ///< FILE:LINE of its key
};

/// A figure that a paper prints.
struct PublishedValue {
  PublishedFigure printed;  ///< not measured
  Expression measure;
};

/// A footprint whose effective NDF is looked into.
struct NamedFootprint {
  std::string name;    ///< letters, digits, `_`, `-`: a folder is called so
  FootprintRect rect;  ///< texture coordinates
};

/// A figure of a method that no picture shows: of every method of the experiment that has it.
struct NamedQuantity {
  std::string name;                               ///< in the experiment's expressions
  std::string quantity;                           ///< what the method calls it (Method::quantities)
  std::map<std::string, std::string> parameters;  ///< those that are given
  std::string material;                           ///< of the scene; empty: its first
};

/// The values that one setting takes in turn, as an option takes them.
struct Axis {
  std::string key;  ///< of the setting, and of its selector in expressions: "scene"
  std::vector<std::string> values = {};
};

/// A rectangle of a picture in shares of its width and height, from the top left: left, top, right, bottom.
using Crop = std::array<double, 4>;

/// One picture of a composed figure.
struct FigurePicture {
  std::optional<std::size_t> method;  ///< index in the run's methods; none: the reference
  std::size_t frame = 0;              ///< index in the distances
  std::string label;                  ///< "(a)", or any words; may be empty
  std::optional<Crop> crop;           ///< what is shown of it; none: as of every picture
};

/// A figure composed of pictures of the run as the paper composes its own.
struct FigureLayout {
  Crop crop{0, 0, 1, 1};                         ///< what is shown of each picture
  std::optional<Crop> inset;                     ///< shown enlarged in the picture's lower right corner
  std::vector<std::vector<FigurePicture>> rows;  ///< each with one picture or more
};

struct Experiment {
  std::string name;  ///< the file's stem; of a member of a matrix its own
  std::filesystem::path file;
  std::optional<std::filesystem::path> presets;  ///< the file that it takes what it lacks from
  std::string title, description;
  std::vector<std::filesystem::path>
      members;               ///< files of the experiments that it is made of; with any, all below is unset
  std::vector<Axis> axes;    ///< of a matrix: what its members (members_of_matrix) vary; `run` is the first one's
  std::vector<Axis> region;  ///< what its claims leave unsaid; a key that is no setting is a method as written
  Coordinates coordinates;   ///< of a member of a matrix, or of a setting of a region: its value on each axis
  std::string whole;         ///< of such a member or setting: the name of the experiment that it is of
  RunSettings run;           ///< what is compared
  std::string scene_place;   ///< FILE:LINE of what names its scene, or scenes
  bool quick = false;        ///< `run` is cut short: no measurement
  std::vector<PublishedValue> published;
  std::vector<Claim> claims;
  std::vector<Threshold> thresholds;
  std::vector<NamedFootprint> footprints;
  std::vector<NamedQuantity> quantities;
  FigureLayout figure;  ///< no rows: none is composed

  /// "NAME", of a member of a matrix "MATRIX/NAME".
  [[nodiscard]] std::string full_name() const { return whole.empty() ? name : whole + "/" + name; }
};

/// The file that EXPERIMENT names: NAME.toml in `folder`, or a path to a TOML file, with or without its ending.
/// Errors (usage): there is none, with the nearest name.
[[nodiscard]] std::filesystem::path find_experiment(const std::string& experiment, const std::filesystem::path& folder);

/// The names of the TOML files in `folder`, sorted.
[[nodiscard]] std::vector<std::string> list_experiments(const std::filesystem::path& folder);

/// Reads an experiment, and the published figures that it names. Errors (usage) read "FILE:LINE: ...": not TOML,
/// unknown keys with the nearest right one, wrong types, values out of range, methods, functions and selectors that do
/// not exist.
[[nodiscard]] Experiment read_experiment(const std::filesystem::path& file);

/// Checks what depends on the scenes of an experiment: that they exist, and that their zoom paths have every distance
/// and frame that it names. Errors (usage) name the file and the call or the frame; those of read_scene name the line
/// that names the scene.
void check_against_scenes(const Experiment& experiment);

/// The distances of an experiment: those that it gives, or its scene's. Errors (usage): of its scene.
[[nodiscard]] std::vector<double> distances_of(const Experiment& experiment);

/// The scene that a file means by `name`: the one beside it, else of the library.
[[nodiscard]] std::string scene_of_file(const std::filesystem::path& file, const std::string& name);

}  // namespace footprint
