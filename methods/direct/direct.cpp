// `direct`: the finest level at the pixel's centre, without filtering. Every method must equal its image where there is
// nothing to filter.
#include "renderer/pipeline/base_surface.hpp"

namespace footprint {

const Method& direct_method() {
  static const Method method{.info = {.name = "direct",
                                      .summary = "The finest level of every map at the pixel's centre: no filtering.",
                                      .paper = "",
                                      .options = {},
                                      .honours = map_effects_but({}),
                                      .reads_finest_level = true},
                             .precompute = base_surface().precompute,
                             .shader = base_surface().shader};
  return method;
}

}  // namespace footprint
