// Bytes: sinks that receive them piece by piece, sources in memory or in a file, content hashes, and values as bytes.
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
#include <tuple>
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

/// Whether a value may be passed as its bytes: a number, an enumeration, a fixed number of those, or a structure of
/// them without gaps, whose content is undefined. A bool is checked when it is read.
template <class T>
[[nodiscard]] consteval bool passes_as_bytes() {
  if constexpr (!std::is_trivially_copyable_v<T> || std::is_same_v<T, bool>) {
    return false;
  } else if constexpr (
      requires { T::length(); } || requires { std::tuple_size<T>::value; }) {  // of glm, or an array
    return passes_as_bytes<typename T::value_type>();
  } else if constexpr (std::is_aggregate_v<T>) {
    return []<class... Members>(std::type_identity<std::tuple<Members&...>> /*members*/) {
      return (passes_as_bytes<Members>() && ...) && (sizeof(Members) + ...) == sizeof(T);
    }(std::type_identity<decltype(members_of(std::declval<T&>()))>());
  } else {
    return std::is_arithmetic_v<T> || std::is_enum_v<T>;
  }
}

/// Passes values to bytes or back, in this machine's byte order, piece by piece, so that gigabytes need no second copy.
/// Structures are passed member by member, or by their `fields(archive, value)`, a template that calls the archive with
/// its members.
class ByteArchive {
 public:
  explicit ByteArchive(ByteSink out) : out_(std::move(out)) {}
  /// After the first mismatch all values are empty, and `finished` is false.
  explicit ByteArchive(ByteSource in) : in_(std::move(in)) {}

  /// Reads into the values, which are constant only when they are written.
  template <class... T>
  void operator()(const T&... values) {
    (pass(const_cast<T&>(values)), ...);  // NOLINT(cppcoreguidelines-pro-type-const-cast): one walk for both directions
  }

  /// Whether all bytes were read, without a mismatch.
  [[nodiscard]] bool finished() const { return whole_ && left() == 0; }

 private:
  template <class T>
  void pass(T& value) {
    if constexpr (passes_as_bytes<T>()) {
      pass_bytes({reinterpret_cast<std::uint8_t*>(&value), sizeof(T)});
    } else if constexpr (requires { fields(*this, value); }) {
      fields(*this, value);
    } else {
      std::apply(*this, members_of(value));
    }
  }
  void pass(bool& value);
  void pass(std::string& text);
  template <class T>
  void pass(std::vector<T>& values) {
    constexpr std::size_t unit = passes_as_bytes<T>() ? sizeof(T) : 1;
    const std::size_t count = pass_count(values.size() * unit, unit);
    if (in_) values = std::vector<T>(count);
    if constexpr (passes_as_bytes<T>()) {
      pass_bytes({reinterpret_cast<std::uint8_t*>(values.data()), values.size() * sizeof(T)});
    } else {
      for (T& value : values) pass(value);
    }
  }
  template <class T>
  void pass(std::optional<T>& value) {
    bool has_value = value.has_value();
    pass(has_value);
    if (in_) value.reset();
    if (in_ && has_value) value.emplace();
    if (value) pass(*value);
  }
  template <class T>
  void pass(std::map<std::string, T>& values) {
    std::size_t count = pass_count(values.size(), 1);
    for (auto& [name, value] : values) (*this)(name, value);
    for (; in_ && count > 0; --count) {
      std::string name;
      pass(name);
      pass(values[name]);
    }
  }

  /// Passes a number of bytes or, with a `unit` of 1, of items of at least a byte, so that a damaged one cannot make a
  /// loop long. Returns it in units.
  std::size_t pass_count(std::uint64_t count, std::size_t unit);
  void pass_bytes(std::span<std::uint8_t> bytes);
  [[nodiscard]] std::uint64_t left() const { return in_ ? in_->size() - at_ : 0; }

  ByteSink out_;
  std::optional<ByteSource> in_;  // none: writes
  std::uint64_t at_ = 0;
  bool whole_ = true;
};

/// The 16 digits that follow checksummed bytes.
[[nodiscard]] std::string checksum(std::uint64_t sum);

/// Bytes without the checksum behind them; none if they are truncated, too long or damaged.
[[nodiscard]] std::optional<ByteSource> without_checksum(const ByteSource& bytes);

/// Writes a value with a checksum.
/// form: names the kind and the layout of the value; change it with them.
template <class Value>
void write_checksummed(std::string_view form, const Value& value, const ByteSink& out) {
  std::uint64_t sum = fnv1a_start;
  ByteArchive archive([&](std::span<const std::uint8_t> piece) {
    sum = fnv1a(std::as_bytes(piece), sum);
    out(piece);
  });
  archive(std::string(form), value);
  const std::string digits = checksum(sum);
  out({reinterpret_cast<const std::uint8_t*>(digits.data()), digits.size()});
}

/// The value that `write_checksummed` wrote; none if the bytes are truncated, too long, damaged or of another form.
template <class Value>
[[nodiscard]] std::optional<Value> read_checksummed(std::string_view form, const ByteSource& bytes) {
  const std::optional<ByteSource> body = without_checksum(bytes);
  if (!body) return {};
  ByteArchive archive(*body);
  std::string found;
  archive(found);
  std::optional<Value> value;
  if (found == form) archive(value.emplace());
  return archive.finished() ? std::move(value) : std::nullopt;
}

}  // namespace footprint
