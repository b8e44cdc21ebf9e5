// Reads an Experiment from TOML and checks every expression against what the run will measure.
#include "experiments/runner/experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <system_error>
#include <utility>

#include "experiments/runner/axes.hpp"
#include "experiments/runner/matrix.hpp"
#include "experiments/runner/region.hpp"
#include "experiments/settings/setting.hpp"
#include "experiments/studies/stage.hpp"
#include "experiments/studies/view_path.hpp"
#include "methods/registry.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/names.hpp"
#include "renderer/core/toml_table.hpp"
#include "renderer/scene/assembly/load_scene.hpp"
#include "renderer/scene/settings/scene.hpp"
#include "renderer/scene/settings/toml_values.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;

constexpr NumberRange any_number{-1e300, 1e300};
constexpr double most_frames = 10000;

// The tables of an experiment without members, apart from [experiment].
const std::vector<std::string> further_tables{"zoom",      "camera", "reference", "matrix", "ndf",   "quantity",
                                              "published", "claim",  "threshold", "figure", "region"};
// The tables of presets. A file may take single keys of joined_tables; it takes the others whole.
const std::vector<std::string> preset_tables{"experiment", "zoom", "camera", "reference", "matrix"};
const std::vector<std::string> joined_tables{"experiment", "reference", "matrix"};
const std::vector<std::string> head_keys{"title", "description", "members", "presets"};
const std::vector<std::string> claim_keys{"name", "text", "source", "gpu_class", "inequality", "expect", "reason"};

std::vector<std::string> with(std::vector<std::string> keys, const std::vector<std::string>& further) {
  keys.insert(keys.end(), further.begin(), further.end());
  return keys;
}

// The value that was read of a key. Errors (usage): it is missing.
template <class Value>
Value needed(const TomlTable& table, std::string_view key, std::optional<Value> value) {
  return required(table, key, std::move(value), experiments_document);
}

std::string required_word(const TomlTable& table, std::string_view key) {
  std::string word = needed(table, key, table.word(key));
  if (word.empty()) throw table.error_at(key, "is empty", "fill it in");
  return word;
}

// The keys of [`name`] that [matrix] gives. Errors (usage): a key is in both.
std::vector<std::string> given_by_matrix(const TomlTable& root, const std::optional<TomlTable>& table,
                                         std::string_view name) {
  std::vector<std::string> given;
  for (const std::string& key : matrix_keys_of(root)) {
    if (std::ranges::count(axis_keys(name), key) == 0) continue;
    if (table && table->has(key)) throw table->error_at(key, "is also in [matrix]", "give it in one of them");
    given.push_back(key);
  }
  return given;
}

void read_head(const TomlTable& table, const std::vector<std::string>& given, Experiment& experiment) {
  experiment.title = required_word(table, "title");
  experiment.description = table.word("description").value_or("");
  read_settings(table, "experiment", experiment.run, given);
  experiment.run.scene = scene_of_file(experiment.file, experiment.run.scene);
  experiment.scene_place = table.error_at("scene", "", "").place();
}

// Distances that are given, or a zoom with both its ends.
void read_zoom(const TomlTable& table, RunSettings& run) {
  read_settings(table, "zoom", run);
  for (const char* key : {"from", "to", "frames"}) {
    if (table.has(key) && table.has("distances"))
      throw table.error_at(key, "excludes distances", "give one or the other");
    if (!table.has(key) && !table.has("distances")) refuse_missing(table, key, experiments_document);
  }
  const ZoomSettings& zoom = run.view.zoom;
  if (zoom.frames > 0 && zoom.from == zoom.to)
    throw table.error_at("to", "is where the zoom starts", "let it differ from `from`");
}

// Refuses figures that the run will not have, before it starts.
void check_measures(const Expression& expression, const Experiment& experiment) {
  for (const Measure& measure : expression.measures()) check_measure(measure, experiment);
}

