// Reads ACO's printed code line by line: `v4: %182 = image_sample_l %101, ...`, in blocks with their kind.
#include "renderer/gpu_cost/shader_work.hpp"

#include <algorithm>
#include <array>
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

class Counter {
 public:
  explicit Counter(int descriptor_bytes) : descriptor_bytes_(descriptor_bytes) {}

  void read(std::string_view text) {
    if (text.starts_with("/*")) return enter_block(text);
    if (!text.starts_with("\t")) return;
    const Line line = parsed(text);
    Instructions& counts = depth_ > 0 ? work_.looped : work_.straight;
    if (line.name.starts_with("image_")) return count_texture(line, counts);
    if (line.name == "s_load_dwordx8" || line.name == "s_load_dwordx16") note_descriptor(line);
    if (starts_with_any(line.name, memory_access)) {
      ++counts.memory;
    } else if (line.name.starts_with("v_")) {
      ++(starts_with_any(line.name, quarter_rate) ? counts.quarter : counts.full);
    } else if (line.name.starts_with("s_") || line.name.starts_with("p_cbranch")) {
      ++counts.scalar;
    }
    ++lines_;
  }

  [[nodiscard]] const ShaderWork& work() const { return work_; }
  [[nodiscard]] int lines() const { return lines_; }
  [[nodiscard]] const std::map<std::string, int>& offsets() const { return offsets_; }

 private:
  // A loop is the blocks from its header to before its exit.
  void enter_block(std::string_view kinds) {
    if (kinds.find(" loop-exit,") != std::string_view::npos) depth_ = std::max(depth_ - 1, 0);
    if (kinds.find(" loop-header,") != std::string_view::npos) ++depth_;
  }

  void note_descriptor(const Line& line) {
    if (const std::optional<int> offset = offset_in(line.operands)) offsets_[value_in(line.defined)] = *offset;
  }

  void count_texture(const Line& line, Instructions& counts) {
    const auto found = offsets_.find(value_in(line.operands));
    TextureReads& reads =
        counts.textures[found == offsets_.end() ? unknown_binding : found->second / descriptor_bytes_];
    if (line.name.starts_with("image_gather4")) {
      ++reads.gathers;
    } else if (line.name.starts_with("image_sample")) {
      ++reads.samples;
    } else if (line.name.starts_with("image_load")) {
      ++reads.loads;
    }
  }

  int descriptor_bytes_;
  int depth_ = 0, lines_ = 0;
  ShaderWork work_;
  std::map<std::string, int> offsets_;  // of descriptors in their set, by the value that they were loaded to
};

Counter counted(const std::string& code, int descriptor_bytes) {
  Counter counter(descriptor_bytes);
  for (const auto line : std::views::split(code, '\n')) counter.read(std::string_view(line.begin(), line.end()));
  if (counter.lines() == 0)
    throw Error(ErrorKind::machine, "ACO's code", "has no instruction",
                "this version of Mesa prints its code in another form; report the version");
  return counter;
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

ShaderWork shader_work(const std::string& code, int descriptor_bytes) { return counted(code, descriptor_bytes).work(); }

int descriptor_bytes(const std::string& code) {
  const Counter counter = counted(code, 1);
  std::vector<int> offsets;
  for (const auto& [value, offset] : counter.offsets()) offsets.push_back(offset);
  std::ranges::sort(offsets);
  if (offsets.size() != 2 || offsets[0] != 0 || offsets[1] <= 0)
    throw Error(ErrorKind::machine, "ACO's code", "does not load the descriptors of two textures",
                "this version of Mesa prints its code in another form; report the version");
  return offsets[1];
}

}  // namespace footprint
