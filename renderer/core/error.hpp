// The exception type of Footprint: message, place, and a hint for the fix.
#pragma once

#include <stdexcept>
#include <string>

namespace footprint {

/// The kind of an error, and the exit code of the program (docs/reference/command-line.md).
enum class ErrorKind {
  check = 1,          ///< a checked threshold or claim failed
  usage = 2,          ///< the command line, a config or an input file is wrong
  machine = 3,        ///< the machine lacks GL, memory or disk space
  interrupted = 130,  ///< the user stopped the program (128 + SIGINT)
};

/// Every error that a user can see. `what()` reads "PLACE: MESSAGE (HINT)"; PLACE and HINT may be empty.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, std::string place, std::string message, std::string hint = {});

  [[nodiscard]] ErrorKind kind() const noexcept { return kind_; }
  [[nodiscard]] const std::string& place() const noexcept { return place_; }
  [[nodiscard]] const std::string& message() const noexcept { return message_; }
  [[nodiscard]] const std::string& hint() const noexcept { return hint_; }

  /// Returns the error as seen from further out: `outer` is put before the place ("scene.gltf, material 3").
  [[nodiscard]] Error within(const std::string& outer) const;

 private:
  ErrorKind kind_;
  std::string place_, message_, hint_;
};

}  // namespace footprint
