// results.csv, read back by a small reader of RFC 4180 that knows nothing of the writer, and its list of columns.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "results/report/figure_table.hpp"
#include "results/report/record_fields.hpp"
#include "results/report/report.hpp"
#include "tests/report/example_animation.hpp"
#include "tests/report/example_results.hpp"
#include "tests/support/says.hpp"
#include "tests/support/source_folder.hpp"

namespace footprint {
namespace {

using Line = std::vector<std::string>;

std::vector<Line> read_csv(const std::string& text) {
  std::vector<Line> lines(1, Line(1));
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string& field = lines.back().back();
    if (quoted && text[i] == '"' && i + 1 < text.size() && text[i + 1] == '"') {
      field += text[i++];
    } else if (text[i] == '"') {
      quoted = !quoted;
    } else if (!quoted && text[i] == ',') {
      lines.back().emplace_back();
    } else if (!quoted && text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n') {
      lines.emplace_back(1);
      ++i;
    } else {
      field += text[i];
    }
  }
  lines.pop_back();  // the empty text after the last line end
  return lines;
}

std::string value(const std::vector<Line>& lines, std::size_t line, const std::string& column) {
  for (std::size_t i = 0; i < lines[0].size(); ++i) {
    if (lines[0][i] == column) return lines[line][i];
  }
  ADD_FAILURE() << "no column " << column;
  return {};
}

TEST(ResultsCsv, OneLineARecordWithAllColumns) {
  for (const Results& results : {example_results(), hostile_results()}) {
    const std::vector<Line> lines = read_csv(results_csv(results));
    ASSERT_EQ(lines.size(), results.records.size() + 1);
    for (const Line& line : lines) EXPECT_EQ(line.size(), lines[0].size());
  }
}

TEST(ResultsCsv, FiguresStandUnderTheirColumn) {
  const Results results = example_results();
  const std::vector<Line> lines = read_csv(results_csv(results));
  const Record& record = results.records[3];
  EXPECT_EQ(value(lines, 4, "method"), "toksvig:storage=unorm8");
  EXPECT_EQ(std::stod(value(lines, 4, "normalized_color_error")), record.error->normalized_color);
  EXPECT_EQ(std::stod(value(lines, 4, "filtering_error")), record.error->filtering);
  EXPECT_EQ(std::stod(value(lines, 4, "shading_error")), record.error->causes.shading);
  EXPECT_EQ(std::stod(value(lines, 4, "edges_error")), record.error->causes.edges);
  EXPECT_EQ(std::stod(value(lines, 4, "method_error")), record.error->causes.method);
  EXPECT_EQ(value(lines, 4, "light_error"), "");
  EXPECT_EQ(value(lines, 2, "light_error"), "0.0021");
  EXPECT_EQ(value(lines, 2, "fetches"), "96.5");
  EXPECT_EQ(value(lines, 2, "lobes"), "12.25");
  EXPECT_EQ(value(lines, 4, "interior_pixels"), "9260");
  EXPECT_EQ(value(lines, 4, "bound_pixels"), "9260");
  EXPECT_EQ(value(lines, 5, "bound_pixels"), "");
  EXPECT_EQ(value(lines, 4, "image_interior"), "images/interior_d1.exr");
  ASSERT_TRUE(record.equivalent);
  EXPECT_EQ(std::stod(value(lines, 4, "equivalent_spp")), record.equivalent->spp);
  EXPECT_EQ(std::stod(value(lines, 4, "frame_p90_ms")), record.frame_ms.p90);
  EXPECT_EQ(std::stod(value(lines, 4, "ratio_to_direct_high")), record.ratio_to_direct.high);
  EXPECT_EQ(value(lines, 4, "frame_build_ms"), "0.31");
  EXPECT_EQ(value(lines, 4, "frame_build"), "every frame");
  EXPECT_EQ(value(lines, 4, "precompute_bytes"), "4194304");
  EXPECT_EQ(value(lines, 4, "precompute_bytes_per_texel"), "16");
  EXPECT_EQ(value(lines, 4, "precompute_cached"), "true");
  EXPECT_EQ(value(lines, 4, "effects_on"), "diffuse;fresnel;normal_variation");
  EXPECT_EQ(value(lines, 4, "options"), "probes=1;storage=fp32");
  EXPECT_EQ(value(lines, 4, "image_error"), "images/method3_d1_error.png");
  EXPECT_EQ(value(lines, 1, "height_px"), "256");
}

TEST(ResultsCsv, AbsentFiguresAreEmptyAndNamesSurvive) {
  const Results results = hostile_results();
  const std::vector<Line> lines = read_csv(results_csv(results));
  EXPECT_EQ(value(lines, 1, "scene"), results.scene.name);
  EXPECT_EQ(value(lines, 2, "method"), results.records[1].method);
  EXPECT_EQ(value(lines, 3, "normalized_color_error"), "");
  EXPECT_EQ(value(lines, 3, "equivalent_bound"), "n/a");
  EXPECT_EQ(value(lines, 4, "psnr_db"), "");
  EXPECT_EQ(value(lines, 4, "normalized_color_error"), "0");
  EXPECT_EQ(value(lines, 4, "ratio_to_direct_median"), "");
}

/// The table of docs/reference/results.md: adjacent columns of one unit share a row.
std::string documented_columns() {
  std::string text = "| columns | unit |\n|---|---|\n", names;
  const std::span<const Figure> columns = record_figures();
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (*columns[i].place == '\0') continue;
    names += fmt::format("{}`{}`", names.empty() ? "" : ", ", columns[i].key);
    if (i + 1 < columns.size() && columns[i + 1].unit == columns[i].unit) continue;
    text += fmt::format("| {} | {} |\n", names, columns[i].unit);
    names.clear();
  }
  return text;
}

