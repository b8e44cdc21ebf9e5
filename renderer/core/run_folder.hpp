// The folder that a run fills, in which an illustration that cannot be written costs only itself.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/core/error.hpp"

namespace footprint {

/// A folder and the losses of the run that fills it. Copies, and folders below, share the losses. Not thread-safe.
class RunFolder {
 public:
  /// A folder by itself; not explicit, because a path suffices where nobody asks for losses.
  RunFolder(std::filesystem::path path);  // NOLINT(google-explicit-constructor)

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
  [[nodiscard]] std::filesystem::path operator/(const std::filesystem::path& name) const { return path_ / name; }
  /// A folder inside, with the same losses.
  [[nodiscard]] RunFolder below(const std::filesystem::path& name) const;

  /// Calls `write`. Anything that it throws becomes a loss, except for an interrupt, which passes: an illustration that
  /// is not written, or one that is written although it is not finite (Error of the kind `check`).
  /// what: names the illustration where the exception does not.
  void attempt(std::string_view what, const std::function<void()>& write) const;

  /// Writes the file `name` with the text that `make` returns; a failure of either is a loss.
  void write_text(const std::filesystem::path& name, const std::function<std::string()>& make) const;

  /// Writes the document of a measurement, the file `name`. Where that fails it removes the illustrations in `images/`,
  /// which is a loss, and tries again. Errors (machine): it still cannot be written.
  void write_document(const std::filesystem::path& name, std::string_view content) const;

  /// The errors of files that could not be written or are not finite, in order.
  [[nodiscard]] const std::vector<Error>& losses() const noexcept { return *losses_; }
  /// One line about all losses for a page's notes, with places from the top folder; empty without any.
  [[nodiscard]] std::string losses_text() const;
  /// The fault of the files of all losses: "were not written", "are not finite", or either.
  [[nodiscard]] std::string_view faults_text() const;

 private:
  std::filesystem::path path_, top_;  ///< itself, and the folder that it is below
  std::shared_ptr<std::vector<Error>> losses_;
};

}  // namespace footprint
