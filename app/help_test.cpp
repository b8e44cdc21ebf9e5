// `--help` shows what an option takes and its default, in lines that fit a terminal. The completions offer every
// command, option and name, and nothing that --help hides; bash runs its script.
#include "app/help.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>

#include "renderer/core/error.hpp"
#include "tests/support/fresh_folder.hpp"
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

// The words that are offered for a command line with one of each kind of option.
std::string offered(const std::vector<std::string>& words) {
  struct Values {
    std::string scene, method, output, hidden;
    bool quick = false;
  } values;
  CLI::App app("Renders.\nMore of it.", "footprint");
  CLI::App* draw = app.add_subcommand("draw", "Draw it: don't wait [now]");
  draw->add_option("scene", values.scene, "Which scene")->type_name("SCENE")->required();
  draw->add_option("--methods,--method", values.method, "How");
  draw->add_option("-o,--output", values.output, "Where");
  draw->add_flag("--quick", values.quick, "Soon\nor sooner");
  draw->add_option("--hidden", values.hidden, "For no one")->group("");
  return offered_words(app, words, [](std::string_view kind) {
    return std::vector<std::string>{std::string(kind) + "_one", "other_" + std::string(kind)};
  });
}

TEST(Completions, OfferCommandsWithTheirDescriptions) {
  EXPECT_EQ(offered({"dr"}), "draw\tDraw it: don't wait [now]\n");
  EXPECT_EQ(offered({"x"}), "");
  EXPECT_EQ(offered({"unknown", ""}), "");
  EXPECT_EQ(offered({}), "");
}

TEST(Completions, OfferTheOptionsThatHelpShows) {
  EXPECT_EQ(offered({"draw", "--q"}), "--quick\tSoon\n");
  EXPECT_EQ(offered({"draw", "--me"}), "--methods\tHow\n--method\tHow\n");
  EXPECT_EQ(offered({"draw", "--quick", "-o"}), "-o\tWhere\n");
  EXPECT_EQ(offered({"draw", "--hi"}), "");
}

TEST(Completions, OfferNamesWhereAnArgumentTakesThem) {
  EXPECT_EQ(offered({"draw", ""}), "scenes_one\t\nother_scenes\t\n");
  EXPECT_EQ(offered({"draw", "bumps", "--method", "m"}), "methods_one\t\n");
  EXPECT_EQ(offered({"draw", "bumps", "--output", ""}), "") << "files";
  EXPECT_EQ(offered({"draw", "bumps", "--quick", "--o"}), "--output\tWhere\n") << "a flag takes no value";
}

TEST(Completions, AnotherShellIsAnError) {
  try {
    (void)completion_script("tcsh");
    FAIL() << "tcsh was taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_NE(std::string(error.what()).find("tcsh"), std::string::npos);
  }
}

// The completions that bash offers for a partial command line.
TEST(Completions, BashPassesTheWordsUpToTheCursor) {
  const std::string folder = test::fresh_folder().string() + "/";
  std::ofstream(folder + "footprint.bash") << completion_script("bash");
  std::ofstream(folder + "complete.sh") << "footprint() { printf '<%s>\\tmeaning\\n' \"$@\"; }\nsource '" << folder
                                        << "footprint.bash'\nCOMP_WORDS=(footprint draw --q '' later)\nCOMP_CWORD=3\n"
                                        << "_footprint\necho \"${COMPREPLY[@]}\" > '" << folder << "offered'\n";
  ASSERT_EQ(std::system(("bash '" + folder + "complete.sh'").c_str()), 0);
  std::ifstream in(folder + "offered");
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "<completions> <offer> <--> <draw> <--q> <>");
}

}  // namespace
}  // namespace footprint
