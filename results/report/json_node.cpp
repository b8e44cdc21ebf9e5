// See json_node.hpp.
#include "results/report/json_node.hpp"

#include <algorithm>
#include <utility>

#include "renderer/core/suggest.hpp"

namespace footprint {

void JsonNode::fail(const std::string& message, const std::string& mend) const {
  const std::string pointer = pointer_.to_string();
  throw Error(ErrorKind::usage, *source_ + ", " + (pointer.empty() ? "the document" : pointer), message, mend);
}

const JsonNode& JsonNode::with_keys(const std::vector<std::string>& keys) const {
  if (!value_->is_object()) fail("must be an object");
  for (const auto& item : value_->items()) {
    if (std::ranges::find(keys, item.key()) == keys.end()) {
      fail("unknown key `" + item.key() + "`", suggestion(item.key(), keys));
    }
  }
  for (const std::string& key : keys) {
    if (!value_->contains(key)) fail("the key `" + key + "` is missing");
  }
  return *this;
}

std::vector<JsonNode> JsonNode::elements() const {
  if (!value_->is_array()) fail("must be an array");
  std::vector<JsonNode> nodes;
  nodes.reserve(value_->size());
  for (std::size_t i = 0; i < value_->size(); ++i) nodes.push_back({(*value_)[i], *source_, pointer_ / i});
  return nodes;
}

std::vector<std::pair<std::string, JsonNode>> JsonNode::members() const {
  if (!value_->is_object()) fail("must be an object");
  std::vector<std::pair<std::string, JsonNode>> nodes;
  for (const auto& item : value_->items()) nodes.emplace_back(item.key(), (*this)[item.key()]);
  return nodes;
}

double JsonNode::number() const {
  if (!value_->is_number()) fail("must be a number");
  return value_->get<double>();
}

std::optional<double> JsonNode::optional_number() const {
  if (is_null()) return std::nullopt;
  return number();
}

std::string JsonNode::text() const {
  if (!value_->is_string()) fail("must be a string");
  return value_->get<std::string>();
}

std::vector<std::string> JsonNode::texts() const {
  std::vector<std::string> words;
  for (const JsonNode& element : elements()) words.push_back(element.text());
  return words;
}

bool JsonNode::flag() const {
  if (!value_->is_boolean()) fail("must be true or false");
  return value_->get<bool>();
}

}  // namespace footprint
