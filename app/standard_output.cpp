// Writes and flushes at once, so that a full disk is an error here.
#include "app/standard_output.hpp"

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "renderer/core/error.hpp"

namespace footprint {

void write_output(std::string_view text) {
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (written && std::fflush(stdout) == 0) return;
  const int reason = errno;
  if (reason == EPIPE) return;
  throw Error(ErrorKind::machine, "standard output", "cannot be written: " + std::generic_category().message(reason),
              "free the disk, or write elsewhere");
}

}  // namespace footprint
