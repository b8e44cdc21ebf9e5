// The accuracy of the fits of lobes, which no image shows.
#pragma once

#include "methods/iwasaki_sg/material_table.hpp"
#include "renderer/microgeometry/patch.hpp"

namespace footprint::iwasaki_sg {

/// The largest absolute difference between Eq. 11 and Eq. 14 over all angles between the axes (Iwasaki 2012, Figure 5),
/// with amplitudes of 1.
[[nodiscard]] double convolution_error(double sharpness1, double sharpness2);

/// The same for the SG that Jakob 2012 convolves to. The length of its mean vector is the product of the two (vMF), and
/// its value is that of Eq. 11 where the axes meet.
[[nodiscard]] double jakob_convolution_error(double sharpness1, double sharpness2);

/// Root mean square differences between gamma~ = gamma (cosines) / a_v and its lobes, over the paper's 6x128x128
/// normals and all pairs of directions. Lobes are integrated over cells. The single normal of a facet is as wide as the
/// sharpest lobe, so that both sides have one kernel. The paper prints percentages of this kind without their domain.
/// Here both sides are shares of the visible area, 1 being all, so `rms` is small because most cells of most pairs are
/// empty.
struct FitErrors {
  double rms;
  double
      relative;  ///< over the root mean square of gamma~: 0 for a perfect fit, about 1 for lobes far from its normals
  double occupied;  ///< over the cells that contain facets alone, as a mean over those cells and all pairs
};

/// Treats the patch as of one colour.
[[nodiscard]] FitErrors fit_errors(const Patch& patch, const TableSettings& settings);

/// The relative error of both sides after a convolution with a lobe of `sharpness` (above 0), over the whole sphere:
/// what a base BRDF of that sharpness shows of the difference. In closed form, by the products of lobes.
[[nodiscard]] double convolved_fit_rms(const Patch& patch, const TableSettings& settings, double sharpness);

}  // namespace footprint::iwasaki_sg