// Errors (usage): a claim whose source is not gpu_time has one; a word is empty.
std::vector<std::string> read_gpu_class(const TomlTable& table, ClaimSource source) {
  const std::optional<std::vector<std::string>> words = table.words("gpu_class");
  if (!words) return {};
  if (source != ClaimSource::gpu_time)
    throw table.error_at("gpu_class", "belongs to claims over times on a GPU", "add source = \"gpu_time\"");
  if (std::ranges::find(*words, "") != words->end())
    throw table.error_at("gpu_class", "has an empty word", "give words of the GPU's name, as [\"GeForce\"]");
  return *words;
}

Claim read_claim(const TomlTable& table, const Experiment& experiment) {
  const std::string text = required_word(table, "inequality");
  Inequality inequality = at_key(table, "inequality", [&] {
    Inequality parsed(text, fmt::format("`{:.200}`", text));
    check_measures(parsed.left, experiment);
    check_measures(parsed.right, experiment);
    return parsed;
  });
  Claim claim{.inequality = std::move(inequality)};
  claim.stated.name = required_word(table, "name");
  claim.stated.text = required_word(table, "text");
  claim.stated.source = read_word(table, "source", claim_source_words).value_or(ClaimSource::ours);
  claim.stated.inequality = text;
  claim.stated.expect = needed(table, "expect", read_word(table, "expect", verdict_words));
  claim.stated.reason = required_word(table, "reason");
  claim.stated.place = table.error_at("name", "", "").place();
  claim.gpu_class = read_gpu_class(table, claim.stated.source);
  return claim;
}

void read_claims(const TomlTable& root, Experiment& experiment) {
  for (const TomlTable& table : root.tables("claim", claim_keys)) {
    Claim claim = read_claim(table, experiment);
    const std::string& name = claim.stated.name;
    if (std::ranges::any_of(experiment.claims, [&](const Claim& other) { return other.stated.name == name; }))
      throw table.error_at("name", fmt::format("is `{:.80}` as in another claim", name), "name it otherwise");
    experiment.claims.push_back(std::move(claim));
  }
}

// The keys of [threshold] are expressions: any key may stand there.
void read_thresholds(const TomlTable& root, Experiment& experiment) {
  const std::vector<std::string> keys = root.keys_of("threshold");
  const auto table = root.table("threshold", keys);
  for (const std::string& key : keys) {
    const Expression written = at_key(*table, key, [&] { return Expression(key, fmt::format("`{:.200}`", key)); });
    const auto measures = written.measures();
    const bool each = std::ranges::find(measures, "*", &Measure::method) != measures.end();
    const double limit = *table->number(key, any_number);
    for (const std::string& method : each ? texts_of(experiment.run.methods) : std::vector<std::string>{""}) {
      const Expression measure = written.with_method(method);
      at_key(*table, key, [&] { check_measures(measure, experiment); });
      const std::string place = table->error_at(key, "", "").place();
      experiment.thresholds.push_back({.measure = measure, .limit = limit, .place = place});
    }
  }
}

void read_published(const TomlTable& table, Experiment& experiment) {
  const fs::path file = experiment.file.parent_path() / required_word(table, "file");
  const std::vector<std::string> figures = needed(table, "figures", table.words("figures"));
  const TomlTable root(file, {"paper", "note", "value"});
  std::vector<std::string> known;
  for (const TomlTable& value : root.tables("value", {"figure", "measure", "value", "unit", "note"})) {
    const std::string figure = required_word(value, "figure");
    known.push_back(figure);
    if (std::ranges::find(figures, figure) == figures.end()) continue;
    const double number = needed(value, "value", value.number("value", any_number));
    const std::string text = required_word(value, "measure");
    Expression measure = at_key(value, "measure", [&] {
      Expression parsed(text, fmt::format("`{:.200}`", text));
      check_measures(parsed, experiment);
      return parsed;
    });
    experiment.published.push_back({.printed = {.figure = figure,
                                                .measure = measure.text(),
                                                .unit = value.word("unit").value_or(""),
                                                .published = number,
                                                .note = value.word("note").value_or("")},
                                    .measure = std::move(measure)});
  }
  for (const std::string& figure : figures) {
    if (std::ranges::find(known, figure) != known.end()) continue;
    throw table.error_at("figures", fmt::format("names `{:.80}`, which {} does not have", figure, file.string()),
                         suggestion(figure, known));
  }
}

