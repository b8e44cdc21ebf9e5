// How well lobes stand for what they were fitted to: figures that no picture shows.
#pragma once

#include "methods/iwasaki_sg/material_table.hpp"
#include "renderer/microgeometry/patch.hpp"

namespace footprint::iwasaki_sg {

/// The largest difference, over all angles between the axes, of Eq. 11 and Eq. 14 (Iwasaki 2012, Figure 5); amplitudes
/// of 1, absolute.
[[nodiscard]] double convolution_error(double sharpness1, double sharpness2);

/// The same of the SG that Jakob 2012 convolves to: its mean vector is as long as the product of the two (vMF), its
/// value that of Eq. 11 where the axes meet.
[[nodiscard]] double jakob_convolution_error(double sharpness1, double sharpness2);

/// Root mean square, over the paper's 6x128x128 normals and all pairs of directions, of the difference between
/// gamma~ = gamma (cosines) / a_v and its lobes, each taken as what it holds in a cell; a facet's single normal is as
/// wide as the sharpest lobe, so that both sides have one kernel. The paper prints percentages of this kind and does
/// not say over what; here both sides are shares of the seen area, of which 1 is all, so that the figure is small
/// because most cells of most pairs hold nothing on either side. The patch is taken as of one colour.
[[nodiscard]] double fit_rms(const Patch& patch, const TableSettings& settings);

/// The same difference over the root mean square of gamma~ itself: 0 for a perfect fit, about 1 where lobes are far
/// from the single normals that they stand for.
[[nodiscard]] double relative_fit_rms(const Patch& patch, const TableSettings& settings);

}  // namespace footprint::iwasaki_sg
