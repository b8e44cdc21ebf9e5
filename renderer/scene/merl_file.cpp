// Holds sizes and length against those of the database, then scales its three planes of doubles by the units of each.
#include "renderer/scene/merl_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "renderer/core/error.hpp"
#include "renderer/core/file_bytes.hpp"

namespace footprint {
namespace {

constexpr std::array<std::int32_t, 3> sizes{TabulatedBrdf::theta_h_cells, TabulatedBrdf::theta_d_cells,
                                            TabulatedBrdf::phi_d_cells};
constexpr std::array<double, 3> units{1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0};
constexpr std::size_t header_bytes = sizeof(sizes);
constexpr std::size_t file_bytes = header_bytes + 3 * TabulatedBrdf::cell_count * sizeof(double);

}  // namespace

TabulatedBrdf read_merl(const std::filesystem::path& file) {
  const std::vector<std::uint8_t> bytes = read_file_bytes(file, 2 * file_bytes);
  const auto refuse = [&](const std::string& message) {
    return Error(ErrorKind::usage, file.string(), message, "give a .binary file of the MERL database");
  };
  std::array<std::int32_t, 3> found{};
  if (bytes.size() < header_bytes) throw refuse(fmt::format("has {} bytes, not even its three sizes", bytes.size()));
  std::memcpy(found.data(), bytes.data(), header_bytes);
  if (found != sizes) {
    throw refuse(fmt::format("has {} x {} x {} cells, not 90 x 90 x 180", found[0], found[1], found[2]));
  }
  if (bytes.size() != file_bytes) throw refuse(fmt::format("has {} bytes, not {}", bytes.size(), file_bytes));
  TabulatedBrdf brdf;
  brdf.values.resize(TabulatedBrdf::cell_count);
  for (std::size_t c = 0; c < 3; ++c) {
    const std::uint8_t* const plane = bytes.data() + header_bytes + c * TabulatedBrdf::cell_count * sizeof(double);
    for (std::size_t i = 0; i < TabulatedBrdf::cell_count; ++i) {
      double value = 0.0;
      std::memcpy(&value, plane + i * sizeof(double), sizeof(double));
      if (!std::isfinite(value)) throw refuse(fmt::format("value {} is not finite", c * TabulatedBrdf::cell_count + i));
      brdf.values[i][static_cast<int>(c)] = static_cast<float>(std::max(value, 0.0) * units.at(c));
    }
  }
  return brdf;
}

}  // namespace footprint