void read_footprints(const TomlTable& root, Experiment& experiment) {
  for (const TomlTable& table : root.tables("ndf", {"name", "footprint"})) {
    const std::string name = required_word(table, "name");
    if (name != file_stem(name) || name.front() == '.') {
      throw table.error_at("name", fmt::format("is `{:.80}`, which cannot name a folder", name),
                           "use letters and digits");
    }
    if (std::ranges::find(experiment.footprints, name, &NamedFootprint::name) != experiment.footprints.end()) {
      throw table.error_at("name", fmt::format("is `{:.80}` as of another footprint", name), "name it otherwise");
    }
    const auto sides = needed(table, "footprint", table.numbers("footprint", 4, {-1e6, 1e6}));
    const FootprintRect rect{{sides[0], sides[1]}, {sides[2], sides[3]}};
    at_key(table, "footprint", [&] { check_footprint(rect, ""); });
    experiment.footprints.push_back({.name = name, .rect = rect});
  }
}

// The methods of an experiment that have a figure, each once.
std::vector<const Quantity*> quantities_called(const std::string& name, const Experiment& experiment) {
  std::vector<const Quantity*> found;
  for (const MethodSpec& method : experiment.run.methods) {
    const Quantity* const quantity = find_quantity(find_method(method), name);
    if (quantity != nullptr) found.push_back(quantity);
  }
  return found;
}

NamedQuantity read_quantity(const TomlTable& table, const Experiment& experiment) {
  NamedQuantity named{
      required_word(table, "name"), required_word(table, "figure"), {}, table.word("material").value_or("")};
  if (std::ranges::find(experiment.quantities, named.name, &NamedQuantity::name) != experiment.quantities.end()) {
    throw table.error_at("name", fmt::format("is `{:.80}` as of another quantity", named.name), "name it otherwise");
  }
  const auto found = quantities_called(named.quantity, experiment);
  if (found.empty()) {
    throw table.error_at("figure", fmt::format("is `{:.80}`, which no method of the experiment has", named.quantity),
                         suggestion(named.quantity, quantity_names(experiment.run.methods)));
  }
  std::vector<std::string> names;
  for (const OptionSpec& spec : found.front()->parameters) names.push_back(spec.name);
  if (const auto parameters = table.table("parameters", names)) {
    for (const std::string& name : names) {
      if (const auto number = parameters->number(name, any_number)) named.parameters[name] = fmt::format("{}", *number);
    }
  }
  at_key(table, "parameters",
         [&] { return Options(found.front()->parameters, named.parameters, "figure " + named.quantity); });
  return named;
}

void read_quantities(const TomlTable& root, Experiment& experiment) {
  for (const TomlTable& table : root.tables("quantity", {"name", "figure", "parameters", "material"})) {
    experiment.quantities.push_back(read_quantity(table, experiment));
  }
}

std::optional<Crop> read_crop(const TomlTable& table, std::string_view key) {
  const auto sides = table.numbers(key, 4, {0, 1});
  if (!sides) return std::nullopt;
  const Crop crop{(*sides)[0], (*sides)[1], (*sides)[2], (*sides)[3]};
  if (crop[0] >= crop[2] || crop[1] >= crop[3]) {
    throw table.error_at(key, "is empty", "write it as [left, top, right, bottom], shares from 0 to 1");
  }
  return crop;
}

FigurePicture read_picture(const TomlTable& table, const Experiment& experiment) {
  FigurePicture picture;
  const std::string method = required_word(table, "method");
  if (method != "reference") {
    picture.method = at_key(table, "method", [&] { return select_method(method, texts_of(experiment.run.methods)); });
  }
  picture.frame = static_cast<std::size_t>(table.whole_number("frame", {0, most_frames}).value_or(0));
  const std::vector<double> distances = given_distances(experiment.run.view);
  if (!distances.empty() && picture.frame >= distances.size()) {
    throw table.error_at("frame", "does not exist", fmt::format("frames are 0 to {}", distances.size() - 1));
  }
  picture.label = table.word("label").value_or("");
  picture.crop = read_crop(table, "crop");
  return picture;
}

