// The rates of two generations, and the products of each.
#include "renderer/core/gpu_chips.hpp"

#include <array>

#include "renderer/core/names.hpp"

namespace footprint {
namespace {

// GCN: four SIMDs of 16 lanes run a wave's instruction in 4 clocks; a scalar unit serves each in turn. Texels of 64 and
// 128 bits filter at half and a quarter of the rate.
constexpr Generation gcn{.name = "GCN",
                         .simds = 4,
                         .full_clocks = 4,
                         .quarter_clocks = 16,
                         .has_transcendental_unit = false,
                         .scalar_clocks = 4,
                         .filtered_per_clock = 4,
                         .rate_64 = 0.5,
                         .rate_128 = 0.25,
                         .line_bytes = 64};

// RDNA: two SIMDs of 32 lanes run it in 2 clocks, and a unit of 8 lanes beside them those at a quarter of the rate.
// Texels of 64 bits filter at full rate.
constexpr Generation rdna{.name = "RDNA",
                          .simds = 2,
                          .full_clocks = 2,
                          .quarter_clocks = 8,
                          .has_transcendental_unit = true,
                          .scalar_clocks = 1,
                          .filtered_per_clock = 4,
                          .rate_64 = 1.0,
                          .rate_128 = 0.5,
                          .line_bytes = 128};

constexpr std::array<Chip, 8> all_chips{{
    {"PS4", "BONAIRE", &gcn, 18, 0.8, 176},
    {"Xbox One", "BONAIRE", &gcn, 12, 0.853, 68},
    {"RX 480", "POLARIS10", &gcn, 36, 1.266, 256},
    {"RX Vega 64", "VEGA10", &gcn, 64, 1.546, 484},
    {"RX 5700 XT", "NAVI10", &rdna, 40, 1.905, 448},
    {"RX 6800", "NAVI21", &rdna, 60, 2.105, 512},
    {"Steam Deck", "VANGOGH", &rdna, 8, 1.6, 88},
    {"RX 7900 XTX", "GFX1100", &rdna, 96, 2.5, 960},
}};

}  // namespace

std::span<const Chip> chips() { return all_chips; }

std::vector<std::string> chip_names() {
  std::vector<std::string> names;
  for (const Chip& chip : all_chips) names.emplace_back(chip.name);
  return names;
}

std::vector<const Chip*> chips_named(std::string_view place, const std::vector<std::string>& names) {
  std::vector<std::string> known = chip_names();
  for (std::string& name : known) name = lower_case(name);
  std::vector<const Chip*> found;
  for (const std::string& name : names) {
    if (lower_case(name) == "all") {
      for (const Chip& chip : all_chips) found.push_back(&chip);
      continue;
    }
    found.push_back(&all_chips.at(find_word(known, lower_case(name), "GPU", place)));
  }
  return found;
}

}  // namespace footprint
