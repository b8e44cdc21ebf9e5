// Files that an earlier run's results.json lists are found in documents of this program, and in no other file.
#include "results/report/listed_files.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "results/report/report.hpp"
#include "tests/report/example_results.hpp"
#include "tests/support/fresh_folder.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;

TEST(ListedFiles, AreThePicturesOfTheDocument) {
  const fs::path folder = test::fresh_folder();
  const Results results = example_results();
  write_report(results, folder);
  const std::vector<fs::path> files = listed_files(folder / "results.json");
  for (const std::string& color : {results.records.at(0).images.color, results.records.at(0).images.reference}) {
    EXPECT_NE(std::ranges::find(files, fs::path(color)), files.end()) << color;
    EXPECT_NE(std::ranges::find(files, fs::path(color).replace_extension(".png")), files.end()) << color;
  }
  for (const fs::path& file : files) EXPECT_EQ(*file.begin(), "images") << file;
}

TEST(ListedFiles, AreNoneOfWhatIsNotOurs) {
  const fs::path folder = test::fresh_folder();
  const auto found = [&](const char* text) {
    std::ofstream(folder / "results.json") << text;
    return listed_files(folder / "results.json").size();
  };
  EXPECT_EQ(found(R"({"schema": "footprint-results/2", "x": "images/a.png"})"), 1U);
  EXPECT_EQ(found(R"({"schema": "another", "x": "images/a.png"})"), 0U);
  EXPECT_EQ(found(R"({"x": "images/a.png"})"), 0U);
  EXPECT_EQ(found(R"(["images/a.png"])"), 0U);
  EXPECT_EQ(found(R"({"schema": 7)"), 0U);
  EXPECT_EQ(found(""), 0U);
  EXPECT_TRUE(listed_files(folder / "absent.json").empty());
}

}  // namespace
}  // namespace footprint
