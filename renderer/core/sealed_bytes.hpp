// Plain values in a row of bytes with a checksum: what caches keep on disk, in this machine's byte order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace footprint {

/// Puts values one behind the other. `form` names their order: another order, another form.
class SealedWriter {
 public:
  explicit SealedWriter(std::string_view form) { add_text(form); }

  template <class Value>
  requires std::is_trivially_copyable_v<Value>
  void add(const Value& value) {
    const auto* first = reinterpret_cast<const std::uint8_t*>(&value);
    bytes_.insert(bytes_.end(), first, first + sizeof(Value));
  }
  void add_block(std::span<const std::uint8_t> block);
  void add_text(std::string_view text);
  /// As a block.
  template <class Value>
  requires std::is_trivially_copyable_v<Value>
  void add_values(const std::vector<Value>& values) {
    add_block({reinterpret_cast<const std::uint8_t*>(values.data()), values.size() * sizeof(Value)});
  }
  void reserve(std::size_t size) { bytes_.reserve(size); }

  /// All of it, and a checksum over it.
  [[nodiscard]] std::vector<std::uint8_t> seal() &&;

 private:
  std::vector<std::uint8_t> bytes_;
};

/// Reads what SealedWriter wrote, without copying it. After the first thing that does not fit everything is empty, and
/// `finished` false.
class SealedReader {
 public:
  /// None where the bytes are cut short, overlong, damaged or of another form.
  [[nodiscard]] static std::optional<SealedReader> open(std::span<const std::uint8_t> bytes, std::string_view form);

  template <class Value>
  requires std::is_trivially_copyable_v<Value> Value get() {
    if constexpr (std::is_same_v<Value, bool>) {  // 0 or 1: any other byte is no bool to begin with
      const auto byte = get<std::uint8_t>();
      whole_ = whole_ && byte <= 1;
      return byte == 1;
    } else {
      Value value{};
      const std::span<const std::uint8_t> block = take(sizeof(Value));
      if (!block.empty()) std::memcpy(&value, block.data(), sizeof(Value));
      return value;
    }
  }
  std::span<const std::uint8_t> get_block() { return take(get<std::uint64_t>()); }
  std::string get_text();
  /// What `add_values` wrote.
  template <class Value>
  requires std::is_trivially_copyable_v<Value> std::vector<Value> get_values() {
    const std::span<const std::uint8_t> block = get_block();
    whole_ = whole_ && block.size() % sizeof(Value) == 0;
    std::vector<Value> values(block.size() / sizeof(Value));
    if (!values.empty()) std::memcpy(values.data(), block.data(), values.size() * sizeof(Value));
    return values;
  }
  /// A count of things that take `least` bytes each: no damaged count makes a loop run long.
  std::uint64_t get_count(std::size_t least);
  /// Everything was read, and everything fitted.
  [[nodiscard]] bool finished() const { return whole_ && rest_.empty(); }

 private:
  explicit SealedReader(std::span<const std::uint8_t> bytes) : rest_(bytes) {}
  std::span<const std::uint8_t> take(std::uint64_t size);

  std::span<const std::uint8_t> rest_;
  bool whole_ = true;
};

}  // namespace footprint
