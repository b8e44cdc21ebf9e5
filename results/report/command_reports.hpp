// The reports of commands that compare no images: `footprint edit`, `footprint cost` and `footprint ndf`.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "renderer/core/gpu_cost.hpp"
#include "renderer/core/progress.hpp"
#include "renderer/core/run_folder.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// One edit: from new parameters of the small-scale geometry to a picture.
struct EditRecord {
  int frame = 0;
  std::map<std::string, std::string> parameters;  ///< those that are set, by name
  std::vector<StageTime> stages = {};             ///< one after the other, from the geometry to the frame
  std::uint64_t bytes = 0;                        ///< of the baked maps
  std::vector<std::string> notes = {};            ///< what the method says of each material, by material
  std::string image = {};                         ///< EXR, from the output folder; with a .png of the same stem

  /// The sum of the stages, seconds.
  [[nodiscard]] double seconds() const;
};

/// The frames of an edit by one method: the content of edit.json.
struct EditRun {
  std::string schema = "footprint-edit/1";
  ToolInfo tool;
  BackendInfo backend;
  SceneInfo scene;
  std::string kind;    ///< of the small-scale geometry
  std::string method;  ///< as written
  std::array<int, 2> size{};
  std::vector<EditRecord> records;
};
void fields(auto& archive, Is<EditRun> auto& value) {
  archive("schema", value.schema);
  archive("tool", value.tool);
  archive("backend", value.backend);
  archive("scene", value.scene);
  archive("kind", value.kind);
  archive("method", value.method);
  archive("size", value.size);
  archive("records", value.records);
}

/// The document of docs/reference/results.md, "schema": "footprint-edit/1".
[[nodiscard]] std::string edit_json(const EditRun& run);

/// One line per frame, one column per parameter and stage (milliseconds), RFC 4180.
[[nodiscard]] std::string edit_csv(const EditRun& run);

/// One line per stage in Markdown: median, least and most milliseconds over the frames; edits per second.
[[nodiscard]] std::string edit_table(const EditRun& run);

/// Writes edit.json, edit.csv and table.md into `folder`, each whole or not at all. Errors (machine).
void write_edit(const EditRun& run, const RunFolder& folder);

/// Mean rounds per pixel of the loops that depend on the pixel; 0 if the method has no such loop.
struct LoopTrips {
  double probes = 0, lobes = 0, rounds = 0;
};
void fields(auto& archive, Is<LoopTrips> auto& value) {
  archive("probes", value.probes);
  archive("lobes", value.lobes);
  archive("rounds", value.rounds);
}

/// The costs of one method.
struct MethodCosts {
  std::string method;
  LoopTrips trips = {};
  double lookups = 0;  ///< texture lookups per pixel, counted on the software renderer
  double map_bytes = 0;
  double pixels = 0;  ///< that the object covers
  std::vector<GpuCost> gpus;
};
void fields(auto& archive, Is<MethodCosts> auto& value) {
  archive("method", value.method);
  archive("trips", value.trips);
  archive("lookups", value.lookups);
  archive("map_bytes", value.map_bytes);
  archive("pixels", value.pixels);
  archive("gpus", value.gpus);
}

/// The costs of some methods over one scene: the content of cost.json.
struct CostReport {
  std::string schema = "footprint-cost/1";
  ToolInfo tool;
  BackendInfo backend;
  SceneInfo scene;
  std::string footprint, compiler;
  std::array<int, 2> size{};
  double distance = 1;
  std::vector<MethodCosts> methods;
};
void fields(auto& archive, Is<CostReport> auto& value) {
  archive("schema", value.schema);
  archive("tool", value.tool);
  archive("backend", value.backend);
  archive("scene", value.scene);
  archive("footprint", value.footprint);
  archive("compiler", value.compiler);
  archive("size", value.size);
  archive("distance", value.distance);
  archive("methods", value.methods);
}

/// One Markdown table per GPU: a line per method, with its cost over that of the first method.
[[nodiscard]] std::string cost_table(const CostReport& report);

/// The tables of cost_table for each distance of a run, as a section of table.md and of the page; empty without
/// estimates.
[[nodiscard]] std::string gpu_costs_markdown(const Results& results);
[[nodiscard]] std::string gpu_costs_html(const Results& results);

/// Writes cost.json, cost.csv and table.md into `folder`, each atomically. Throws Error (machine).
void write_cost(const CostReport& report, const RunFolder& folder);

/// Paths below the output folder.
struct NdfImages {
  std::string density;     ///< EXR, per solid angle, over the x-y disc
  std::string picture;     ///< PNG of the same in false colour
  std::string difference;  ///< PNG of |method - exact| on the same scale; empty for the exact NDF
};
void fields(auto& archive, Is<NdfImages> auto& value) {
  archive("density", value.density);
  archive("picture", value.picture);
  archive("difference", value.difference);
}

