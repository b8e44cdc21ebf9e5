// A roofline: arithmetic, texture units and memory each take their time, and the slowest one counts.
#include "renderer/gpu_cost/estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/core/names.hpp"

namespace footprint {
namespace {

constexpr double pixels_of_a_wave = 64;
constexpr double largest_cached_table = 65536;  // bytes; smaller textures stay in the caches
// A sample of the level that fits the pixel moves by one texel from pixel to pixel, and by a quarter on the next level.
constexpr double new_texels_of_a_sample = 1.25;

double rate_of(const Generation& generation, int bits) {
  return bits <= 32 ? 1.0 : bits <= 64 ? generation.rate_64 : generation.rate_128;
}

// Clocks of a SIMD for a wave. A quarter-rate unit of its own needs the SIMD only to start.
double alu_clocks(const Generation& generation, const Instructions& work) {
  const double apart = generation.quarter_apart ? work.quarter * generation.full_clocks : 0.0;
  const double quarter = work.quarter * generation.quarter_clocks;
  const double vector = work.full * generation.full_clocks + (generation.quarter_apart ? apart : quarter);
  return std::max({vector, quarter, work.scalar * generation.scalar_clocks});
}

// Texels from memory per sample: the mean over the pixels if the map's finest level is read whatever the footprint.
double new_texels(const TextureCost& texture, double line_bytes, std::span<const float> finest_areas) {
  if (texture.finest_texels == 0 || finest_areas.empty()) return new_texels_of_a_sample;
  double sum = 0;
  for (const float area : finest_areas) {
    const double texels = minified_sample_texels(area * texture.finest_texels, texture.bits / 8.0, line_bytes);
    sum += std::max(new_texels_of_a_sample, texels);
  }
  return sum / static_cast<double>(finest_areas.size());
}

// The lookups of shaders; a gather counts once for each of its reads.
void add_texture(GpuCost& estimate, const Chip& chip, const TextureReads& reads, const TextureCost& texture,
                 std::span<const float> finest_areas) {
  const double samples = std::max(reads.samples, 0.0), gathers = std::max(reads.gathers, 0.0);
  const double loads = std::max(reads.loads, 0.0);
  const double bytes = texture.bits / 8.0;
  const double levels = texture.trilinear ? 2.0 : 1.0;
  estimate.texture_reads += samples + gathers + loads;
  const auto count = [&](double number, const char* kind) {
    if (number > 0) estimate.reads_by_format[fmt::format("{}-bit {}", texture.bits, kind)] += number;
  };
  count(samples, texture.trilinear ? "trilinear" : "bilinear");
  count(gathers, "gather");
  count(loads, "load");
  estimate.bytes_fetched += bytes * (4.0 * levels * samples + 4.0 * gathers + loads);
  if (texture.bytes > largest_cached_table)
    estimate.bytes_from_memory +=
        bytes * (new_texels(texture, chip.generation->line_bytes, finest_areas) * samples + gathers + loads);
  const double rate = chip.generation->filtered_per_clock * rate_of(*chip.generation, texture.bits);
  estimate.texture_ns += (levels * samples + gathers + loads) / (rate * chip.compute_units * chip.ghz);
}

// GCN: four SIMDs of 16 lanes run a wave's instruction in 4 clocks; a scalar unit serves each in turn. Texels of 64 and
// 128 bits filter at half and a quarter of the rate.
constexpr Generation gcn{.name = "GCN",
                         .simds = 4,
                         .full_clocks = 4,
                         .quarter_clocks = 16,
                         .quarter_apart = false,
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
                          .quarter_apart = true,
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

Instructions frame_work(const std::vector<WeighedWork>& works, double lookups, double& loop_rounds) {
  Instructions straight, looped;
  for (const WeighedWork& one : works) {
    straight.add(one.work.straight, one.weight);
    looped.add(one.work.looped, one.weight);
  }
  loop_rounds = 1.0;
  if (const double reads = looped.texture_reads(); reads > 0)
    loop_rounds = std::max((lookups - straight.texture_reads()) / reads, 0.0);
  straight.add(looped, loop_rounds);
  return straight;
}

GpuCost estimate(const Chip& chip, const std::vector<WeighedWork>& works, double lookups,
                 const std::map<int, TextureCost>& textures, double written_bytes,
                 std::span<const float> finest_areas) {
  GpuCost estimate;
  estimate.gpu = chip.name;
  const Instructions work = frame_work(works, lookups, estimate.loop_rounds);
  estimate.alu_clocks = alu_clocks(*chip.generation, work) / pixels_of_a_wave;
  estimate.arithmetic_ns = estimate.alu_clocks / (chip.compute_units * chip.generation->simds * chip.ghz);
  for (const auto& [binding, reads] : work.textures) {
    const auto found = textures.find(binding);
    add_texture(estimate, chip, reads, found == textures.end() ? TextureCost{} : found->second, finest_areas);
  }
  estimate.bytes_from_memory += written_bytes;
  estimate.bandwidth_ns = estimate.bytes_from_memory / chip.gigabytes_per_second;
  estimate.cost_ns = std::max({estimate.arithmetic_ns, estimate.texture_ns, estimate.bandwidth_ns});
  estimate.bound = estimate.cost_ns == estimate.arithmetic_ns ? "arithmetic"
                   : estimate.cost_ns == estimate.texture_ns  ? "textures"
                                                              : "bandwidth";
  return estimate;
}

// Lines of w x w texels. Close samples share lines and fetch all of them, `texels` texels per sample. Samples further
// apart than w + 1 texels share none: the 2 x 2 texels of each touch 1 + 1/w lines along both axes. w^2 texels are a
// line.
double minified_sample_texels(double texels, double texel_bytes, double line_bytes) {
  const double edge = std::sqrt(line_bytes / texel_bytes) + 1;
  return std::min(texels, edge * edge);
}

double copy_ns(const Chip& chip, double bytes) { return 2.0 * bytes / chip.gigabytes_per_second; }

}  // namespace footprint
