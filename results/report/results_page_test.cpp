// index.html as text: whole, self-contained, and safe from the names in it. page_test.py opens it in a browser.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "renderer/core/error.hpp"
#include "results/report/figures.hpp"
#include "results/report/page.hpp"
#include "results/report/report.hpp"
#include "results/report/results_table.hpp"
#include "tests/report/example_results.hpp"
#include "tests/support/fresh_folder.hpp"

namespace footprint {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++found;
  return found;
}

std::string read(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

TEST(TextTemplate, FillsOnceAndEscapes) {
  EXPECT_EQ(fill_template("a{{x}}b{{y}}", {{"x", "{{y}}"}, {"y", "2"}}), "a{{y}}b2");
  EXPECT_THROW((void)fill_template("{{z}}", {}), std::logic_error);
  EXPECT_EQ(html_escaped("<a href=\"x\">'&"), "&lt;a href=&quot;x&quot;&gt;&#39;&amp;");
  EXPECT_EQ(script_escaped("\"</script><!--\""), "\"\\u003c/script>\\u003c!--\"");
}

TEST(ResultsPage, IsWholeAndAsksForNothingFromTheNetwork) {
  const std::string page = results_page(example_results());
  EXPECT_TRUE(page.starts_with("<!doctype html>"));
  EXPECT_TRUE(page.ends_with("</html>\n"));
  EXPECT_EQ(count(page, "Chart.js v3"), 1U);
  EXPECT_EQ(count(page, "<link rel=\"stylesheet\""), 0U);
  EXPECT_EQ(count(page, "<script src"), 0U);
  EXPECT_EQ(count(page, "@import"), 0U);
  EXPECT_EQ(count(page, "default-src 'none'"), 1U);
}

nlohmann::json data_of(const std::string& page) {
  const std::string element = R"(<script type="application/json" id="data">)";
  const std::size_t begin = page.find(element) + element.size();
  return nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

TEST(ResultsPage, OfAMatrixCarriesTheDocumentsOfItsMembers) {
  const MatrixResults matrix = example_matrix(3);
  const auto data = data_of(matrix_page(matrix));
  ASSERT_EQ(data.at("runs").size(), matrix.members.size());
  for (std::size_t i = 0; i < matrix.members.size(); ++i) {
    const auto& run = data.at("runs").at(i);
    EXPECT_EQ(run.at("folder"), matrix.members[i].folder);
    EXPECT_EQ(run.at("coordinates").at("footprint"), i % 2 == 0 ? "trilinear" : "anisotropic:8");
    EXPECT_EQ(run.at("results"), nlohmann::json::parse(results_json(matrix.members[i].results)));
  }
}

TEST(ResultsPage, CarriesTheDocumentOfResultsJson) {
  const Results results = hostile_results();
  const auto data = data_of(results_page(results));
  ASSERT_EQ(data.at("runs").size(), 1U);
  EXPECT_EQ(data.at("runs").front().at("folder"), "");
  EXPECT_EQ(data.at("runs").front().at("results"), nlohmann::json::parse(results_json(results)));
  EXPECT_EQ(data.at("runs").front().at("display").size(), results.records.size());
  for (const Record& record : results.records) EXPECT_TRUE(data.at("color_places").contains(record.method));
  EXPECT_EQ(data.at("scale_colors").size(), 256U);
  EXPECT_NE(data.at("scale_colors").front(), data.at("scale_colors").back());
}

TEST(ResultsPage, NamesAddNoElement) {
  const std::string plain = results_page(example_results());
  const std::string hostile = results_page(hostile_results());
  for (const char* tag : {"<script", "</script", "<img", "<b>", "<!--"}) {
    EXPECT_EQ(count(hostile, tag), count(plain, tag)) << tag;
  }
}

class WriteReport : public ::testing::Test {
 protected:
  const std::filesystem::path folder_ = test::fresh_folder();
};

TEST_F(WriteReport, WritesTheFourFiles) {
  const Results results = example_results();
  write_report(results, folder_);
  EXPECT_EQ(read(folder_ / "results.json"), results_json(results));
  EXPECT_EQ(read(folder_ / "results.csv"), results_csv(results));
  EXPECT_EQ(read(folder_ / "table.md"), results_table(results));
  EXPECT_EQ(read(folder_ / "index.html"), results_page(results));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 4);
}

TEST_F(WriteReport, AFolderThatIsNotThereIsAMachineError) {
  try {
    write_report(example_results(), folder_ / "absent");
    FAIL() << "wrote into a folder that is not there";
  } catch (const Error& fault) {
    EXPECT_EQ(fault.kind(), ErrorKind::machine);
  }
}

}  // namespace
}  // namespace footprint
