// Bytes: sinks that receive them piece by piece, sources in memory or in a file, content hashes, and values stored with
// a checksum.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "renderer/core/members.hpp"

namespace footprint {

/// FNV-1a, 64 bit (Fowler, Noll, Vo), of no bytes.
inline constexpr std::uint64_t fnv1a_start = 0xcbf29ce484222325U;

/// FNV-1a, 64 bit, continued from `state` over `bytes`.
[[nodiscard]] std::uint64_t fnv1a(std::span<const std::byte> bytes, std::uint64_t state = fnv1a_start);

/// The hash of a sequence of fields. Each field counts with its length, so ("ab", "c") differs from ("a", "bc").
class ContentHash {
 public:
  void add(std::span<const std::byte> field);
  void add(std::string_view field);

  /// 16 hexadecimal digits, lower case.
  [[nodiscard]] std::string hex() const;

 private:
  std::uint64_t state_ = fnv1a_start;
};

/// Receives the next bytes.
using ByteSink = std::function<void(std::span<const std::uint8_t>)>;

/// Writes bytes to a sink, piece by piece.
using ByteWriter = std::function<void(const ByteSink&)>;

/// A sink that appends to `bytes`.
[[nodiscard]] inline ByteSink appending_to(std::vector<std::uint8_t>& bytes) {
  return [&bytes](std::span<const std::uint8_t> piece) { bytes.insert(bytes.end(), piece.begin(), piece.end()); };
}

/// Constant bytes. Copies share the open file.
class ByteSource {
 public:
  /// Bytes in memory, which must outlive this.
  ByteSource(std::span<const std::uint8_t> bytes)  // NOLINT(google-explicit-constructor): a view of them
      : bytes_(bytes), size_(bytes.size()) {}
  ByteSource(const std::vector<std::uint8_t>& bytes)  // NOLINT(google-explicit-constructor): a view of them
      : ByteSource(std::span(bytes)) {}
  /// The bytes of a file as it was opened, even if it is replaced meanwhile. None if it is not a regular file or cannot
  /// be read.
  [[nodiscard]] static std::optional<ByteSource> of_file(const std::filesystem::path& file);

  [[nodiscard]] std::uint64_t size() const { return size_; }
  /// Fills `out` with the bytes that start at `from`. False if there are fewer, or they cannot be read.
  [[nodiscard]] bool read(std::uint64_t from, std::span<std::uint8_t> out) const;
  /// The first `size` bytes.
  [[nodiscard]] ByteSource first(std::uint64_t size) const;

 private:
  ByteSource() = default;

  std::shared_ptr<const int> file_;  // descriptor; null: `bytes_`
  std::span<const std::uint8_t> bytes_;
  std::uint64_t size_ = 0;
};

/// The bytes of a regular file.
/// largest: a larger file is refused before memory is allocated.
/// Throws Error (usage): missing, a folder or a device, empty, unreadable, or too large.
[[nodiscard]] std::vector<std::uint8_t> read_file_bytes(const std::filesystem::path& file, std::uint64_t largest);

/// Writes values in this machine's byte order, then a checksum. Values are written piece by piece, so that a file of
/// gigabytes needs no second copy. A structure is written and read member by member; one that has constructors by its
/// `fields(archive, value)`, a template that calls the archive with all of its members.
class ChecksummedWriter {
 public:
  /// form: names the kind and the order of the values; change it with them.
  ChecksummedWriter(std::string_view form, ByteSink out) : out_(std::move(out)) { add_text(form); }

  template <class... T>
  void operator()(const T&... values) {
    (write(values), ...);
  }

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

  /// Writes the checksum of everything before it.
  void finish() &&;

 private:
  template <class T>
  void write(const T& value) {
    if constexpr (std::is_trivially_copyable_v<T>) {
      add(value);
    } else if constexpr (std::is_aggregate_v<T>) {
      std::apply(*this, members_of(value));
    } else {
      // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast): shared with the reader; a writer changes nothing
      fields(*this, const_cast<T&>(value));
    }
  }
  void write(const std::string& text) { add_text(text); }
  template <class T>
  void write(const std::vector<T>& values) {
    if constexpr (std::is_trivially_copyable_v<T>) {
      add_values(values);
    } else {
      add<std::uint64_t>(values.size());
      for (const T& value : values) write(value);
    }
  }
  template <class T>
  void write(const std::optional<T>& value) {
    add(value.has_value());
    if (value) write(*value);
  }
  template <class T>
  void write(const std::map<std::string, T>& values) {
    add<std::uint64_t>(values.size());
    for (const auto& [name, value] : values) (*this)(name, value);
  }
  void put(std::span<const std::uint8_t> bytes);

  ByteSink out_;
  std::uint64_t sum_ = fnv1a_start;
};

/// The bytes that `fill` writes, with their checksum.
[[nodiscard]] std::vector<std::uint8_t> write_checksummed(std::string_view form,
                                                          const std::function<void(ChecksummedWriter&)>& fill);

/// Reads the output of ChecksummedWriter. After the first mismatch all values are empty and `finished` is false.
class ChecksummedReader {
 public:
  /// Verifies all bytes first. None if they are truncated, too long, damaged or of another form.
  [[nodiscard]] static std::optional<ChecksummedReader> open(const ByteSource& bytes, std::string_view form);

  template <class... T>
  void operator()(T&... values) {
    (read(values), ...);
  }

  template <class Value>
  requires std::is_trivially_copyable_v<Value> Value get() {
    if constexpr (std::is_same_v<Value, bool>) {  // any byte but 0 and 1 is not a valid bool
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
  /// The values of `add_values`.
  template <class Value>
  requires std::is_trivially_copyable_v<Value> std::vector<Value> get_values() {
    const auto size = get<std::uint64_t>();
    whole_ = whole_ && size <= left() && size % sizeof(Value) == 0;
    std::vector<Value> values(whole_ ? static_cast<std::size_t>(size) / sizeof(Value) : 0);
    if (!take({reinterpret_cast<std::uint8_t*>(values.data()), values.size() * sizeof(Value)})) values.clear();
    return values;
  }
  /// A count of items of at least `least` bytes each, so that a damaged count cannot make a loop long.
  std::uint64_t get_count(std::size_t least);
  /// Whether everything was read, without a mismatch.
  [[nodiscard]] bool finished() const { return whole_ && left() == 0; }

 private:
  explicit ChecksummedReader(ByteSource body) : body_(std::move(body)) {}
  template <class T>
  void read(T& value) {
    if constexpr (std::is_trivially_copyable_v<T>) {
      value = get<T>();
    } else if constexpr (std::is_aggregate_v<T>) {
      std::apply(*this, members_of(value));
    } else {
      fields(*this, value);
    }
  }
  void read(std::string& text) { text = get_text(); }
  template <class T>
  void read(std::vector<T>& values) {
    if constexpr (std::is_trivially_copyable_v<T>) {
      values = get_values<T>();
    } else {
      values.clear();
      for (std::uint64_t count = get_count(1); count > 0; --count) read(values.emplace_back());
    }
  }
  template <class T>
  void read(std::optional<T>& value) {
    value.reset();
    if (get<bool>()) read(value.emplace());
  }
  template <class T>
  void read(std::map<std::string, T>& values) {
    values.clear();
    for (std::uint64_t count = get_count(1); count > 0; --count) {
      const std::string name = get_text();
      read(values[name]);
    }
  }
  [[nodiscard]] std::uint64_t left() const { return body_.size() - at_; }
  bool take(std::span<std::uint8_t> out);

  ByteSource body_;
  std::uint64_t at_ = 0;
  bool whole_ = true;
};

}  // namespace footprint
