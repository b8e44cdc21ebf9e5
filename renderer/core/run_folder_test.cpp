// A folder's losses, and a document that takes the place of images on a full disk.
#include "renderer/core/run_folder.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <new>

#include "renderer/core/files.hpp"
#include "tests/support/fresh_folder.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;

TEST(RunFolder, KeepsWhatFailsAsALossAndGoesOn) {
  const RunFolder folder(test::fresh_folder());
  bool went_on = false;
  folder.attempt("a.png", [] { throw Error(ErrorKind::machine, "a.png", "cannot be written"); });
  folder.below("inner").attempt("b.png", [] { throw std::bad_alloc(); });
  folder.attempt("c.png", [&] { went_on = true; });
  EXPECT_TRUE(went_on);
  ASSERT_EQ(folder.losses().size(), 2U);
  EXPECT_EQ(folder.losses()[1].place(), "b.png");
  EXPECT_EQ(folder.losses_text(), "2 files were not written, the first: a.png: cannot be written");
}

TEST(RunFolder, LetsAnInterruptPass) {
  const RunFolder folder(test::fresh_folder());
  EXPECT_THROW(folder.attempt("a", [] { throw Error(ErrorKind::interrupted, "", "stopped"); }), Error);
  EXPECT_TRUE(folder.losses().empty());
}

// A folder of the document's name is in the way, which no removed image changes.
TEST(RunFolder, FailsWithoutItsDocument) {
  const RunFolder folder(test::fresh_folder());
  fs::create_directories(folder / "results.json");
  fs::create_directories(folder / "images");
  EXPECT_THROW(folder.write_document("results.json", "{}"), Error);
}

TEST(RunFolder, WritesNoTextThatCannotBeMade) {
  const RunFolder folder(test::fresh_folder());
  folder.write_text("table.md", []() -> std::string { throw Error(ErrorKind::usage, "table", "has no rows"); });
  EXPECT_FALSE(fs::exists(folder / "table.md"));
  EXPECT_EQ(folder.losses_text(), "not written: table: has no rows");
  const RunFolder pictures(folder.path());
  const auto not_finite = [] { throw Error(ErrorKind::check, "a.exr", "1 of 4 pixels are not finite"); };
  pictures.attempt("a.exr", not_finite);
  EXPECT_EQ(pictures.losses_text(), "a.exr: 1 of 4 pixels are not finite");
  pictures.attempt("b.exr", not_finite);
  EXPECT_EQ(pictures.losses_text(), "2 files are not finite, the first: a.exr: 1 of 4 pixels are not finite");
  pictures.attempt("c.exr", [] { throw Error(ErrorKind::machine, "c.exr", "cannot be written"); });
  EXPECT_EQ(pictures.faults_text(), "were not written or are not finite");
}

}  // namespace
}  // namespace footprint
