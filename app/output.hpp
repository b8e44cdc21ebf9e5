// Output folders of subcommands: filled out of sight, moved to their place at the end, with errors that name that
// place.
#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include "renderer/core/error.hpp"
#include "renderer/core/files.hpp"

namespace footprint {

/// An error of a file that is still out of sight, with the place that the file was meant for.
[[nodiscard]] Error at_final_place(const Error& error, const OutputFolder& folder);

/// What `write` makes of the folder (it commits) and where that is. Nothing is left of a folder that was not committed.
template <typename Write>
auto write_whole(const std::filesystem::path& output, Write write) {
  OutputFolder folder(output);
  try {
    auto made = write(folder);
    return std::pair(std::move(made), folder.final_path());
  } catch (const Error& error) {
    throw at_final_place(error, folder);
  }
}

}  // namespace footprint
