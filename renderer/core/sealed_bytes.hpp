// Plain values in a row of bytes with a checksum: what caches keep on disk, in this machine's byte order. Written and
// read piece by piece, so that a file of gigabytes takes no memory but that of the values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "renderer/core/byte_sink.hpp"
#include "renderer/core/hash.hpp"
#include "renderer/core/stored_bytes.hpp"

namespace footprint {

/// Puts values one behind the other. `form` names their order: another order, another form.
class SealedWriter {
 public:
  SealedWriter(std::string_view form, ByteSink out) : out_(std::move(out)) { add_text(form); }

  template <class Value>
  requires std::is_trivially_copyable_v<Value>
  void add(const Value& value) { put({reinterpret_cast<const std::uint8_t*>(&value), sizeof(Value)}); }
  void add_block(std::span<const std::uint8_t> block);
  void add_text(std::string_view text);
  /// As a block.
  template <class Value>
  requires std::is_trivially_copyable_v<Value>
  void add_values(const std::vector<Value>& values) {
    add_block({reinterpret_cast<const std::uint8_t*>(values.data()), values.size() * sizeof(Value)});
  }

  /// A checksum over all of it, behind it.
  void seal() &&;

 private:
  void put(std::span<const std::uint8_t> bytes);

  ByteSink out_;
  std::uint64_t sum_ = fnv1a_start;
};

/// What `fill` puts into a writer, and its checksum, in memory.
[[nodiscard]] std::vector<std::uint8_t> sealed(std::string_view form, const std::function<void(SealedWriter&)>& fill);

/// Reads what SealedWriter wrote. After the first thing that does not fit everything is empty, and `finished` false.
class SealedReader {
 public:
  /// None where the bytes are cut short, overlong, damaged or of another form: all of them are looked at before the
  /// first is handed out.
  [[nodiscard]] static std::optional<SealedReader> open(const StoredBytes& bytes, std::string_view form);

  template <class Value>
  requires std::is_trivially_copyable_v<Value> Value get() {
    if constexpr (std::is_same_v<Value, bool>) {  // 0 or 1: any other byte is no bool to begin with
      const auto byte = get<std::uint8_t>();
      whole_ = whole_ && byte <= 1;
      return byte == 1;
    } else {
      Value value{};
      if (!take({reinterpret_cast<std::uint8_t*>(&value), sizeof(Value)})) return Value{};
      return value;
    }
  }
  std::vector<std::uint8_t> get_block() { return get_values<std::uint8_t>(); }
  std::string get_text();
  /// What `add_values` wrote.
  template <class Value>
  requires std::is_trivially_copyable_v<Value> std::vector<Value> get_values() {
    const auto size = get<std::uint64_t>();
    whole_ = whole_ && size <= left() && size % sizeof(Value) == 0;
    std::vector<Value> values(whole_ ? static_cast<std::size_t>(size) / sizeof(Value) : 0);
    if (!take({reinterpret_cast<std::uint8_t*>(values.data()), values.size() * sizeof(Value)})) values.clear();
    return values;
  }
  /// A count of things that take `least` bytes each: no damaged count makes a loop run long.
  std::uint64_t get_count(std::size_t least);
  /// Everything was read, and everything fitted.
  [[nodiscard]] bool finished() const { return whole_ && left() == 0; }

 private:
  explicit SealedReader(StoredBytes body) : body_(std::move(body)) {}
  [[nodiscard]] std::uint64_t left() const { return body_.size() - at_; }
  bool take(std::span<std::uint8_t> out);

  StoredBytes body_;
  std::uint64_t at_ = 0;
  bool whole_ = true;
};

}  // namespace footprint
