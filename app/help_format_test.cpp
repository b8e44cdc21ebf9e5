// `--help` shows what an option takes and its default, in lines that fit a terminal.
#include "app/help_format.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <sstream>
#include <string>

#include "tests/support/says.hpp"

namespace footprint {
namespace {

using test::says;

std::string help() {
  static std::string scene, output;
  static int count = 3;
  CLI::App app("Renders.", "footprint");
  app.formatter(std::make_shared<HelpFormat>());
  CLI::App* draw = app.add_subcommand("draw", "Draws.");
  draw->add_option("scene", scene, "What to draw")->type_name("SCENE")->required();
  draw->add_option("-o,--output", output, "Where")->type_name("DIR:DIR")->required();
  draw->add_option("--count", count,
                   "How often, in words that go on for so long that no terminal of 100 columns has room")
      ->check(CLI::Range(1, 9))
      ->capture_default_str();
  draw->add_option("--first", count, "The first")->group("Others");
  draw->add_option("--last", count, "The last")->group("More");
  return draw->help("footprint");
}

TEST(HelpFormat, ShowsWhatAnOptionTakesAndItsDefault) {
  const std::string text = help();
  EXPECT_TRUE(says(text, "\nUsage: footprint draw SCENE [OPTION]...\n"));
  EXPECT_TRUE(says(text, "\n  SCENE                     What to draw\n"));
  EXPECT_TRUE(says(text, "\n  -o, --output DIR:DIR      Where (required)\n"));
  EXPECT_TRUE(says(text, "\n  --count N                 How often,"));
  EXPECT_TRUE(says(text, "(1 to 9); default: 3\n"));
}

TEST(HelpFormat, FitsATerminal) {
  std::istringstream lines(help());
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), HelpFormat::width) << line;
  EXPECT_EQ(help().find("\n\n\n"), std::string::npos) << "one empty line between groups";
}

}  // namespace
}  // namespace footprint
