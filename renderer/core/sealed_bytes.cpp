// The checksum is the last field: a hash of everything before it, form included.
#include "renderer/core/sealed_bytes.hpp"

#include <algorithm>

#include "renderer/core/hash.hpp"

namespace footprint {
namespace {

constexpr std::size_t checksum_length = 16;

std::string checksum(std::span<const std::uint8_t> bytes) {
  ContentHash hash;
  hash.add(std::as_bytes(bytes));
  return hash.hex();
}

}  // namespace

void SealedWriter::add_block(std::span<const std::uint8_t> block) {
  add<std::uint64_t>(block.size());
  bytes_.insert(bytes_.end(), block.begin(), block.end());
}

void SealedWriter::add_text(std::string_view text) {
  add_block({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

std::vector<std::uint8_t> SealedWriter::seal() && {
  const std::string sum = checksum(bytes_);
  bytes_.insert(bytes_.end(), sum.begin(), sum.end());
  return std::move(bytes_);
}

std::optional<SealedReader> SealedReader::open(std::span<const std::uint8_t> bytes, std::string_view form) {
  if (bytes.size() < checksum_length) return {};
  const std::span<const std::uint8_t> body = bytes.first(bytes.size() - checksum_length);
  if (!std::ranges::equal(checksum(body), bytes.last(checksum_length))) return {};
  SealedReader reader(body);
  if (reader.get_text() != form) return {};
  return reader;
}

std::string SealedReader::get_text() {
  const std::span<const std::uint8_t> block = get_block();
  return {reinterpret_cast<const char*>(block.data()), block.size()};
}

std::uint64_t SealedReader::get_count(std::size_t least) {
  const auto count = get<std::uint64_t>();
  whole_ = whole_ && count <= rest_.size() / least;
  return whole_ ? count : 0;
}

std::span<const std::uint8_t> SealedReader::take(std::uint64_t size) {
  whole_ = whole_ && size <= rest_.size();
  if (!whole_) return {};
  const std::span<const std::uint8_t> block = rest_.first(static_cast<std::size_t>(size));
  rest_ = rest_.subspan(static_cast<std::size_t>(size));
  return block;
}

}  // namespace footprint
