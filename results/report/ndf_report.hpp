// The results of one run of the NDF inspector, as JSON (docs/ndf.schema.json) and as a table.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace footprint {

inline constexpr std::string_view ndf_schema = "footprint-ndf/1";

/// Paths below the output folder.
struct NdfImages {
  std::string density;     ///< EXR, per solid angle, over the x-y disc
  std::string picture;     ///< PNG of the same in false colour
  std::string difference;  ///< PNG of |method - exact| on the same scale; empty for the exact NDF
};

/// One method's effective NDF next to the exact one. Figures that are not finite could not be measured.
struct NdfRecord {
  std::string method;  ///< as written
  std::map<std::string, std::variant<double, std::string>> options;
  double l2 = 0.0;      ///< relative L2 error over solid angle
  double energy = 0.0;  ///< over the exact NDF's
  double peak = 0.0;    ///< largest density, per steradian
  int lobes = 0;        ///< evaluated per pixel
  NdfImages images;
};

/// The exact NDF of the footprint, `truth` in ndf.json.
struct ExactNdfRecord {
  double energy = 0.0;           ///< its integral over the grid
  double expected_energy = 0.0;  ///< the same from the lobes' own integrals
  double peak = 0.0;
  NdfImages images;
};

struct NdfResults {
  std::string version;   ///< of the program
  std::string source;    ///< SCENE or MAP as given
  std::string kind;      ///< scene or map
  std::string material;  ///< its name
  std::array<int, 2> map_size{1, 1};
  std::string lobe;                   ///< blinn_phong:64; the narrowest where the roughness varies
  bool lobe_varies = false;           ///< over the footprint
  std::array<double, 4> footprint{};  ///< u0, v0, u1, v1
  double texels = 0.0;                ///< the footprint's area in texels of the normal map
  double valid_share = 1.0;           ///< of that area
  std::size_t facets = 0;             ///< different ones among them
  double level = 0.0;                 ///< that an isotropic trilinear fetch takes
  std::string filter;                 ///< the footprint filter
  int resolution = 0;                 ///< rings of directions
  std::size_t directions = 0;         ///< in all
  bool fine_enough = true;            ///< energy and expected_energy agree to `ndf_energy_tolerance`
  double scale = 0.0;                 ///< density at the light end of the false-colour scale
  std::string strip;                  ///< the picture of all
  ExactNdfRecord exact;
  std::vector<NdfRecord> records;
  std::vector<std::string> notes;  ///< what was left out or supplied, one line each
};

/// The grid is too coarse if its integral of the exact NDF differs from the lobes' own by a larger share.
inline constexpr double ndf_energy_tolerance = 0.005;

[[nodiscard]] std::string ndf_json(const NdfResults& results);

/// The page: the densities in the comparator, their differences, and the table.
[[nodiscard]] std::string ndf_page(const NdfResults& results);

/// One row per method, and the exact NDF's.
[[nodiscard]] std::string ndf_table(const NdfResults& results);

}  // namespace footprint