/// One method's effective NDF next to the exact one. Figures that are not finite could not be measured.
struct NdfRecord {
  double l2 = 0.0;      ///< relative L2 error over solid angle
  double energy = 0.0;  ///< over the exact NDF's
  double peak = 0.0;    ///< largest density, per steradian
  int lobes = 0;        ///< evaluated per pixel
  std::map<std::string, std::variant<double, std::string>> options;
  NdfImages images;
};
void fields(auto& archive, Is<NdfRecord> auto& value) {
  archive("l2", value.l2);
  archive("energy", value.energy);
  archive("peak", value.peak);
  archive("lobes", value.lobes);
  archive("options", value.options);
  archive("images", value.images);
}

/// The exact NDF of the footprint.
struct ExactNdfRecord {
  double energy = 0.0;           ///< its integral over the grid
  double expected_energy = 0.0;  ///< its energy by the lobes' own integrals
  double peak = 0.0;
  struct Images {
    std::string density, picture;
  } images = {};
};
void fields(auto& archive, Is<ExactNdfRecord::Images> auto& value) {
  archive("density", value.density);
  archive("picture", value.picture);
}

void fields(auto& archive, Is<ExactNdfRecord> auto& value) {
  archive("energy", value.energy);
  archive("expected_energy", value.expected_energy);
  archive("peak", value.peak);
  archive("images", value.images);
}

/// The content of ndf.json.
struct NdfResults {
  std::string schema = "footprint-ndf/1";
  ToolInfo tool = {};
  struct Source {
    std::string path;           ///< SCENE or MAP as given
    std::string kind;           ///< scene or map
    std::string material;       ///< its name
    int width = 1, height = 1;  ///< of the normal map
  } source = {};
  struct Lobe {
    std::string narrowest;  ///< blinn_phong:64
    bool varies = false;    ///< over the footprint
  } lobe = {};
  struct Region {
    double u0 = 0.0, v0 = 0.0, u1 = 0.0, v1 = 0.0;
  } footprint = {};
  struct Texels {
    double area = 0.0;         ///< the footprint's, in texels of the normal map
    double valid_share = 1.0;  ///< of that area
    std::size_t distinct = 0;  ///< different facets among them
  } texels = {};
  struct Fetch {
    double level = 0.0;  ///< that an isotropic trilinear fetch takes
    std::string filter;  ///< the footprint filter
  } fetch = {};
  struct Grid {
    int resolution = 0;          ///< rings of directions
    std::size_t directions = 0;  ///< in all
    bool fine_enough = true;     ///< energy and expected_energy agree to `ndf_energy_tolerance`
  } grid = {};
  struct Pictures {
    double scale = 0.0;  ///< density at the light end of the false-colour scale
    std::string strip;   ///< the picture of all
  } pictures = {};
  ExactNdfRecord truth = {};
  std::vector<std::pair<std::string, NdfRecord>> methods = {};  ///< by their names as written
  std::vector<std::string> notes = {};                          ///< what was left out or supplied, one line each
};
void fields(auto& archive, Is<NdfResults::Source> auto& value) {
  archive("path", value.path);
  archive("kind", value.kind);
  archive("material", value.material);
  archive("width", value.width);
  archive("height", value.height);
}

void fields(auto& archive, Is<NdfResults::Lobe> auto& value) {
  archive("narrowest", value.narrowest);
  archive("varies", value.varies);
}

void fields(auto& archive, Is<NdfResults::Region> auto& value) {
  archive("u0", value.u0);
  archive("v0", value.v0);
  archive("u1", value.u1);
  archive("v1", value.v1);
}

void fields(auto& archive, Is<NdfResults::Texels> auto& value) {
  archive("area", value.area);
  archive("valid_share", value.valid_share);
  archive("distinct", value.distinct);
}

void fields(auto& archive, Is<NdfResults::Fetch> auto& value) {
  archive("level", value.level);
  archive("filter", value.filter);
}

void fields(auto& archive, Is<NdfResults::Grid> auto& value) {
  archive("resolution", value.resolution);
  archive("directions", value.directions);
  archive("fine_enough", value.fine_enough);
}

void fields(auto& archive, Is<NdfResults::Pictures> auto& value) {
  archive("scale", value.scale);
  archive("strip", value.strip);
}

void fields(auto& archive, Is<NdfResults> auto& value) {
  archive("schema", value.schema);
  archive("tool", value.tool);
  archive("source", value.source);
  archive("lobe", value.lobe);
  archive("footprint", value.footprint);
  archive("texels", value.texels);
  archive("fetch", value.fetch);
  archive("grid", value.grid);
  archive("pictures", value.pictures);
  archive("truth", value.truth);
  archive("methods", value.methods);
  archive("notes", value.notes);
}

/// The grid is too coarse if its integral of the exact NDF differs from the lobes' own by a larger share.
inline constexpr double ndf_energy_tolerance = 0.005;

[[nodiscard]] std::string ndf_json(const NdfResults& results);

/// The page: the densities in the comparator, their differences, and the table.
[[nodiscard]] std::string ndf_page(const NdfResults& results);

/// One row per method, and the exact NDF's.
[[nodiscard]] std::string ndf_table(const NdfResults& results);

}  // namespace footprint
