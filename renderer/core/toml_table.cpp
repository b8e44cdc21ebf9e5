// Looks up keys in parsed TOML; every error has a line number.
#include "renderer/core/toml_table.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>

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

std::optional<std::string> word_of(const toml::node& node) {
  return node.is_string() ? node.value<std::string>() : std::nullopt;
}

std::optional<std::string> word_or_number_of(const toml::node& node) {
  if (node.is_integer()) return fmt::format("{}", *node.value<std::int64_t>());
  if (node.is_floating_point()) return fmt::format("{}", *node.value<double>());
  return word_of(node);
}

// The elements of a non-empty list, converted by `text_of`; none if it is not such a list.
std::optional<std::vector<std::string>> texts_of(const toml::node& node,
                                                 std::optional<std::string> (*text_of)(const toml::node&)) {
  const toml::array* array = node.as_array();
  if (array == nullptr || array->empty()) return std::nullopt;
  std::vector<std::string> values;
  for (const toml::node& element : *array) {
    std::optional<std::string> text = text_of(element);
    if (!text) return std::nullopt;
    values.push_back(*std::move(text));
  }
  return values;
}

}  // namespace

struct TomlTable::Parsed {
  std::shared_ptr<const toml::table> file;
  const toml::table* table;

  [[nodiscard]] const toml::node* find(std::string_view key) const { return table->get(key); }
  /// Another table of the same file.
  [[nodiscard]] std::shared_ptr<const Parsed> with(const toml::table& other) const {
    return std::make_shared<const Parsed>(Parsed{file, &other});
  }

  static std::shared_ptr<const Parsed> whole(toml::table content);
};

std::shared_ptr<const TomlTable::Parsed> TomlTable::Parsed::whole(toml::table content) {
  auto parsed = std::make_shared<const toml::table>(std::move(content));
  const toml::table* const table = parsed.get();
  return std::make_shared<const Parsed>(Parsed{std::move(parsed), table});
}

TomlTable::TomlTable(const std::filesystem::path& file, const std::vector<std::string>& known)
    : TomlTable(Parsed::whole(parse_file(file)), file, "", known) {}

TomlTable::TomlTable(const std::filesystem::path& file, std::string_view text, const std::vector<std::string>& known)
    : TomlTable(Parsed::whole(parse_text(file, text)), file, "", known) {}

TomlTable TomlTable::over_presets(const std::filesystem::path& file, const std::filesystem::path& presets,
                                  const std::vector<std::string>& known, const std::vector<std::string>& joined) {
  toml::table content = parse_file(file), further = parse_file(presets);
  for (const std::string& name : joined) {
    toml::table* const own = content[name].as_table();
    toml::table* const shared = further[name].as_table();
    if (own != nullptr && shared != nullptr) take_missing(*own, *shared);
  }
  take_missing(content, further);
  return {Parsed::whole(std::move(content)), file, "", known};
}

TomlTable::TomlTable(std::shared_ptr<const Parsed> parsed, std::filesystem::path file, std::string name,
                     const std::vector<std::string>& known)
    : parsed_(std::move(parsed)), file_(std::move(file)), name_(std::move(name)) {
  for (const auto& [key, node] : *parsed_->table) {
    if (std::ranges::find(known, key.str()) != known.end()) continue;
    throw Error(ErrorKind::usage, line_place(file_, key.source()),
                fmt::format("unknown key `{:.80}`{}", key.str(), name_.empty() ? "" : " in " + name_),
                suggestion(key.str(), known));
  }
}

bool TomlTable::has(std::string_view key) const { return parsed_->find(key) != nullptr; }

bool TomlTable::is_word(std::string_view key) const { return has(key) && parsed_->find(key)->is_string(); }

bool TomlTable::is_table(std::string_view key) const { return has(key) && parsed_->find(key)->is_table(); }

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
  const toml::node* node = parsed_->find(key);
  return {ErrorKind::usage, line_place(file_, node != nullptr ? node->source() : parsed_->table->source()),
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

std::optional<std::string> TomlTable::word(std::string_view key) const {
  const toml::node* node = parsed_->find(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_string()) throw error_at(key, "must be a string", "put it in quotes");
  return node->value<std::string>();
}

std::optional<std::size_t> TomlTable::choice(std::string_view key, const std::vector<std::string>& choices) const {
  const auto given = word(key);
  if (!given) return std::nullopt;
  return at_key(*this, key, [&] { return find_word(choices, *given, "word", ""); });
}

std::optional<bool> TomlTable::boolean(std::string_view key) const {
  const toml::node* node = parsed_->find(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_boolean()) throw error_at(key, "must be true or false", "write it without quotes");
  return node->value<bool>();
}

std::optional<double> TomlTable::number(std::string_view key, NumberRange range) const {
  const toml::node* node = parsed_->find(key);
  if (node == nullptr) return std::nullopt;
  return checked(*node, key, range);
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
  const toml::node* node = parsed_->find(key);
  if (node == nullptr) return std::nullopt;
  const toml::array* array = node->as_array();
  if (array == nullptr || array->empty() || (count > 0 && array->size() != count)) {
    throw error_at(key, count > 0 ? fmt::format("must be a list of {} numbers", count) : "must be a list of numbers",
                   "write it as [1, 2, 3]");
  }
  std::vector<double> values;
  for (const toml::node& element : *array) values.push_back(checked(element, key, range));
  return values;
}

std::optional<std::vector<std::string>> TomlTable::words(std::string_view key) const {
  const toml::node* node = parsed_->find(key);
  if (node == nullptr) return std::nullopt;
  if (auto values = texts_of(*node, word_of)) return values;
  throw error_at(key, "must be a list of strings", R"(write it as ["a", "b"])");
}

std::optional<std::vector<std::string>> TomlTable::words_or_numbers(std::string_view key) const {
  const toml::node* node = parsed_->find(key);
  if (node == nullptr) return std::nullopt;
  if (auto values = texts_of(*node, word_or_number_of)) return values;
  throw error_at(key, "must be a list of strings or numbers", R"(write it as ["a", "b"], or [1, 2])");
}

std::optional<TomlTable> TomlTable::table(std::string_view key, const std::vector<std::string>& known) const {
  const toml::node* node = parsed_->find(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_table()) throw error_at(key, "must be a table", fmt::format("write [{}]", path_of(key)));
  return TomlTable(parsed_->with(*node->as_table()), file_, fmt::format("[{}]", path_of(key)), known);
}

std::vector<std::string> TomlTable::keys_of(std::string_view key) const {
  std::vector<std::string> keys;
  const toml::node* node = parsed_->find(key);
  if (node == nullptr || !node->is_table()) return keys;
  for (const auto& [name, value] : *node->as_table()) keys.emplace_back(name.str());
  return keys;
}

std::vector<TomlTable> TomlTable::tables(std::string_view key, const std::vector<std::string>& known) const {
  const toml::node* node = parsed_->find(key);
  std::vector<TomlTable> result;
  if (node == nullptr) return result;
  const toml::array* array = node->as_array();
  if (array == nullptr || !array->is_array_of_tables()) {
    throw error_at(key, "must be a list of tables", fmt::format("write [[{}]]", path_of(key)));
  }
  for (const toml::node& element : *array) {
    result.push_back(TomlTable(parsed_->with(*element.as_table()), file_, fmt::format("[[{}]]", path_of(key)), known));
  }
  return result;
}

}  // namespace footprint
