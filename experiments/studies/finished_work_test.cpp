// Finished work on disk: a part comes back with its files, and a damaged one counts as unfinished.
#include "experiments/studies/finished_work.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "tests/support/fresh_folder.hpp"
#include "tests/support/says.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;

const std::vector<double> figures{1.0, -0.0, 1e300};

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  fs::remove(file);
  std::ofstream(file) << text;
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

template <class Call>
void expect_usage_error(Call call, const std::vector<std::string>& words) {
  try {
    call();
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    for (const std::string& word : words) EXPECT_TRUE(test::says(error.what(), word));
  }
}

class FinishedWorkTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = test::fresh_folder();
    write(run() / "images/a.png", "an image");
    work_.emplace(folder_ / "kept", "me");
    work_->store(key, figures, run(), {"images/a.png"});
  }

  [[nodiscard]] fs::path run() const { return folder_ / "run"; }
  [[nodiscard]] fs::path later() const { return folder_ / "later"; }
  [[nodiscard]] fs::path part() const { return folder_ / "kept/0123/distance_1.json"; }
  [[nodiscard]] fs::path image() const { return folder_ / "kept/0123/images/a.png"; }
  [[nodiscard]] std::optional<std::vector<double>> found() const {
    return work_->find<std::vector<double>>(key, later());
  }

  static constexpr const char* key = "0123/distance_1";
  fs::path folder_;
  std::optional<FinishedWork> work_;
};

TEST_F(FinishedWorkTest, ComesBackWithItsFiles) {
  EXPECT_EQ(found(), figures);
  EXPECT_EQ(text_of(later() / "images/a.png"), "an image");
  EXPECT_EQ(work_->reused(), 0U) << "the same run stored it";
  const FinishedWork another(folder_ / "kept", "me");
  for (int i = 0; i < 2; ++i) EXPECT_TRUE(another.find<std::vector<double>>(key, later()));
  EXPECT_EQ(another.reused(), 1U);
  EXPECT_THAT(work_->used(), ::testing::ElementsAre(key));
}

TEST_F(FinishedWorkTest, ARunThatWritesItsFileAgainLeavesTheStoredOne) {
  write(run() / "images/a.png", "another");
  EXPECT_EQ(found(), figures);
  EXPECT_EQ(text_of(later() / "images/a.png"), "an image");
}

// The parts of one run: made once, and every time where nothing is kept.
TEST_F(FinishedWorkTest, KeptPartsAreMadeOnce) {
  int made = 0;
  const auto make = [&] { return std::vector<double>{static_cast<double>(++made)}; };
  const KeptParts kept(&*work_, "0123", run()), others(&*work_, "4567", run()), none(nullptr, "", run());
  EXPECT_EQ(kept.kept("distance_1", make), figures);
  EXPECT_EQ(others.kept("distance_1", make), std::vector{1.0});
  EXPECT_EQ(others.kept("distance_1", make), std::vector{1.0});
  EXPECT_EQ(none.kept("distance_1", make), std::vector{2.0});
  EXPECT_EQ(none.kept("distance_1", make), std::vector{3.0});
}

TEST_F(FinishedWorkTest, AMissingPartIsUnfinished) {
  EXPECT_FALSE(work_->find<std::vector<double>>("0123/distance_2", later()));
  EXPECT_FALSE(work_->find<std::string>(key, later())) << "of another type";
}

TEST_F(FinishedWorkTest, ADamagedPartIsUnfinished) {
  const std::string text = text_of(part());
  for (std::size_t i = 0; i < text.size(); i += 7) {
    std::string damaged = text;
    damaged[i] ^= 1;
    write(part(), damaged);
    EXPECT_FALSE(found()) << i;
  }
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{20}, text.size() - 1}) {
    write(part(), text.substr(0, size));
    EXPECT_FALSE(found()) << size;
  }
}

TEST_F(FinishedWorkTest, APartUnderAnotherKeyIsUnfinished) {
  fs::copy_file(part(), folder_ / "kept/0123/distance_2.json");
  EXPECT_FALSE(work_->find<std::vector<double>>("0123/distance_2", later()));
}

TEST_F(FinishedWorkTest, APartWithADamagedOrMissingFileIsUnfinished) {
  write(image(), "a pictura");
  EXPECT_FALSE(found());
  fs::remove(image());
  EXPECT_FALSE(found());
  work_->store(key, figures, run(), {"images/a.png"});
  EXPECT_EQ(found(), figures) << "it can be stored again";
}

TEST_F(FinishedWorkTest, AnotherFolderTakesAWholePart) {
  const FinishedWork other(folder_ / "other", "me");
  other.take(key, *work_);
  EXPECT_EQ(other.find<std::vector<double>>(key, later()), figures);
  EXPECT_EQ(text_of(later() / "images/a.png"), "an image");
}

TEST_F(FinishedWorkTest, ADamagedPartIsNotTaken) {
  const FinishedWork other(folder_ / "other", "me");
  write(image(), "a pictura");
  expect_usage_error([&] { other.take(key, *work_); }, {part().string(), "missing or damaged"});
}

TEST_F(FinishedWorkTest, NamesStayBelowTheFolder) {
  write(folder_ / "outside.json", text_of(part()));
  for (const char* outside : {"../outside", "/etc/passwd", "0123/../../outside"})
    EXPECT_FALSE(work_->find<std::vector<double>>(outside, later())) << outside;
}

TEST_F(FinishedWorkTest, CompleteWorkAllowsNoMore) {
  EXPECT_NO_THROW(work_->require_more_allowed("scene"));
  const FinishedWork complete(folder_ / "kept", "me", true);
  expect_usage_error([&] { complete.require_more_allowed("scene"); }, {"lacks finished work of scene"});
}

TEST_F(FinishedWorkTest, ClearedWorkIsGone) {
  work_->clear();
  EXPECT_FALSE(found());
  EXPECT_FALSE(fs::exists(folder_ / "kept"));
}

TEST_F(FinishedWorkTest, AFileInPlaceOfTheFolderIsRefused) {
  write(folder_ / "file", "text");
  expect_usage_error([&] { FinishedWork(folder_ / "file", "me"); }, {"is not a folder"});
}

}  // namespace
}  // namespace footprint
