// The pictures of the NDF inspector: densities over the x-y disc in false colour, all on one scale.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "results/report/ndf_report.hpp"

namespace footprint {

/// A density at the pixels of a disc (`disc_directions`), with its caption.
struct NdfPicture {
  std::string stem;     ///< of its files
  std::string caption;  ///< ASCII
  std::vector<float> densities;
};

/// Writes images/STEM.exr and .png for the exact NDF and every method, images/STEM_difference.png for every method, and
/// ndf.png, all of them side by side over the scale, below `folder`; fills in the paths and the scale of `results`,
/// whose records are those of `methods`. The scale runs from 0 to the exact NDF's largest density.
void write_ndf_pictures(const std::filesystem::path& folder, int size, const NdfPicture& exact,
                        std::span<const NdfPicture> methods, NdfResults& results);

}  // namespace footprint