void read_figure(const TomlTable& table, Experiment& experiment) {
  if (const auto crop = read_crop(table, "crop")) experiment.figure.crop = *crop;
  experiment.figure.inset = read_crop(table, "inset");
  for (const TomlTable& row : table.tables("row", {"pictures"})) {
    std::vector<FigurePicture> pictures;
    for (const TomlTable& picture : row.tables("pictures", {"method", "frame", "label", "crop"})) {
      pictures.push_back(read_picture(picture, experiment));
    }
    if (pictures.empty()) refuse_missing(row, "pictures", experiments_document);
    experiment.figure.rows.push_back(std::move(pictures));
  }
  if (experiment.figure.rows.empty()) refuse_missing(table, "row", experiments_document);
}

// A file, over its presets where it names some.
TomlTable root_of(Experiment& experiment) {
  const std::vector<std::string> known = with(further_tables, {"experiment"});
  TomlTable root(experiment.file, known);
  const auto head = root.table("experiment", with(setting_keys("experiment"), head_keys));
  const auto name = head ? head->word("presets") : std::nullopt;
  if (!name) return root;
  if (head->has("members")) throw head->error_at("presets", "excludes `members`", "move it into one of them");
  const fs::path file = experiment.file.parent_path() / *name;
  std::error_code unknown;
  if (!fs::is_regular_file(file, unknown))
    throw head->error_at("presets", fmt::format("names {}, which is not a file", file.string()),
                         "write its path from the experiment's folder");
  (void)TomlTable(file, preset_tables).table("experiment", setting_keys("experiment"));
  experiment.presets = file;
  return TomlTable::over_presets(experiment.file, file, known, joined_tables);
}

// An experiment that is made of others has nothing but their names.
std::vector<fs::path> read_members(const TomlTable& root, const TomlTable& head, const fs::path& folder) {
  for (const std::string& key : setting_keys("experiment")) {
    if (head.has(key)) throw head.error_at(key, "excludes `members`", "move it into one of them");
  }
  for (const std::string& key : further_tables) {
    if (root.has(key)) throw root.error_at(key, "excludes `members`", "move it into one of them");
  }
  std::vector<fs::path> members;
  const std::vector<std::string> names = head.words("members").value();
  for (const std::string& name : names) {
    const fs::path member = folder / (name + ".toml");
    std::error_code unknown;
    if (!fs::is_regular_file(member, unknown)) {
      throw head.error_at("members", fmt::format("names `{:.80}`, which is not a file next to it", name),
                          suggestion(name, list_experiments(folder)));
    }
    if (std::ranges::find(members, member) != members.end()) {
      throw head.error_at("members", fmt::format("names `{:.80}` twice", name), "name each once");
    }
    members.push_back(member);
  }
  return members;
}

// The distances at which an experiment looks at one of its scenes.
struct SceneDistances {
  std::string name;  // as an axis has it; empty without one
  std::vector<double> distances;
};

// Errors (usage) of the scene, in the name of the line that names it.
SceneDistances distances_over_scene(const Experiment& experiment, const std::string& name) {
  try {
    (void)read_scene(experiment.run.scene, experiment.run.scene_library, experiment.run.overrides);
    return {.name = name, .distances = distances_of(experiment)};
  } catch (const Error& error) {
    throw error.within(experiment.scene_place);
  }
}

std::vector<SceneDistances> distances_by_scene(const Experiment& experiment) {
  const auto axis = std::ranges::find(experiment.axes, "scene", &Axis::key);
  if (axis == experiment.axes.end()) return {distances_over_scene(experiment, {})};
  std::vector<SceneDistances> scenes;
  for (const std::string& name : axis->values) {
    Experiment of_scene = experiment;
    of_scene.run.scene = scene_of_file(experiment.file, name);
    scenes.push_back(distances_over_scene(of_scene, name));
  }
  return scenes;
}

// Each measure against the distances of all scenes that it is over.
void check_at_distances(const Expression& expression, const Experiment& experiment,
                        const std::vector<SceneDistances>& scenes) {
  for (const Measure& measure : expression.measures()) {
    std::vector<double> distances;
    std::size_t frames = 0;
    for (const SceneDistances& scene : scenes) {
      if (!measure.takes(Selector::scene, scene.name)) continue;
      std::ranges::copy(scene.distances, std::back_inserter(distances));
      frames = std::max(frames, scene.distances.size());
    }
    try {
      check_distance(measure, distances, frames);
    } catch (const Error& error) {
      throw error.within(experiment.file.string());
    }
  }
}

