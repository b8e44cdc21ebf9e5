// A header, the fields in order, and a checksum over all; what does not add up is no bake.
#include "renderer/bake/prefiltered_file.hpp"

#include <algorithm>
#include <cstring>
#include <string>
#include <type_traits>

#include "renderer/core/hash.hpp"

namespace footprint {
namespace {

constexpr std::string_view magic = "footprint bake 4";  // another layout below: another number here

class Writer {
 public:
  template <class Value>
  requires std::is_trivially_copyable_v<Value>
  void add(const Value& value) {
    const auto* first = reinterpret_cast<const std::uint8_t*>(&value);
    bytes_.insert(bytes_.end(), first, first + sizeof(Value));
  }
  void add_block(std::span<const std::uint8_t> block) {
    add<std::uint64_t>(block.size());
    bytes_.insert(bytes_.end(), block.begin(), block.end());
  }
  void add_text(std::string_view text) { add_block({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}); }
  void reserve(std::size_t size) { bytes_.reserve(size); }
  [[nodiscard]] std::vector<std::uint8_t> take() { return std::move(bytes_); }
  [[nodiscard]] std::span<const std::uint8_t> bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

// Reads what Writer wrote; after the first thing that does not fit, everything is empty and `whole` false.
class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

  template <class Value>
  requires std::is_trivially_copyable_v<Value> Value get() {
    Value value{};
    const std::span<const std::uint8_t> block = take(sizeof(Value));
    if (!block.empty()) std::memcpy(&value, block.data(), sizeof(Value));
    return value;
  }
  std::span<const std::uint8_t> get_block() { return take(get<std::uint64_t>()); }
  std::string get_text() {
    const std::span<const std::uint8_t> block = get_block();
    return {reinterpret_cast<const char*>(block.data()), block.size()};
  }
  /// A count of things that take `least` bytes each: no damaged count makes a loop run long.
  std::uint64_t get_count(std::size_t least) {
    const auto count = get<std::uint64_t>();
    whole_ = whole_ && count <= rest_.size() / least;
    return whole_ ? count : 0;
  }
  [[nodiscard]] bool finished() const { return whole_ && rest_.empty(); }

 private:
  std::span<const std::uint8_t> take(std::uint64_t size) {
    whole_ = whole_ && size <= rest_.size();
    if (!whole_) return {};
    const std::span<const std::uint8_t> block = rest_.first(static_cast<std::size_t>(size));
    rest_ = rest_.subspan(static_cast<std::size_t>(size));
    return block;
  }

  std::span<const std::uint8_t> rest_;
  bool whole_ = true;
};

void add_texture(Writer& out, const PrefilteredTexture& texture) {
  out.add_text(texture.name);
  out.add(texture.storage);
  out.add(texture.channels);
  out.add(texture.layers);
  out.add(texture.filter);
  out.add(texture.built);
  out.add(texture.coordinates.set);
  out.add(texture.coordinates.transform);
  out.add(texture.coordinates.wrap);
  out.add<std::uint64_t>(texture.levels.size());
  for (const TextureLevel& level : texture.levels) {
    out.add(level.width);
    out.add(level.height);
    out.add_block(level.bytes);
  }
}

PrefilteredTexture get_texture(Reader& in) {
  PrefilteredTexture texture;
  texture.name = in.get_text();
  texture.storage = in.get<Storage>();
  texture.channels = in.get<int>();
  texture.layers = in.get<int>();
  texture.filter = in.get<TextureFilter>();
  texture.built = in.get<bool>();
  texture.coordinates.set = in.get<int>();
  texture.coordinates.transform = in.get<glm::mat3x2>();
  texture.coordinates.wrap = in.get<std::array<Wrap, 2>>();
  for (std::uint64_t count = in.get_count(2 * sizeof(int)); count > 0; --count) {
    TextureLevel level;
    level.width = in.get<int>();
    level.height = in.get<int>();
    const std::span<const std::uint8_t> block = in.get_block();
    level.bytes.assign(block.begin(), block.end());
    texture.levels.push_back(std::move(level));
  }
  return texture;
}

std::string checksum(std::span<const std::uint8_t> bytes) {
  ContentHash hash;
  hash.add(magic);
  hash.add(std::as_bytes(bytes));
  return hash.hex();
}

constexpr std::size_t checksum_length = 16;

}  // namespace

std::vector<std::uint8_t> to_bytes(const Prefiltered& prefiltered) {
  Writer out;
  out.reserve(byte_count(prefiltered) + (std::size_t{1} << 16U));
  out.add_text(magic);
  out.add<std::uint64_t>(prefiltered.textures.size());
  for (const PrefilteredTexture& texture : prefiltered.textures) add_texture(out, texture);
  out.add<std::uint64_t>(prefiltered.scalars.size());
  for (const auto& [name, value] : prefiltered.scalars) {
    out.add_text(name);
    out.add(value);
  }
  out.add<std::uint64_t>(prefiltered.notes.size());
  for (const std::string& note : prefiltered.notes) out.add_text(note);
  out.add(prefiltered.surface_coordinates.has_value());
  if (prefiltered.surface_coordinates) {
    const auto bytes = std::as_bytes(std::span(*prefiltered.surface_coordinates));
    out.add_block({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  }
  const std::string sum = checksum(out.bytes());
  std::vector<std::uint8_t> bytes = out.take();
  bytes.insert(bytes.end(), sum.begin(), sum.end());
  return bytes;
}

std::optional<Prefiltered> from_bytes(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < checksum_length) return {};
  const std::span<const std::uint8_t> body = bytes.first(bytes.size() - checksum_length);
  if (!std::ranges::equal(checksum(body), bytes.last(checksum_length))) return {};
  Reader in(body);
  if (in.get_text() != magic) return {};
  Prefiltered prefiltered;
  for (std::uint64_t count = in.get_count(1); count > 0; --count) prefiltered.textures.push_back(get_texture(in));
  for (std::uint64_t count = in.get_count(1); count > 0; --count) {
    std::string name = in.get_text();
    prefiltered.scalars[std::move(name)] = in.get<float>();
  }
  for (std::uint64_t count = in.get_count(1); count > 0; --count) prefiltered.notes.push_back(in.get_text());
  if (in.get<bool>()) {
    const std::span<const std::uint8_t> block = in.get_block();
    prefiltered.surface_coordinates.emplace(block.size() / sizeof(glm::vec2));
    std::memcpy(prefiltered.surface_coordinates->data(), block.data(),
                block.size() / sizeof(glm::vec2) * sizeof(glm::vec2));
  }
  if (!in.finished()) return {};
  return prefiltered;
}

}  // namespace footprint