TEST(ResultsCsv, TheDocumentListsEveryColumnWithItsUnit) {
  std::ostringstream document;
  document << std::ifstream(testing::source_folder() / "docs/reference/results.md").rdbuf();
  EXPECT_TRUE(test::says(document.str(), documented_columns()));
}

TEST(Figures, HaveKeysOfTheirOwn) {
  std::set<std::string_view> keys;
  for (const Figure& figure : record_figures()) EXPECT_TRUE(keys.insert(figure.key).second) << figure.key;
  EXPECT_THROW((void)figure_of("nothing"), std::logic_error);
}

/// What results.csv has of a value of results.json.
std::string csv_text(const nlohmann::ordered_json& value) {
  if (value.is_null()) return {};
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number()) return fmt::format("{}", value.get<double>());
  if (!value.is_structured()) return value.dump();
  std::string text;
  for (const auto& [name, part] : value.items())
    text += (text.empty() ? "" : ";") + (value.is_object() ? name + "=" : "") + csv_text(part);
  return text;
}

/// The value at a place of results.json; null where a part of the path is null. Fails if the document has no such
/// place.
nlohmann::ordered_json value_at(const nlohmann::ordered_json& record, const char* place) {
  nlohmann::ordered_json::json_pointer at(place);
  if (record.contains(at)) return record.at(at);
  while (!at.empty() && !record.contains(at)) at.pop_back();
  EXPECT_TRUE(!at.empty() && record.at(at).is_null()) << place;
  return {};
}

TEST(Figures, AreTheValuesAtTheirPlacesOfTheJson) {
  for (const Results& results : {example_results(), hostile_results(), example_animation()}) {
    const std::vector<Line> lines = read_csv(results_csv(results));
    for (std::size_t i = 0; i < results.records.size(); ++i) {
      const nlohmann::ordered_json record = to_json_value(results.records[i]);
      for (const Figure& figure : record_figures()) {
        if (*figure.place == '\0') continue;
        EXPECT_EQ(value(lines, i + 1, std::string(figure.key)), csv_text(value_at(record, figure.place))) << figure.key;
      }
    }
  }
}

TEST(Figures, OfAnyTwoImagesHaveWhatTablesAndScoresPrint) {
  for (const Figure& figure : record_figures()) {
    if (!figure.metric) continue;
    EXPECT_TRUE(std::string_view(figure.place).starts_with("/error/")) << figure.key;
    EXPECT_FALSE(figure.title.empty() || figure.meaning.empty() || figure.format == nullptr) << figure.key;
    EXPECT_FALSE(figure.call.name.empty()) << figure.key;
  }
}

}  // namespace
}  // namespace footprint
