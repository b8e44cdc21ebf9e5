// Finished work on disk: what was kept comes back with its files, what is damaged does not, and a maker's is its own.
#include "experiments/kept/kept_work.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <utility>

#include "renderer/core/error.hpp"
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

// The call fails as a user's mistake, in these words.
template <class Call>
void expect_error(Call call, ErrorKind kind, const std::vector<std::string>& words) {
  try {
    call();
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind);
    for (const std::string& word : words) EXPECT_TRUE(test::says(error.what(), word));
  }
}

class KeptWorkTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = test::fresh_folder();
    write(run() / "images/a.png", "an image");
    write(run() / "images/same.png", "an image");
    work_.emplace(folder_ / "kept", "me");
    key_ = work_->key("record", std::vector<std::string>{"one", "two"});
    work_->keep(key_, figures, run(), {"images/a.png", "images/same.png"});
  }

  [[nodiscard]] fs::path run() const { return folder_ / "run"; }
  [[nodiscard]] fs::path later() const { return folder_ / "later"; }
  [[nodiscard]] fs::path item() const { return item_of(key_); }
  [[nodiscard]] fs::path item_of(const std::string& key) const {
    return folder_ / "kept" / key.substr(key.find('-') + 1, 2) / (key + ".done");
  }
  [[nodiscard]] fs::path only_file() const {
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / "kept/files")) {
      if (entry.is_regular_file()) return entry.path();
    }
    return {};
  }
  [[nodiscard]] std::optional<std::vector<double>> found() const {
    return work_->find<std::vector<double>>(key_, later());
  }

  fs::path folder_;
  std::optional<KeptWork> work_;
  std::string key_;
};

TEST_F(KeptWorkTest, ComesBackWithItsFiles) {
  EXPECT_EQ(found(), figures);
  EXPECT_EQ(text_of(later() / "images/a.png"), "an image");
  EXPECT_EQ(text_of(later() / "images/same.png"), "an image");
  EXPECT_EQ(work_->found(), 0U) << "it was kept by the same run";
  const KeptWork another(folder_ / "kept", work_->maker());
  for (int i = 0; i < 2; ++i) EXPECT_TRUE(another.find<std::vector<double>>(key_, later()));
  EXPECT_EQ(another.found(), 1U);
  EXPECT_THAT(work_->used(), ::testing::ElementsAre(key_));
  EXPECT_TRUE(work_->has_whole(key_));
}

TEST_F(KeptWorkTest, EqualFilesAreKeptOnce) {
  EXPECT_EQ(std::distance(fs::directory_iterator(only_file().parent_path()), {}), 1);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "kept/files"), {}), 1);
}

TEST_F(KeptWorkTest, ARunThatWritesItsFileAgainLeavesTheKeptOne) {
  write(run() / "images/a.png", "another");
  EXPECT_EQ(found(), figures);
  EXPECT_EQ(text_of(later() / "images/a.png"), "an image");
}

TEST_F(KeptWorkTest, KeysTellApart) {
  const auto key = [&](const std::vector<std::string>& fields) { return work_->key("record", fields); };
  EXPECT_NE(key({"one", "two"}), key({"onet", "wo"}));
  EXPECT_NE(key({"one", "two"}), work_->key("truth", std::vector<std::string>{"one", "two"}));
  EXPECT_NE(key({"one"}), KeptWork(folder_ / "kept", "another").key("record", std::vector<std::string>{"one"}));
}

TEST_F(KeptWorkTest, WhatIsNotThereIsNotFound) {
  EXPECT_FALSE(work_->find<std::vector<double>>(work_->key("record", std::vector<std::string>{}), later()));
  EXPECT_FALSE(work_->find<std::string>(key_, later())) << "it is of another type";
}

TEST_F(KeptWorkTest, ADamagedItemIsNotFound) {
  std::string bytes = text_of(item());
  bytes[bytes.size() / 2] ^= 1;
  write(item(), bytes);
  EXPECT_FALSE(found());
  EXPECT_FALSE(work_->has_whole(key_));
  write(item(), text_of(item()).substr(0, 20));
  EXPECT_FALSE(found());
}

