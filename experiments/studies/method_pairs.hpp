// Every two methods of a distance pixel by pixel: where which of them is closer to the reference beyond noise.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "experiments/studies/error_pictures.hpp"
#include "experiments/studies/truth.hpp"

namespace footprint {

/// One entry for each two of the drafts of one distance, with its picture in FOLDER/images; empty where the reference
/// does not know its noise, or no pixel is interior.
[[nodiscard]] std::vector<MethodPair> compare_pairs(const std::filesystem::path& folder, std::span<const Draft> drafts,
                                                    const Truth& truth, float exposure);

}  // namespace footprint
