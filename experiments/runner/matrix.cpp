// Makes members of axes, and methods of options.
#include "experiments/runner/matrix.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

#include "experiments/runner/axes.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/names.hpp"
#include "renderer/core/toml_table.hpp"
#include "renderer/scene/assembly/load_scene.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;

void read_options(const TomlTable& matrix, const std::filesystem::path& folder, std::vector<MethodSpec>& methods) {
  const std::vector<std::string> varied = matrix.keys_of("options");
  const TomlTable table = *matrix.table("options", varied);
  std::vector<std::string> texts(methods.size());
  std::ranges::transform(methods, texts.begin(), &MethodSpec::text);
  std::vector<std::vector<std::string>> variants;
  variants.reserve(texts.size());
  for (const std::string& text : texts) variants.push_back({text});
  for (const std::string& method : varied) {
    const std::size_t index = at_key(table, method, [&] { return select_method(method, texts); });
    variants[index] = at_key(table, method, [&] {
      if (variants[index].front() != texts[index])
        throw Error(ErrorKind::usage, "", "is varied twice", "give its options once");
      return times_options(table, method, texts[index]);
    });
  }
  std::vector<MethodSpec> all;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    for (const std::string& text : variants[i]) {
      at_key(matrix, "options", [&] { all.push_back(parse_methods_with_histories(text, folder).front()); });
      if (std::ranges::count(all, all.back().text, &MethodSpec::text) > 1)
        throw matrix.error_at("options", fmt::format("makes `{:.80}` twice", text), "give each value once");
    }
  }
  if (all.size() > most_methods)
    throw matrix.error_at("options", fmt::format("makes {} methods, {} at most", all.size(), most_methods),
                          "leave values out, or split the experiment");
  methods = std::move(all);
}

std::string title_of(const Experiment& whole, const Coordinates& place) {
  std::string values;
  for (const auto& [key, value] : place) values += fmt::format("{}{} {}", values.empty() ? "" : ", ", key, value);
  return fmt::format("{}: {}", whole.title, values);
}

bool is_over(const Expression& expression, const std::vector<Coordinates>& members) {
  const std::vector<Measure> measures = expression.measures();
  return std::ranges::any_of(measures, [&](const Measure& measure) {
    return std::ranges::any_of(members, [&](const Coordinates& member) { return selects(measure, member); });
  });
}

}  // namespace

std::vector<std::string> matrix_keys_of(const TomlTable& root) {
  std::vector<std::string> known = axis_keys();
  known.emplace_back("options");
  const auto table = root.table("matrix", known);
  std::vector<std::string> keys = root.keys_of("matrix");
  if (table && keys.empty())
    throw root.error_at("matrix", "varies nothing", fmt::format("give one of {}", fmt::join(known, ", ")));
  return keys;
}

void read_matrix(const TomlTable& root, Experiment& experiment) {
  const std::vector<std::string> keys = matrix_keys_of(root);
  if (keys.empty()) return;
  const TomlTable matrix = *root.table("matrix", keys);
  std::size_t members = 1;
  for (const std::string& key : axis_keys()) {
    if (!matrix.has(key)) continue;
    experiment.axes.push_back(read_axis(matrix, key));
    set_value(experiment, key, experiment.axes.back().values.front());
    if (key == "scene") experiment.scene_place = matrix.error_at(key, "", "").place();
    members *= experiment.axes.back().values.size();
    if (members > most_members)
      throw matrix.error_at(key, fmt::format("makes {} members, {} at most", members, most_members),
                            "leave values out, or split the experiment");
  }
  if (matrix.has("options")) read_options(matrix, experiment.run.method_folder, experiment.run.methods);
}

std::vector<Experiment> members_of_matrix(const Experiment& whole) {
  const std::vector<Coordinates> places = multiplied_out(whole.axes);
  const std::vector<std::string> names = names_of_places(places, {"kept", "images"});  // other folders of the output
  Experiment first = whole;
  first.axes.clear();
  first.claims.clear();
  first.thresholds.clear();
  first.published.clear();
  first.whole = whole.name;
  std::vector<Experiment> members(places.size(), first);
  for (std::size_t i = 0; i < members.size(); ++i) {
    members[i].name = names[i];
    members[i].title = title_of(whole, places[i]);
    members[i].coordinates = places[i];
    for (const auto& [key, value] : places[i]) set_value(members[i], key, value);
  }
  return members;
}

bool selects(const Measure& measure, const Coordinates& member) {
  return std::ranges::all_of(axis_selectors, [&](Selector selector) {
    const std::string* const wanted = measure.word(selector);
    return wanted == nullptr || std::ranges::any_of(member, [&](const auto& axis) {
             return axis.first == selector_name(selector) && axis.second == *wanted;
           });
  });
}

std::vector<std::string> leave_out(Experiment& whole, const std::vector<Coordinates>& missing) {
  std::vector<std::string> names;
  std::erase_if(whole.claims, [&](const Claim& claim) {
    const bool goes = is_over(claim.inequality.left, missing) || is_over(claim.inequality.right, missing);
    if (goes) names.push_back(claim.stated.name);
    return goes;
  });
  std::erase_if(whole.thresholds, [&](const Threshold& threshold) {
    const bool goes = is_over(threshold.measure, missing);
    if (goes) names.push_back(threshold.measure.text());
    return goes;
  });
  std::erase_if(whole.published, [&](const PublishedValue& value) { return is_over(value.measure, missing); });
  return names;
}

std::string scene_of_file(const std::filesystem::path& file, const std::string& name) {
  const fs::path beside = file.parent_path() / name;
  return is_scene(beside) ? beside.string() : name;
}

}  // namespace footprint
