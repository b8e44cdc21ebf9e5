// The table of functions against the list that docs/reference/experiments.md prints.
#include "experiments/runner/expression.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <utility>

#include "tests/support/source_folder.hpp"

namespace footprint {
namespace {

using Words = std::vector<std::string>;

/// The words between backticks.
Words quoted(const std::string& text) {
  Words words;
  for (std::size_t open = text.find('`'); open != std::string::npos; open = text.find('`', open)) {
    const std::size_t close = text.find('`', open + 1);
    words.push_back(text.substr(open + 1, close - open - 1));
    open = close + 1;
  }
  return words;
}

/// Each function of the document's list with its selectors.
std::vector<std::pair<std::string, Words>> documented() {
  std::ifstream document(testing::source_folder() / "docs/reference/experiments.md");
  std::vector<std::pair<std::string, Words>> list;
  std::string line;
  while (std::getline(document, line) && !line.starts_with("| function |")) continue;
  std::getline(document, line);  // the rule below the head
  while (std::getline(document, line) && line.starts_with("|")) {
    const std::size_t second = line.find('|', 1), third = line.find('|', second + 1);
    const Words selectors = quoted(line.substr(second, third - second));
    for (const std::string& name : quoted(line.substr(0, second))) list.emplace_back(name, selectors);
  }
  return list;
}

TEST(Functions, AreThoseOfTheDocument) {
  std::vector<std::pair<std::string, Words>> table;
  for (const FigureFunction& function : figure_functions()) {
    Words selectors;
    for (const Selector selector : function.selectors) selectors.emplace_back(selector_name(selector));
    table.emplace_back(function.name, selectors);
  }
  EXPECT_EQ(table, documented());
}

}  // namespace
}  // namespace footprint
