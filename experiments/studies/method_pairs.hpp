// Every two methods of a distance pixel by pixel: where which of them is closer to the reference beyond noise.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "experiments/studies/reference_view.hpp"

namespace footprint {

/// One entry for every two methods of one distance, with its image in FOLDER/images; empty if the reference's noise is
/// unknown, or no pixel is interior.
/// records, images, names: of each method; a failed method has no image. `names` are parts of file names.
[[nodiscard]] std::vector<MethodPair> compare_pairs(const std::filesystem::path& folder,
                                                    std::span<const Record> records, std::span<const Image> images,
                                                    std::span<const std::string> names, const ReferenceView& target,
                                                    float exposure);

}  // namespace footprint
