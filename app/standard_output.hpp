// Results on standard output; a full disk is an error, a reader that closed the pipe is not.
#pragma once

#include <string_view>

namespace footprint {

/// Writes the whole text and flushes it. A reader that closed the pipe (`| head`) is not an error. Errors (machine):
/// the text cannot be written.
void write_output(std::string_view text);

}  // namespace footprint
