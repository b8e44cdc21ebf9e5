// The manual page and the completions hold every command and option that the command line shows, and nothing else.
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <fstream>

#include "app/self_description/command_tree.hpp"
#include "app/self_description/completions.hpp"
#include "app/self_description/manual_page.hpp"
#include "renderer/core/error.hpp"

namespace footprint {
namespace {

struct Values {
  std::string scene, method, output, hidden;
  int count = 3;
  bool quick = false;
};

// A command line with one of each kind of option.
CommandPage example() {
  static Values values;
  CLI::App app("Renders.\nMore of it.", "footprint");
  CLI::App* draw = app.add_subcommand("draw", "Draw it: don't wait [now]");
  draw->add_option("scene", values.scene, "What to draw")->required();
  draw->add_option("--method", values.method, "How");
  draw->add_option("-o,--output", values.output, "Where");
  draw->add_option("--count", values.count, "How often")->check(CLI::Range(1, 9))->capture_default_str();
  draw->add_flag("--quick", values.quick, "Soon");
  draw->add_option("--hidden", values.hidden, "For no one")->group("");
  draw->footer("Words.\n\nExamples:\n  footprint draw a\\b\n.hidden");
  return command_tree(app);
}

bool holds(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

TEST(CommandTree, HoldsWhatHelpShows) {
  const CommandPage page = example();
  ASSERT_EQ(page.subcommands.size(), 1U);
  const CommandPage& draw = page.subcommands.front();
  std::vector<std::string> names;
  for (const CommandOption& option : draw.options) names.push_back(option.names.back());
  EXPECT_EQ(names, (std::vector<std::string>{"--help", "scene", "--method", "--output", "--count", "--quick"}));
  EXPECT_TRUE(draw.options[1].positional && draw.options[1].required);
  EXPECT_EQ(draw.options[3].names, (std::vector<std::string>{"-o", "--output"}));
  EXPECT_TRUE(holds(draw.options[4].help, "How often (default 3)")) << draw.options[4].help;
  EXPECT_TRUE(draw.options[5].value.empty()) << "a flag takes nothing";
}

TEST(ManualPage, HasEachCommandAndEscapesWhatRoffReads) {
  const std::string page = manual_page(example(), "1.2");
  EXPECT_TRUE(page.starts_with(".TH FOOTPRINT 1 \"\" \"footprint 1.2\"")) << page;
  for (const char* part :
       {".SS draw\n", "\\-\\-method", "\\-o, \\-\\-output", "footprint draw a\\eb", "\\&.hidden", "SCENE"}) {
    EXPECT_TRUE(holds(page, part)) << part << "\n" << page;
  }
  EXPECT_FALSE(holds(page, "For no one"));
}

TEST(Completions, EveryShellKnowsEveryOption) {
  for (const char* shell : {"bash", "zsh", "fish"}) {
    const std::string script = completion_script(example(), shell);
    for (const char* part : {"draw", "method", "output", "quick", "footprint list methods", "footprint list scenes"}) {
      EXPECT_TRUE(holds(script, part)) << shell << ": " << part << "\n" << script;
    }
    EXPECT_FALSE(holds(script, "hidden")) << shell;
  }
}

TEST(Completions, AnotherShellIsAnError) {
  try {
    (void)completion_script(example(), "tcsh");
    FAIL() << "tcsh was taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_TRUE(holds(error.what(), "tcsh"));
  }
}

// What bash itself offers for the words of a command line that is being typed.
std::string completed(const std::string& words, int position) {
  const std::string folder = ::testing::TempDir();
  std::ofstream(folder + "footprint.bash") << completion_script(example(), "bash");
  std::ofstream(folder + "complete.sh") << "footprint() { echo \"  $2_one   words\"; }\nsource '" << folder
                                        << "footprint.bash'\nCOMP_WORDS=(" << words << ")\nCOMP_CWORD=" << position
                                        << "\n_footprint\necho \"${COMPREPLY[@]}\" > '" << folder << "offered'\n";
  EXPECT_EQ(std::system(("bash '" + folder + "complete.sh'").c_str()), 0);
  std::ifstream offered(folder + "offered");
  std::string line;
  std::getline(offered, line);
  return line;
}

TEST(Completions, BashOffersCommandsOptionsAndNames) {
  EXPECT_EQ(completed("footprint dr", 1), "draw");
  EXPECT_EQ(completed("footprint draw --q", 2), "--quick");
  EXPECT_EQ(completed("footprint draw --method ''", 3), "methods_one");
  EXPECT_EQ(completed("footprint draw ''", 2), "scenes_one");
}

}  // namespace
}  // namespace footprint
