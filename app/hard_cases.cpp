// `footprint check hard_cases` of a program built without tests: tests/hard_cases/ defines it otherwise.
#include "app/commands.hpp"

#include "renderer/core/error.hpp"

namespace footprint {

void check_hard_cases(const HardCasesRequest& /*request*/) {
  throw Error(ErrorKind::usage, std::string(hard_cases_name), "this program was built without the hard cases",
              "configure with -DFOOTPRINT_TESTS=ON, or use a package");
}

}  // namespace footprint
