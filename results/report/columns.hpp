// The columns of a record, listed once: results.csv, table.md, the page and results.md are written from this list.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "results/report/records.hpp"

namespace footprint {

/// A column of records and what reports say about it.
struct Column {
  std::string_view key;        ///< the name in results.csv and in the address of the page
  const char* place = "";      ///< JSON pointer into a record of results.json; empty: not in results.csv
  std::string_view unit;       ///< in results.md
  std::string_view title{};    ///< the heading in tables; empty: no table has the column
  std::string_view meaning{};  ///< on the page
  std::string_view note{};     ///< below table.md
  /// Writes the number at `place`, or several figures of the record; null: the tables write it themselves.
  std::string (*format)(const std::optional<double>& value, const Record& record) = nullptr;
  bool is_words = false;  ///< aligned left
};

/// All columns, in the order of results.csv.
[[nodiscard]] std::span<const Column> record_columns();

/// The column of that key. Throws std::logic_error if there is none.
[[nodiscard]] const Column& column_of(std::string_view key);

/// The cell of a column with a format.
/// json: the record as results.json has it.
[[nodiscard]] std::string cell_text(const Column& column, const Record& record, const nlohmann::ordered_json& json);

/// `text` with characters that a terminal's font lacks replaced: "–", "×" and the no-break space.
[[nodiscard]] std::string plain(std::string_view text);

/// The columns of errors and of times, in the order of table.md and the page.
inline constexpr std::array<std::string_view, 10> error_columns{
    "rank",        "normalized_color_error", "shading_error",  "edges_error",    "filter_error", "method_error",
    "light_error", "representation_error",   "equivalent_spp", "interior_pixels"};
inline constexpr std::array<std::string_view, 5> time_columns{"frame_median_ms", "ratio_to_direct_median",
                                                              "frames_per_second", "fetches", "lobes"};

}  // namespace footprint
