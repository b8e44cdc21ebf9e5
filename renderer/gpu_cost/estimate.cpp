// Reads ACO's printed code line by line: `v4: %182 = image_sample_l %101, ...`, in blocks with their kind. Costs are a
// roofline: arithmetic, texture units and memory each take their time, and the slowest one counts.
#include "renderer/gpu_cost/estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <ranges>
#include <string_view>
#include <vector>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

constexpr std::array<std::string_view, 13> quarter_rate{
    "v_rcp_",     "v_rsq_",     "v_sqrt_",    "v_exp_",     "v_log_",    "v_sin_",   "v_cos_",
    "v_mul_lo_u", "v_mul_lo_i", "v_mul_hi_u", "v_mul_hi_i", "v_mad_u64", "v_mad_i64"};
constexpr std::array<std::string_view, 8> memory_access{"s_load",   "s_buffer", "buffer_", "global_",
                                                        "scratch_", "flat_",    "ds_",     "exp"};

template <std::size_t N>
bool starts_with_any(std::string_view name, const std::array<std::string_view, N>& prefixes) {
  return std::ranges::any_of(prefixes, [&](std::string_view prefix) { return name.starts_with(prefix); });
}

// One instruction: the values that it defines, its name, and its operands.
struct Line {
  std::string_view defined, name, operands;
};

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  return first == std::string_view::npos ? std::string_view{} : text.substr(first);
}

Line parsed(std::string_view text) {
  Line line;
  if (const auto equals = text.find(" = "); equals != std::string_view::npos) {
    line.defined = trimmed(text.substr(0, equals));
    text = text.substr(equals + 3);
  }
  text = trimmed(text);
  const auto space = text.find(' ');
  line.name = text.substr(0, space);
  if (space != std::string_view::npos) line.operands = text.substr(space + 1);
  return line;
}

// The first name of a value, `%12`, without register and flags; empty without one.
std::string value_in(std::string_view text) {
  const auto begin = text.find('%');
  if (begin == std::string_view::npos) return {};
  const auto end = text.find_first_not_of("0123456789", begin + 1);
  return std::string(text.substr(begin, end == std::string_view::npos ? end : end - begin));
}

// The offset at which an instruction loads: its second operand.
std::optional<int> offset_in(std::string_view operands) {
  const auto comma = operands.find(',');
  if (comma == std::string_view::npos) return {};
  const std::string text(trimmed(operands.substr(comma + 1)));
  if (text.empty() || text.front() < '0' || text.front() > '9') return {};
  return static_cast<int>(std::stol(text, nullptr, 0));
}

struct Counter {
  int descriptor_bytes;
  int depth = 0, lines = 0;
  ShaderWork work{};
  std::map<std::string, int> offsets{};  // of descriptors in their set, by the value that they were loaded to

  void read(std::string_view text) {
    if (text.starts_with("/*")) return enter_block(text);
    if (!text.starts_with("\t")) return;
    const Line line = parsed(text);
    Instructions& counts = depth > 0 ? work.looped : work.straight;
    if (line.name.starts_with("image_")) return count_texture(line, counts);
    if (line.name == "s_load_dwordx8" || line.name == "s_load_dwordx16") note_descriptor(line);
    if (starts_with_any(line.name, memory_access)) {
      ++counts.memory;
    } else if (line.name.starts_with("v_")) {
      ++(starts_with_any(line.name, quarter_rate) ? counts.quarter : counts.full);
    } else if (line.name.starts_with("s_") || line.name.starts_with("p_cbranch")) {
      ++counts.scalar;
    }
    ++lines;
  }

  // A loop is the blocks from its header to before its exit.
  void enter_block(std::string_view kinds) {
    if (kinds.find(" loop-exit,") != std::string_view::npos) depth = std::max(depth - 1, 0);
    if (kinds.find(" loop-header,") != std::string_view::npos) ++depth;
  }

  void note_descriptor(const Line& line) {
    if (const std::optional<int> offset = offset_in(line.operands)) offsets[value_in(line.defined)] = *offset;
  }

  void count_texture(const Line& line, Instructions& counts) {
    const auto found = offsets.find(value_in(line.operands));
    TextureReads& reads = counts.textures[found == offsets.end() ? unknown_binding : found->second / descriptor_bytes];
    if (line.name.starts_with("image_gather4")) {
      ++reads.gathers;
    } else if (line.name.starts_with("image_sample")) {
      ++reads.samples;
    } else if (line.name.starts_with("image_load")) {
      ++reads.loads;
    }
  }
};

