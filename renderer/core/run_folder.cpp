// Losses are errors in a list that copies share.
#include "renderer/core/run_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <system_error>
#include <utility>

#include "renderer/core/files.hpp"

namespace footprint {

RunFolder::RunFolder(std::filesystem::path path)
    : path_(std::move(path)), top_(path_), losses_(std::make_shared<std::vector<Error>>()) {}

RunFolder RunFolder::below(const std::filesystem::path& name) const {
  RunFolder inner(*this);
  inner.path_ /= name;
  return inner;
}

void RunFolder::attempt(std::string_view what, const std::function<void()>& write) const {
  try {
    write();
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::interrupted) throw;
    losses_->push_back(error);
  } catch (const std::exception& error) {
    losses_->emplace_back(ErrorKind::machine, std::string(what), error.what());
  }
}

void RunFolder::write_text(const std::filesystem::path& name, const std::function<std::string()>& make) const {
  attempt(name.string(), [&] { write_file_atomically(path_ / name, make()); });
}

void RunFolder::write_document(const std::filesystem::path& name, std::string_view content) const {
  try {
    write_file_atomically(path_ / name, content);
  } catch (const Error& error) {
    std::error_code ignored;
    if (std::filesystem::remove_all(path_ / "images", ignored) == 0) throw;
    write_file_atomically(path_ / name, content);
    losses_->emplace_back(
        ErrorKind::machine, (path_ / "images").string(),
        fmt::format("the images were removed to make room for {}: {}", name.string(), error.message()), error.hint());
  }
}

std::string RunFolder::losses_text() const {
  if (losses_->empty()) return {};
  const Error& first = losses_->front();
  std::string place = first.place();
  if (const std::string top = top_.string() + "/"; place.starts_with(top)) place.erase(0, top.size());
  const bool written = first.kind() == ErrorKind::check;
  if (losses_->size() == 1) return fmt::format("{}{}: {}", written ? "" : "not written: ", place, first.message());
  return fmt::format("{} files {}, the first: {}: {}", losses_->size(), faults_text(), place, first.message());
}

std::string_view RunFolder::faults_text() const {
  const auto broken = static_cast<std::size_t>(
      std::ranges::count_if(*losses_, [](const Error& loss) { return loss.kind() == ErrorKind::check; }));
  if (broken == 0) return "were not written";
  return broken == losses_->size() ? "are not finite" : "were not written or are not finite";
}

}  // namespace footprint
