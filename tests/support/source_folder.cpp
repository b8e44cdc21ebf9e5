// The one test source that the checkout's path is compiled into: a cache of objects serves every checkout with the
// rest.
#include "tests/support/source_folder.hpp"

namespace footprint::testing {

std::filesystem::path source_folder() { return FOOTPRINT_SOURCE_DIR; }

}  // namespace footprint::testing
