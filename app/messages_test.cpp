// Messages stay one line and valid text for any quotation.
#include "app/messages.hpp"

#include <gtest/gtest.h>

namespace footprint {
namespace {

TEST(PrintableLine, KeepsText) {
  EXPECT_EQ(printable_line("mesh 0 `Übung`: 3 \"x\" \\ y"), "mesh 0 `Übung`: 3 \"x\" \\ y");
}

TEST(PrintableLine, HasNoControlCharacters) {
  EXPECT_EQ(printable_line("a\nb\tc\rd"), "a b c d");
  EXPECT_EQ(printable_line("\x1b[2Jgone\x7f"), " [2Jgone ");
  EXPECT_EQ(printable_line(std::string_view("a\0b", 3)), "a b");
}

TEST(PrintableLine, HasNoBrokenUtf8) {
  EXPECT_EQ(printable_line("caf\xe9!"), "caf\xef\xbf\xbd!");
  EXPECT_EQ(printable_line("cut \xe2\x82"), "cut \xef\xbf\xbd");
}

}  // namespace
}  // namespace footprint
