// The lobe of facets whose normals spread about their mean: a base lobe convolved with a von Mises-Fisher distribution.
#pragma once

#include "renderer/lobes/lobe.hpp"

namespace footprint {

/// The effective lobe of facets with the lobe `base` whose normals follow a von Mises-Fisher distribution of
/// concentration `kappa`, above 0.
/// `blinn_phong`: s' = kappa s / (kappa + s) for exponents s (Xu et al. 2017, equations 11 to 13).
/// `vmf`: the same sum of variances, 1 / kappa' = 1 / kappa_base + 1 / kappa.
/// `beckmann`, `ggx`: the alpha whose density at the axis is that of the convolution, to 1% for kappa from 5 on and
/// alpha up to 0.7 (`beckmann` above 0.4: 3.5%). It is at least that of `base`, and for `ggx` at most 1.
[[nodiscard]] Lobe convolved(const Lobe& base, double kappa);

}  // namespace footprint
