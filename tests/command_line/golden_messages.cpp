// A line of the file is a row, a tab and its message.
#include "tests/command_line/golden_messages.hpp"

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <utility>

#include "tests/support/source_folder.hpp"

namespace footprint::test {
namespace {

constexpr std::string_view any = "<any>";

std::filesystem::path golden_file() { return testing::source_folder() / "tests/command_line/messages.golden"; }

// "BadModel/CommandLine" and "EndsAsItShould/NoBuffer" make "BadModel/NoBuffer".
std::string row_name(const std::string& suite, const std::string& test) {
  const std::size_t slash = test.find('/');
  return suite.substr(0, suite.find('/')) + "/" + (slash == std::string::npos ? test : test.substr(slash + 1));
}

std::string running_row() {
  const ::testing::TestInfo& test = *::testing::UnitTest::GetInstance()->current_test_info();
  return row_name(test.test_suite_name(), test.name());
}

// Leaves out the words that are not the program's own, or that change with what it has: lists of names, amounts of
// memory, where an interrupt was noticed, and what parsers and drivers say.
std::string generalised(std::string message) {
  const std::pair<const char*, const char*> rules[]{
      {"known: [^)]*", "known: <any>"},
      {"[0-9.]+ [KMGT]iB", "<any>"},
      {"footprint: (.*: )?interrupted", "footprint: <any>interrupted"},
      {"(not valid (JSON|TOML)): .* \\(", "$1: <any> ("},
      {"EGL surfaceless: .* \\(", "EGL surfaceless: <any> ("},
      {"egl: .*; egl-device: .*; osmesa: .* \\(", "egl: <any>; egl-device: <any>; osmesa: <any> ("}};
  for (const auto& [words, replacement] : rules) message = std::regex_replace(message, std::regex(words), replacement);
  return message;
}

void write(const GoldenMessages& messages) {
  std::ofstream out(golden_file());
  for (const auto& [row, message] : messages) out << row << '\t' << message << '\n';
}

// The rows of the suites of this program.
std::map<std::string, std::set<std::string>> known_rows() {
  std::map<std::string, std::set<std::string>> rows;
  const ::testing::UnitTest& all = *::testing::UnitTest::GetInstance();
  for (int s = 0; s < all.total_test_suite_count(); ++s) {
    const ::testing::TestSuite& suite = *all.GetTestSuite(s);
    const std::string name = suite.name();
    for (int t = 0; t < suite.total_test_count() && name.find('/') != std::string::npos; ++t)
      rows[name.substr(0, name.find('/'))].insert(row_name(name, suite.GetTestInfo(t)->name()));
  }
  return rows;
}

}  // namespace

GoldenMessages read_golden_messages() {
  GoldenMessages messages;
  std::ifstream in(golden_file());
  for (std::string line; std::getline(in, line);) {
    const std::size_t tab = line.find('\t');
    messages[line.substr(0, tab)] = tab == std::string::npos ? "" : line.substr(tab + 1);
  }
  return messages;
}

bool has_golden_words(const std::string& message, const std::string& golden) {
  std::size_t from = 0;
  std::string_view rest = golden;
  for (bool is_first = true; rest.find(any) != std::string_view::npos; is_first = false) {
    const std::string_view part = rest.substr(0, rest.find(any));
    const std::size_t found = message.find(part, from);
    if (found == std::string::npos || (is_first && found != 0)) return false;
    from = found + part.size();
    rest.remove_prefix(part.size() + any.size());
  }
  if (rest.size() == golden.size()) return message == golden;
  return message.size() >= from + rest.size() && message.ends_with(rest);
}

void expect_golden_message(const std::string& message) {
  GoldenMessages messages = read_golden_messages();
  const std::string row = running_row();
  const auto known = messages.find(row);
  if (known != messages.end() && has_golden_words(message, known->second)) return;
  if (std::getenv("FOOTPRINT_UPDATE_MESSAGES") != nullptr) {
    messages[row] = generalised(message);
    write(messages);
    return;
  }
  ADD_FAILURE() << "the message of " << row << " has other words than in messages.golden:\n  " << message << "\nnot\n  "
                << (known == messages.end() ? "(none)" : known->second)
                << "\nIf they are meant, run the test again with FOOTPRINT_UPDATE_MESSAGES=1";
}

TEST(GoldenMessages, HaveARowEach) {
  const auto rows = known_rows();
  for (const auto& [row, message] : read_golden_messages()) {
    const auto suite = rows.find(row.substr(0, row.find('/')));
    if (suite == rows.end()) continue;
    EXPECT_TRUE(suite->second.contains(row)) << "no such row: remove it from messages.golden";
  }
}

// A row without a message in the file fails.
TEST(GoldenMessages, AreMissed) {
  if (std::getenv("FOOTPRINT_UPDATE_MESSAGES") != nullptr) GTEST_SKIP() << "it would be written";
  EXPECT_NONFATAL_FAILURE(expect_golden_message("footprint: --size: is wrong"), "other words than in messages.golden");
}

TEST(GoldenMessages, MayHaveWordsOfTheMachine) {
  EXPECT_TRUE(has_golden_words("a: b", "a: b"));
  EXPECT_FALSE(has_golden_words("a: bc", "a: b"));
  EXPECT_TRUE(has_golden_words("a: 12 of 3 b", "a: <any> of <any> b"));
  EXPECT_TRUE(has_golden_words("a: 12", "a: <any>"));
  EXPECT_FALSE(has_golden_words("x a: 12", "a: <any>"));
  EXPECT_FALSE(has_golden_words("a: 12 c", "a: <any> b"));
  EXPECT_FALSE(has_golden_words("ab", "ab<any>b"));
}

}  // namespace footprint::test