void check_frames(const Experiment& experiment, std::size_t frames) {
  for (const auto& row : experiment.figure.rows) {
    for (const FigurePicture& picture : row) {
      if (picture.frame < frames) continue;
      throw Error(ErrorKind::usage, experiment.file.string(), fmt::format("[figure] shows frame {}", picture.frame),
                  "the scene's zoom path is shorter: give [zoom] distances, or show an earlier frame");
    }
  }
}

}  // namespace

fs::path find_experiment(const std::string& experiment, const fs::path& folder) {
  std::vector<fs::path> candidates{experiment, experiment + ".toml"};
  const bool plain_name = !experiment.empty() && fs::path(experiment) == fs::path(experiment).filename();
  if (plain_name) candidates.insert(candidates.begin(), folder / (experiment + ".toml"));
  for (const fs::path& candidate : candidates) {
    std::error_code unknown;
    if (fs::is_regular_file(candidate, unknown)) return candidate;
  }
  throw Error(ErrorKind::usage, experiment, "no such experiment or file",
              suggestion(experiment, list_experiments(folder)));
}

std::vector<std::string> list_experiments(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; entry != end; entry.increment(error)) {
    if (entry->path().extension() == ".toml") names.push_back(entry->path().stem().string());
  }
  std::ranges::sort(names);
  return names;
}

Experiment read_experiment(const fs::path& file) {
  Experiment experiment;
  experiment.name = file.stem().string();
  experiment.file = file;
  experiment.run.method_folder = file.parent_path();
  const TomlTable root = root_of(experiment);
  const auto head = root.table("experiment", with(setting_keys("experiment"), head_keys));
  if (!head) refuse_missing(root, "experiment", experiments_document);
  if (head->has("members")) {
    experiment.title = required_word(*head, "title");
    experiment.description = head->word("description").value_or("");
    experiment.members = read_members(root, *head, file.parent_path());
    return experiment;
  }
  read_head(*head, given_by_matrix(root, head, "experiment"), experiment);
  if (const auto zoom = root.table("zoom", setting_keys("zoom"))) read_zoom(*zoom, experiment.run);
  if (const auto camera = root.table("camera", camera_keys())) experiment.run.overrides.camera = read_camera(*camera);
  const auto reference = root.table("reference", setting_keys("reference"));
  (void)given_by_matrix(root, reference, "reference");
  if (reference) read_settings(*reference, "reference", experiment.run);
  read_matrix(root, experiment);
  read_footprints(root, experiment);
  read_quantities(root, experiment);
  if (const auto published = root.table("published", {"file", "figures"})) read_published(*published, experiment);
  read_claims(root, experiment);
  read_region(root, experiment);
  read_thresholds(root, experiment);
  if (const auto figure = root.table("figure", {"crop", "inset", "row"})) read_figure(*figure, experiment);
  return experiment;
}

std::vector<double> distances_of(const Experiment& experiment) {
  const RunSettings& run = experiment.run;
  std::vector<double> given = given_distances(run.view);
  if (!given.empty()) return given;
  Scene with_distances;  // all that a zoom path needs of a scene
  with_distances.distances = read_scene(run.scene, run.scene_library, run.overrides).settings.scene.distances;
  return run_distances(run.view, with_distances);
}

void check_against_scenes(const Experiment& experiment) {
  const std::vector<SceneDistances> scenes = distances_by_scene(experiment);
  const auto check = [&](const Expression& expression) { check_at_distances(expression, experiment, scenes); };
  for (const Claim& claim : experiment.claims) {
    check(claim.inequality.left);
    check(claim.inequality.right);
  }
  for (const Threshold& threshold : experiment.thresholds) check(threshold.measure);
  for (const PublishedValue& published : experiment.published) check(published.measure);
  for (const SceneDistances& scene : scenes) check_frames(experiment, scene.distances.size());
}

}  // namespace footprint
