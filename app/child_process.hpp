// A program that this one starts and waits for.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "renderer/core/error.hpp"

namespace footprint {

/// A command to start.
struct ChildCommand {
  std::filesystem::path program;         ///< absolute
  std::vector<std::string> arguments;    ///< with the program's name first
  std::filesystem::path errors;          ///< file for its standard error
  std::filesystem::path folder;          ///< working directory; empty: this program's own
  std::vector<std::string> variables{};  ///< NAME=VALUE, in the place of this program's own
};

/// A child process that does not outlive its owner.
class ChildProcess {
 public:
  /// Starts it. Errors: `failure` if it cannot be started.
  ChildProcess(ChildCommand command, const Error& failure);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ChildProcess(ChildProcess&&) = delete;
  ChildProcess& operator=(ChildProcess&&) = delete;
  ~ChildProcess();

  /// The exit code, or -1 if a signal ended it. Empty while it runs.
  [[nodiscard]] std::optional<int> poll();

  /// Waits for it and returns the exit code. Calls `tick` meanwhile, which may throw.
  [[nodiscard]] int wait(const std::function<void()>& tick);

 private:
  pid_t id_ = 0;
};

}  // namespace footprint
