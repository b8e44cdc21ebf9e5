// The figures of a record, one row each: the only place that gives a figure its names, unit, meaning and format. The
// row feeds results.json (image metrics), results.csv, the tables, the page, `score`, claims and thresholds, the
// schemas and docs/reference/results.md.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "renderer/image/metrics.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// An error measure of any two images. One that may be missing is optional.
using ImageMetric = std::variant<double ErrorFigures::*, std::optional<double> ErrorFigures::*>;

/// The needs of a figure in an experiment, besides a method.
enum class FigureNeeds {
  nothing,
  other_reference,  ///< where `spp` selects one: the reference of so many samples
  frame_before      ///< the frames of a zoom, of which the first has no figure
};

/// The function of a figure in the expressions of experiments.
struct FigureCall {
  std::string_view name{};  ///< "edge_error"; empty: there is no such function
  FigureNeeds needs = FigureNeeds::nothing;
  std::string_view absent = "no record has this figure";  ///< the problem if no record has it
};

/// A row of the table.
struct Figure {
  std::string_view key;     ///< the name in results.csv and in the address of the page; a function has it as an alias
  const char* place = "";   ///< JSON pointer into a record of results.json; empty: not in results.json and results.csv
  std::string_view unit{};  ///< in results.md
  /// A measure of any two images, which the field at `place` has and `footprint score` prints; none: the row has
  /// `number` or `text`.
  std::optional<ImageMetric> metric = {};
  std::optional<double> (*number)(const Record& record) = nullptr;
  std::string (*text)(const Record& record) = nullptr;
  /// The part of the number that the reference's own noise causes; null: it is not known.
  std::optional<double> (*noise)(const Record& record) = nullptr;
  std::string_view title{};    ///< the heading in tables; empty: no table has the figure
  std::string_view meaning{};  ///< on the page, of some below table.md, and in the schema of an image metric
  /// Writes the number, or several figures of the record; null: the tables write it themselves.
  std::string (*format)(const std::optional<double>& value, const Record& record) = nullptr;
  FigureCall call = {};
  bool is_words = false;          ///< aligned left
  bool is_of_machine = false;     ///< a time, which belongs to the machine that it was taken on
  bool is_of_radiance = false;    ///< an image metric that images of displayed colours do not have
  bool is_better_larger = false;  ///< an image metric without an upper limit

  /// The number of a record; none if it is absent. It may be infinite or not a number.
  [[nodiscard]] std::optional<double> of(const Record& record) const;
};

/// All figures, in the order of results.csv.
[[nodiscard]] std::span<const Figure> record_figures();

/// The figure of that key. Throws std::logic_error if there is none.
[[nodiscard]] const Figure& figure_of(std::string_view key);

/// The name of an image metric in the JSON of records and of scores: the last part of its place.
[[nodiscard]] const char* metric_name(const Figure& figure);

/// The value of an image metric; none if it is missing.
/// metric: of a row that has one.
[[nodiscard]] std::optional<double> metric_value(const ImageMetric& metric, const ErrorFigures& figures);

/// The cell of a figure with a format.
[[nodiscard]] std::string cell_text(const Figure& figure, const Record& record);

/// The names of the columns of results.csv, and their values of a record; without an end of the line.
[[nodiscard]] std::string csv_header();
[[nodiscard]] std::string csv_line(const Record& record);

/// The figures of errors and of times, in the order of table.md and the page.
inline constexpr std::array<std::string_view, 10> error_columns{
    "rank",        "normalized_color_error", "shading_error",  "edges_error",    "filter_error", "method_error",
    "light_error", "representation_error",   "equivalent_spp", "interior_pixels"};
inline constexpr std::array<std::string_view, 5> time_columns{"frame_median_ms", "ratio_to_direct_median",
                                                              "frames_per_second", "fetches", "lobes"};

}  // namespace footprint
