// The words of every error message that rows of the command line end with: messages.golden, a line per row. Rows say
// the kind of an error and its place; a change of words changes that file alone.
#pragma once

#include <map>
#include <string>

namespace footprint::test {

/// Golden messages by row, "SUITE/ROW". `<any>` in a message stands for a text that depends on the machine.
using GoldenMessages = std::map<std::string, std::string>;

[[nodiscard]] GoldenMessages read_golden_messages();

/// Whether a message has the words of a golden one.
[[nodiscard]] bool has_golden_words(const std::string& message, const std::string& golden);

/// Checks the message of the running row. With FOOTPRINT_UPDATE_MESSAGES=1 in the environment it is written into the
/// file instead, unless its words are there already.
void expect_golden_message(const std::string& message);

}  // namespace footprint::test
