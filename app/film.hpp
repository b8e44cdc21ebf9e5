// The frames of an animation as one video, made by ffmpeg.
#pragma once

#include <filesystem>
#include <string>

#include "renderer/core/progress.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// The path of ffmpeg. Errors (machine): it is not in PATH.
[[nodiscard]] std::filesystem::path find_ffmpeg();

/// Writes FOLDER/images/film.mp4, the reference and then all methods side by side, 30 frames per second, and returns
/// its path from the folder. Errors (machine): ffmpeg ends otherwise than well, in its own words; an interrupt through
/// `progress`: ffmpeg is ended.
[[nodiscard]] std::string make_film(const std::filesystem::path& ffmpeg, const Results& animation,
                                    const std::filesystem::path& folder, const Progress& progress);

}  // namespace footprint
