// Looks up keys in parsed TOML; every error has a line number.
#include "renderer/core/toml_table.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "renderer/core/bytes.hpp"
#include "renderer/core/names.hpp"

namespace footprint {
namespace {

// The file and line of a node; tables without a line are of `file`.
std::string line_place(const std::filesystem::path& file, const toml::source_region& source) {
  return fmt::format("{}:{}", source.path ? *source.path : file.string(), source.begin.line);
}

toml::table parse_text(const std::filesystem::path& file, std::string_view text) {
  try {
    return toml::parse(text, file.string());
  } catch (const toml::parse_error& error) {
    throw Error(ErrorKind::usage, line_place(file, error.source()),
                fmt::format("not valid TOML: {}", error.description()), "correct the line");
  }
}

toml::table parse_file(const std::filesystem::path& file) {
  constexpr std::uint64_t largest = std::uint64_t{1} << 20U;
  const auto bytes = read_file_bytes(file, largest);
  return parse_text(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

// Moves missing entries into `target`, because copies of nodes lose their line.
void take_missing(toml::table& target, toml::table& presets) {
  for (auto&& entry : presets) {
    if (target.contains(entry.first.str())) continue;
    entry.second.visit([&](auto& value) { target.insert(entry.first, std::move(value)); });
  }
}

std::optional<std::string> word_of(const toml::node& node) { return node.value_exact<std::string>(); }

std::optional<std::string> word_or_number_of(const toml::node& node) {
  if (node.is_integer()) return fmt::format("{}", *node.value<std::int64_t>());
  if (node.is_floating_point()) return fmt::format("{}", *node.value<double>());
  return word_of(node);
}

std::optional<TomlScalar> scalar_of(const toml::node& node) {
  if (node.is_integer()) return *node.value<std::int64_t>();
  if (node.is_floating_point()) return *node.value<double>();
  if (node.is_boolean()) return *node.value<bool>();
  if (auto word = word_of(node)) return *std::move(word);
  return std::nullopt;
}

std::optional<TomlScalar> word_or_number_scalar_of(const toml::node& node) {
  return node.is_boolean() ? std::nullopt : scalar_of(node);
}

// The elements of a non-empty list, converted by `value_of`; none if it is not such a list.
template <class Value>
std::optional<std::vector<Value>> values_of(const toml::node& node,
                                            std::optional<Value> (*value_of)(const toml::node&)) {
  const toml::array* array = node.as_array();
  if (array == nullptr || array->empty()) return std::nullopt;
  std::vector<Value> values;
  for (const toml::node& element : *array) {
    std::optional<Value> value = value_of(element);
    if (!value) return std::nullopt;
    values.push_back(*std::move(value));
  }
  return values;
}

}  // namespace

TomlTable::TomlTable(const std::filesystem::path& file, const std::vector<std::string>& known)
    : TomlTable(std::make_shared<const toml::table>(parse_file(file)), file, "", known) {}

TomlTable::TomlTable(const std::filesystem::path& file, std::string_view text, const std::vector<std::string>& known)
    : TomlTable(std::make_shared<const toml::table>(parse_text(file, text)), file, "", known) {}

TomlTable TomlTable::over_presets(const std::filesystem::path& file, const std::filesystem::path& presets,
                                  const std::vector<std::string>& known, const std::vector<std::string>& joined) {
  toml::table content = parse_file(file), further = parse_file(presets);
  for (const std::string& name : joined) {
    toml::table* const own = content[name].as_table();
    toml::table* const shared = further[name].as_table();
    if (own != nullptr && shared != nullptr) take_missing(*own, *shared);
  }
  take_missing(content, further);
  return {std::make_shared<const toml::table>(std::move(content)), file, "", known};
}

TomlTable::TomlTable(std::shared_ptr<const toml::table> table, std::filesystem::path file, std::string name,
                     const std::vector<std::string>& known)
    : table_(std::move(table)), file_(std::move(file)), name_(std::move(name)) {
  for (const auto& [key, node] : *table_) {
    if (std::ranges::find(known, key.str()) != known.end()) continue;
    throw Error(ErrorKind::usage, line_place(file_, key.source()),
                fmt::format("unknown key `{:.80}`{}", key.str(), name_.empty() ? "" : " in " + name_),
                suggestion(key.str(), known));
  }
}

bool TomlTable::has(std::string_view key) const { return table_->contains(key); }

bool TomlTable::is_word(std::string_view key) const { return has(key) && table_->get(key)->is_string(); }

bool TomlTable::is_table(std::string_view key) const { return has(key) && table_->get(key)->is_table(); }

std::string TomlTable::full_name(std::string_view key) const {
  return name_.empty() ? fmt::format("`{}`", key) : fmt::format("`{}` in {}", key, name_);
}

std::string TomlTable::path_of(std::string_view key) const {
  if (name_.empty()) return std::string(key);
  const std::string_view name = name_;
  const std::size_t first = name.find_first_not_of('[');
  return fmt::format("{}.{}", name.substr(first, name.find_last_not_of(']') + 1 - first), key);
}

Error TomlTable::error_at(std::string_view key, const std::string& message, const std::string& hint) const {
  const toml::node* node = table_->get(key);
  return {ErrorKind::usage, line_place(file_, node != nullptr ? node->source() : table_->source()),
          full_name(key) + " " + message, hint};
}

template <typename Node>
double TomlTable::checked(const Node& node, std::string_view key, NumberRange range) const {
  const auto value = node.is_number() ? node.template value<double>() : std::nullopt;
  if (!value) throw error_at(key, "must be a number", "write it without quotes");
  if (!(*value >= range.low && *value <= range.high)) {  // also NaN
    throw error_at(key, fmt::format("is {:g}, not within {:g} to {:g}", *value, range.low, range.high),
                   "choose a value in the range");
  }
  return *value;
}

// Returns a key's value as `convert` makes it, which refuses by an empty result; empty too if the key is missing.
template <class Convert>
auto TomlTable::read(std::string_view key, const std::string& message, const std::string& hint,
                     const Convert& convert) const {
  using Result = std::invoke_result_t<Convert, const toml::node&>;
  const toml::node* const node = table_->get(key);
  Result result = node != nullptr ? convert(*node) : Result();
  if (node != nullptr && !result) throw error_at(key, message, hint);
  return result;
}

std::optional<std::string> TomlTable::word(std::string_view key) const {
  return read(key, "must be a string", "put it in quotes", word_of);
}

std::optional<std::size_t> TomlTable::choice(std::string_view key, const std::vector<std::string>& choices) const {
  const auto given = word(key);
  if (!given) return std::nullopt;
  return at_key(*this, key, [&] { return find_word(choices, *given, "word", ""); });
}

std::optional<bool> TomlTable::boolean(std::string_view key) const {
  return read(key, "must be true or false", "write it without quotes",
              [](const toml::node& node) { return node.value_exact<bool>(); });
}

std::optional<double> TomlTable::number(std::string_view key, NumberRange range) const {
  return has(key) ? std::optional(checked(*table_->get(key), key, range)) : std::nullopt;
}

std::optional<std::int64_t> TomlTable::whole_number(std::string_view key, NumberRange range) const {
  const auto value = number(key, range);
  if (!value) return std::nullopt;
  if (*value != std::floor(*value)) {
    throw error_at(key, fmt::format("is {:g}, which is not a whole number", *value), "leave out the fraction");
  }
  return static_cast<std::int64_t>(*value);
}

std::optional<std::vector<double>> TomlTable::numbers(std::string_view key, std::size_t count,
                                                      NumberRange range) const {
  const toml::array* const array =
      read(key, count > 0 ? fmt::format("must be a list of {} numbers", count) : "must be a list of numbers",
           "write it as [1, 2, 3]", [&](const toml::node& node) {
             const toml::array* const list = node.as_array();
             const bool fits = list != nullptr && !list->empty() && (count == 0 || list->size() == count);
             return fits ? list : nullptr;
           });
  if (array == nullptr) return std::nullopt;
  std::vector<double> values;
  for (const toml::node& element : *array) values.push_back(checked(element, key, range));
  return values;
}

std::optional<std::vector<std::string>> TomlTable::words(std::string_view key) const {
  return read(key, "must be a list of strings", R"(write it as ["a", "b"])",
              [](const toml::node& node) { return values_of(node, word_of); });
}

std::optional<std::vector<std::string>> TomlTable::words_or_numbers(std::string_view key) const {
  return read(key, "must be a list of strings or numbers", R"(write it as ["a", "b"], or [1, 2])",
              [](const toml::node& node) { return values_of(node, word_or_number_of); });
}

std::optional<TomlScalar> TomlTable::scalar(std::string_view key) const {
  return read(key, "must be a string or a number", "write one value", scalar_of);
}

std::optional<std::vector<TomlScalar>> TomlTable::scalars(std::string_view key) const {
  return read(key, "must be a list of strings or numbers", R"(write it as ["a", "b"], or [1, 2])",
              [](const toml::node& node) { return values_of(node, word_or_number_scalar_of); });
}

std::optional<TomlTable> TomlTable::table(std::string_view key, const std::vector<std::string>& known) const {
  const std::string name = fmt::format("[{}]", path_of(key));
  const toml::table* const found =
      read(key, "must be a table", "write " + name, [](const toml::node& node) { return node.as_table(); });
  if (found == nullptr) return std::nullopt;
  return TomlTable({table_, found}, file_, name, known);
}

std::vector<std::string> TomlTable::keys_of(std::string_view key) const {
  std::vector<std::string> keys;
  if (!is_table(key)) return keys;
  for (const auto& [name, value] : *table_->get(key)->as_table()) keys.emplace_back(name.str());
  return keys;
}

std::vector<TomlTable> TomlTable::tables(std::string_view key, const std::vector<std::string>& known) const {
  const std::string name = fmt::format("[[{}]]", path_of(key));
  const toml::array* const array = read(key, "must be a list of tables", "write " + name, [](const toml::node& node) {
    return node.is_array_of_tables() ? node.as_array() : nullptr;
  });
  std::vector<TomlTable> result;
  for (std::size_t i = 0; array != nullptr && i < array->size(); ++i)
    result.push_back(TomlTable({table_, array->get_as<toml::table>(i)}, file_, name, known));
  return result;
}

}  // namespace footprint
