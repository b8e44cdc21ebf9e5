// The folder of the repository, for tests that read its scenes and documents.
#pragma once

#include <filesystem>

namespace footprint::testing {

/// The root of the checkout that the tests were built from, absolute.
[[nodiscard]] std::filesystem::path source_folder();

}  // namespace footprint::testing
