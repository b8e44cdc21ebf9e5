// Results on standard output, with a full disk told apart from a reader who has seen enough.
#pragma once

#include <string_view>

namespace footprint {

/// Writes the whole text and flushes it. A reader who closed the pipe (`| head`) is no error. Errors (machine): the
/// text cannot be written.
void write_output(std::string_view text);

}  // namespace footprint