Counter counted(const std::string& code, int descriptor_bytes) {
  Counter counter{.descriptor_bytes = descriptor_bytes};
  for (const auto line : std::views::split(code, '\n')) counter.read(std::string_view(line.begin(), line.end()));
  if (counter.lines == 0)
    throw Error(ErrorKind::machine, "ACO's code", "has no instruction",
                "this version of Mesa prints its code in another form; report the version");
  return counter;
}

constexpr double pixels_of_a_wave = 64;
constexpr double largest_cached_table = 65536;  // bytes; smaller textures stay in the caches
// A sample of the level that fits the pixel moves by one texel from pixel to pixel, and by a quarter on the next level.
constexpr double new_texels_of_a_sample = 1.25;

double rate_of(const Generation& generation, int bits) {
  return bits <= 32 ? 1.0 : bits <= 64 ? generation.rate_64 : generation.rate_128;
}

// Clocks of a SIMD for a wave. A quarter-rate unit of its own needs the SIMD only to start.
double alu_clocks(const Generation& generation, const Instructions& work) {
  const double apart = generation.has_transcendental_unit ? work.quarter * generation.full_clocks : 0.0;
  const double quarter = work.quarter * generation.quarter_clocks;
  const double vector = work.full * generation.full_clocks + (generation.has_transcendental_unit ? apart : quarter);
  return std::max({vector, quarter, work.scalar * generation.scalar_clocks});
}

// Texels from memory per sample: the mean over the pixels if the map's finest level is read whatever the footprint.
double new_texels(const ReadTexture& texture, double line_bytes, std::span<const float> finest_areas) {
  if (texture.finest_texels == 0 || finest_areas.empty()) return new_texels_of_a_sample;
  double sum = 0;
  for (const float area : finest_areas) {
    const double texels = minified_sample_texels(area * texture.finest_texels, texture.bits / 8.0, line_bytes);
    sum += std::max(new_texels_of_a_sample, texels);
  }
  return sum / static_cast<double>(finest_areas.size());
}

// The lookups of shaders; a gather counts once for each of its reads.
void add_texture(GpuCost& estimate, const Chip& chip, const TextureReads& reads, const ReadTexture& texture,
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

}  // namespace

void Instructions::add(const Instructions& other, double factor) {
  full += factor * other.full;
  quarter += factor * other.quarter;
  scalar += factor * other.scalar;
  memory += factor * other.memory;
  for (const auto& [binding, reads] : other.textures) {
    TextureReads& own = textures[binding];
    own.samples += factor * reads.samples;
    own.gathers += factor * reads.gathers;
    own.loads += factor * reads.loads;
  }
}

double Instructions::texture_reads() const {
  double sum = 0;
  for (const auto& [binding, reads] : textures) sum += reads.total();
  return sum;
}

ShaderWork shader_work(const std::string& code, int descriptor_bytes) { return counted(code, descriptor_bytes).work; }

int descriptor_bytes(const std::string& code) {
  const Counter counter = counted(code, 1);
  std::vector<int> offsets;
  for (const auto& [value, offset] : counter.offsets) offsets.push_back(offset);
  std::ranges::sort(offsets);
  if (offsets.size() != 2 || offsets[0] != 0 || offsets[1] <= 0)
    throw Error(ErrorKind::machine, "ACO's code", "does not load the descriptors of two textures",
                "this version of Mesa prints its code in another form; report the version");
  return offsets[1];
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
                 const std::map<int, ReadTexture>& textures, double written_bytes,
                 std::span<const float> finest_areas) {
  GpuCost estimate;
  estimate.gpu = chip.name;
  const Instructions work = frame_work(works, lookups, estimate.loop_rounds);
  if (work.full < 0 || work.texture_reads() < 0) {
    estimate.failure = "the compiler drops work from a program with further rounds; report the version of Mesa";
    return estimate;
  }
  estimate.alu_clocks = alu_clocks(*chip.generation, work) / pixels_of_a_wave;
  estimate.arithmetic_ns = estimate.alu_clocks / (chip.compute_units * chip.generation->simds * chip.ghz);
  for (const auto& [binding, reads] : work.textures) {
    const auto found = textures.find(binding);
    add_texture(estimate, chip, reads, found == textures.end() ? ReadTexture{} : found->second, finest_areas);
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
