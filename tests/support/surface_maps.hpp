// Normal maps of surfaces, by name.
#pragma once

#include <map>
#include <string>

#include "scenes/surfaces/registry.hpp"

namespace footprint::testing {

/// The normal map of a surface with seed 1 and the parameters given.
[[nodiscard]] inline Image make_map(const std::string& name, int resolution,
                                    const std::map<std::string, std::string>& parameters = {}) {
  const Surface& surface = find_surface(all_surfaces(), name);
  SurfaceSettings settings = surface_settings(surface, parameters);
  settings.resolution = resolution;
  return surface_normals(surface, settings);
}

}  // namespace footprint::testing
