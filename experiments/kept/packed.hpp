// Plain values as sealed bytes and back, exactly: what is kept between runs (renderer/core/sealed_bytes.hpp).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "renderer/core/sealed_bytes.hpp"

namespace footprint {

/// Puts values one behind the other. A structure is taken apart by its `fields(archive, value)`, found by its
/// namespace, which Packer and Unpacker share.
class Packer {
 public:
  explicit Packer(SealedWriter& writer) : writer_(&writer) {}

  template <class... T>
  void operator()(T&... values) {
    (put(values), ...);
  }

 private:
  template <class T>
  void put(T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      writer_->add(value);
    } else {
      fields(*this, value);
    }
  }
  void put(std::string& text) { writer_->add_text(text); }
  template <class T>
  void put(std::vector<T>& values) {
    writer_->add<std::uint64_t>(values.size());
    if constexpr (std::is_arithmetic_v<T>) {
      writer_->add_values(values);
    } else {
      for (T& value : values) put(value);
    }
  }
  template <class First, class Second>
  void put(std::pair<First, Second>& value) {
    put(value.first);
    put(value.second);
  }
  template <class T, std::size_t count>
  void put(std::array<T, count>& values) {
    for (T& value : values) put(value);
  }
  template <class T>
  void put(std::optional<T>& value) {
    writer_->add(value.has_value());
    if (value) put(*value);
  }
  template <class Value>
  void put(std::map<std::string, Value>& values) {
    writer_->add<std::uint64_t>(values.size());
    for (auto& [name, value] : values) {
      writer_->add_text(name);
      put(value);
    }
  }
  void put(std::variant<double, std::string>& value) {
    writer_->add<std::uint64_t>(value.index());
    std::visit([this](auto& held) { put(held); }, value);
  }

  SealedWriter* writer_;
};

/// Reads what Packer put. What does not fit leaves the reader unfinished.
class Unpacker {
 public:
  explicit Unpacker(SealedReader& reader) : reader_(&reader) {}

  template <class... T>
  void operator()(T&... values) {
    (get(values), ...);
  }

 private:
  template <class T>
  void get(T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      value = reader_->get<T>();
    } else {
      fields(*this, value);
    }
  }
  void get(std::string& text) { text = reader_->get_text(); }
  template <class T>
  void get(std::vector<T>& values) {
    if constexpr (std::is_arithmetic_v<T>) {
      (void)reader_->get_count(1);  // a text has no count before its block
      values = reader_->get_values<T>();
    } else {
      values.resize(reader_->get_count(1));
      for (T& value : values) get(value);
    }
  }
  template <class First, class Second>
  void get(std::pair<First, Second>& value) {
    get(value.first);
    get(value.second);
  }
  template <class T, std::size_t count>
  void get(std::array<T, count>& values) {
    for (T& value : values) get(value);
  }
  template <class T>
  void get(std::optional<T>& value) {
    value.reset();
    if (reader_->get<bool>()) get(value.emplace());
  }
  template <class Value>
  void get(std::map<std::string, Value>& values) {
    values.clear();
    for (std::uint64_t left = reader_->get_count(1); left > 0; --left) {
      const std::string name = reader_->get_text();
      get(values[name]);
    }
  }
  void get(std::variant<double, std::string>& value) {
    if (reader_->get<std::uint64_t>() == 0) {
      get(value.emplace<double>());
    } else {
      get(value.emplace<std::string>());
    }
  }

  SealedReader* reader_;
};

/// The value as bytes with a checksum; `form` names what it is.
template <class T>
[[nodiscard]] std::vector<std::uint8_t> packed(T value, std::string_view form) {
  return sealed(form, [&](SealedWriter& writer) {
    Packer pack(writer);
    pack(value);
  });
}

/// None where the bytes are damaged, of another form, or hold something else.
template <class T>
[[nodiscard]] std::optional<T> unpacked(std::span<const std::uint8_t> bytes, std::string_view form) {
  std::optional<SealedReader> reader = SealedReader::open(bytes, form);
  if (!reader) return {};
  T value{};
  Unpacker unpack(*reader);
  unpack(value);
  if (!reader->finished()) return {};
  return value;
}

}  // namespace footprint