TEST_F(KeptWorkTest, AnItemUnderAnotherKeyIsNotFound) {
  const std::string other = work_->key("record", std::vector<std::string>{"other"});
  fs::create_directories(item_of(other).parent_path());
  fs::copy_file(item(), item_of(other));
  EXPECT_FALSE(work_->find<std::vector<double>>(other, later()));
}

TEST_F(KeptWorkTest, ADamagedOrMissingFileIsNotFound) {
  write(only_file(), "a pictura");
  EXPECT_FALSE(found());
  fs::remove(only_file());
  EXPECT_FALSE(found());
  work_->keep(key_, figures, run(), {"images/a.png"});
  EXPECT_EQ(found(), figures) << "it can be kept again";
}

TEST_F(KeptWorkTest, AnotherFolderTakesItOverWhole) {
  const KeptWork other(folder_ / "other", "me");
  other.take(key_, *work_);
  EXPECT_EQ(other.find<std::vector<double>>(key_, later()), figures);
  EXPECT_EQ(text_of(later() / "images/a.png"), "an image");
}

TEST_F(KeptWorkTest, NothingDamagedIsTakenOver) {
  const KeptWork other(folder_ / "other", "me");
  write(only_file(), "a pictura");
  expect_error([&] { other.take(key_, *work_); }, ErrorKind::usage, {only_file().string(), "missing or damaged"});
  write(item(), "damaged");
  expect_error([&] { other.take(key_, *work_); }, ErrorKind::usage, {item().string(), "missing or damaged"});
  EXPECT_THAT(other.keys(), ::testing::IsEmpty());
}

// An item made by someone else's program: whole, under its key, with a file to be put where it should not be.
TEST_F(KeptWorkTest, NoFileIsPutOutsideOfTheRunsFolder) {
  const std::string hash = only_file().filename().string();
  for (const auto& [name, named_hash] :
       std::vector<std::pair<std::string, std::string>>{{"images/a.png", hash},
                                                        {"../outside.png", hash},
                                                        {"images/../../outside.png", hash},
                                                        {(folder_ / "outside.png").string(), hash},
                                                        {"", hash},
                                                        {"images/", hash},
                                                        {"images/a.png", "../" + hash.substr(0, 2) + "/" + hash}}) {
    const std::vector<std::uint8_t> bytes = sealed("footprint-kept/1", [&](SealedWriter& writer) {
      writer.add_text(key_);
      writer.add<std::uint64_t>(1);
      writer.add_text(name);
      writer.add_text(named_hash);
      writer.add_block(packed(figures, key_));
    });
    write(item(), std::string(bytes.begin(), bytes.end()));
    EXPECT_EQ(found().has_value(), name == "images/a.png" && named_hash == hash) << name;
    EXPECT_FALSE(fs::exists(folder_ / "outside.png"));
  }
}

TEST_F(KeptWorkTest, AKeyIsNoPath) {
  const KeptWork other(folder_ / "other", "me");
  for (const std::string key : {"", "../../record-1", "record/../record-1", "/tmp/record-1", "record-1\n"}) {
    EXPECT_FALSE(work_->has_whole(key)) << key;
    expect_error([&] { other.take(key, *work_); }, ErrorKind::usage, {"missing or damaged"});
  }
  EXPECT_FALSE(fs::exists(folder_ / "other"));
}

TEST_F(KeptWorkTest, WhatIsCompleteTakesNothingMore) {
  expect_error([&] { KeptWork(folder_ / "kept", "me", true).require_more_allowed("a scene"); }, ErrorKind::usage,
               {"lacks finished work of a scene"});
  EXPECT_NO_THROW(work_->require_more_allowed("a scene"));
}

TEST_F(KeptWorkTest, ClearingLeavesNothing) {
  work_->clear();
  EXPECT_FALSE(fs::exists(folder_ / "kept"));
  EXPECT_FALSE(found());
}

TEST_F(KeptWorkTest, AFileInPlaceOfTheFolderIsRefused) {
  write(folder_ / "taken", "text");
  expect_error([&] { KeptWork(folder_ / "taken", "me"); }, ErrorKind::usage, {"taken", "is not a folder"});
}

}  // namespace
}  // namespace footprint
