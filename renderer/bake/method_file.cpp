// Reads the head of a method's file, and bakes the inputs that it lists.
#include "renderer/bake/method_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>

#include "renderer/bake/material_maps.hpp"
#include "renderer/bake/normal_chain.hpp"
#include "renderer/bake/slope_moments.hpp"
#include "renderer/core/bytes.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/names.hpp"
#include "renderer/core/toml_table.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/image/mipmap.hpp"
#include "renderer/scene/settings/toml_values.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t largest_file = 256U << 10U;
constexpr int largest_image = 8192;  // texels per side
constexpr NumberRange any_number{-1e30, 1e30};
constexpr std::string_view document = "docs/guides/method-files.md";

struct Job {
  const Material& material;
  const Options& options;
  const EffectSet& effects;
  Storage storage;
};

Prefiltered mean_normal(const Job& job) { return bake_mean_normal(job.material, job.storage, job.effects); }

Prefiltered mean_lobe(const Job& job) {
  if (!has(job.effects, Effect::roughness_variation)) return {};
  if (is_coarse(job.storage)) {
    throw Error(ErrorKind::usage, "mean_lobe",
                fmt::format("storage={} cannot store lobe parameters", storage_name(job.storage)),
                "give storage=fp32 or storage=fp16");
  }
  return {.textures = {make_texture("mean_lobe", mip_chain(lobe_parameter_map_of(job.material)), job.storage,
                                    roughness_coordinates(job.material))}};
}

// The texture of the mean that `averages` asks for; empty for a mean of variances.
Prefiltered averaged_roughness(const Job& job) {
  const std::string& averages = job.options.word("averages");
  if (averages != "variance" && job.options.word("roughness") == "moments") {
    throw Error(ErrorKind::usage, "averages=" + averages,
                "excludes roughness=moments, whose moments contain each texel's own variance",
                "give roughness=stretched or roughness=shading");
  }
  if (averages == "roughness") return bake_mean_roughness(job.material, job.storage, job.effects);
  return averages == "lobe" ? mean_lobe(job) : Prefiltered{};
}

// The diffuse term reads the mean normal; of detail layers only the slopes are stored.
Prefiltered slope_moments(const Job& job) {
  const bool mean_normal = has(job.effects, Effect::diffuse) && !has(job.effects, Effect::normal_layers);
  const bool scalar = job.options.word("variant") == "clean";
  Prefiltered roughness = averaged_roughness(job);
  Prefiltered out = bake_slopes(job.material, job.options, job.effects,
                                {.variant = scalar ? SlopeVariant::scalar : SlopeVariant::full,
                                 .mean_normal = mean_normal,
                                 .lobe_variance = job.options.word("averages") == "variance"});
  append(out.textures, std::move(roughness.textures));
  return out;
}

OptionSpec slope_averages_option() {
  return word_option("averages", {"variance", "roughness", "lobe"},
                     "What of a varying base lobe the mip chain averages: its slope variance, as moments do; the "
                     "perceptual roughness, as a texture stores it; or the lobe's own parameter (exponent, alpha, "
                     "kappa).");
}

Prefiltered finest_roughness(const Job& job) {
  if (!has(job.effects, Effect::roughness_variation)) return {};
  return {.textures = {make_level_texture("finest_roughness", roughness_map_of(job.material),
                                          is_block(job.storage) ? Storage::bc4 : job.storage,
                                          roughness_coordinates(job.material))}};
}

Prefiltered finest_normal(const Job& job) {
  if (!has(job.effects, Effect::normal_variation)) return {};
  const Storage storage = job.storage == Storage::unorm8 ? Storage::fp16 : job.storage;  // bytes have no sign
  return {.textures = {make_level_texture("finest_normal", normal_map_of(job.material), storage,
                                          normal_coordinates(job.material))}};
}

// What a head may list under `reads`, and the options that come with it.
struct Input {
  std::string_view name;
  Prefiltered (*bake)(const Job& job);
  std::vector<OptionSpec> (*options)();
};

std::vector<OptionSpec> storage_alone() { return {storage_option()}; }
std::vector<OptionSpec> any_blocks() { return {block_storage_option(true)}; }

constexpr std::array<Input, 9> inputs{
    {{"mean_normal", mean_normal, [] { return std::vector{block_storage_option(false)}; }},
     {"mean_direction", mean_normal, any_blocks},  // the same texture, of which a module ignores the length
     {"lobe_variance",
      [](const Job& job) {
        return bake_lobe_variance(job.material, job.storage, job.effects, roughness_mean(job.options));
      },
      [] {
        return std::vector{block_storage_option(false), roughness_mean_option()};
      }},
     {"slope_moments", slope_moments,
      [] {
        return std::vector{float_storage_option(), slope_roughness_option(), steepest_slope_option(),
                           slope_variant_option(), slope_averages_option()};
      }},
     {"mean_roughness", [](const Job& job) { return bake_mean_roughness(job.material, job.storage, job.effects); },
      any_blocks},
     {"mean_lobe", mean_lobe, any_blocks},
     {"finest_normal", finest_normal, storage_alone},
     {"finest_roughness", finest_roughness, any_blocks},
     {"screen_derivatives", [](const Job&) { return Prefiltered{}; }, [] { return std::vector<OptionSpec>{}; }}}};

// An input that is baked if an option has a word; an empty option: always.
struct Read {
  const Input* input;
  std::string option{}, word{};
};

struct Head {
  MethodInfo info;
  std::vector<Read> reads;
  std::vector<PrefilteredTexture> images;
};

bool is_identifier(std::string_view text) {
  return !text.empty() && text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string_view::npos &&
         std::isdigit(static_cast<unsigned char>(text.front())) == 0;
}

std::string required_word(const TomlTable& table, std::string_view key) {
  std::optional<std::string> word = table.word(key);
  if (!word || word->empty()) refuse_missing(table, key, document);
  return *std::move(word);
}

// A name that shaders use.
std::string identifier(const TomlTable& table) {
  std::string name = required_word(table, "name");
  if (is_identifier(name)) return name;
  throw table.error_at("name", fmt::format("is `{:.80}`", name), "use lower-case letters, digits and `_`");
}

OptionSpec read_option(const TomlTable& table) {
  const std::string name = identifier(table);
  const std::string meaning = required_word(table, "meaning");
  if (const auto choices = table.words("choices")) {
    for (const char* key : {"default", "range", "whole"})
      if (table.has(key)) throw table.error_at(key, "excludes `choices`, whose first is the default", "remove it");
    if (std::ranges::all_of(*choices, [](const std::string& word) { return is_identifier("_" + word); }))
      return word_option(name, *choices, meaning);
    throw table.error_at("choices", "has a word that cannot be a flag", "use lower-case letters, digits and `_`");
  }
  const std::vector<double> range = required(table, "range", table.numbers("range", 2, any_number), document);
  const double low = range[0], high = range[1];
  if (low > high) throw table.error_at("range", "is empty", "write the smaller number first");
  const double value = required(table, "default", table.number("default", {low, high}), document);
  OptionSpec option = number_option(name, value, low, high, meaning);
  option.integer = table.boolean("whole").value_or(false);
  return option;
}

// Adds the options that an input brings. Of two choices of storage the smaller serves both inputs.
void add_options(const Input& input, std::vector<OptionSpec>& options) {
  for (OptionSpec& option : input.options()) {
    const auto known = std::ranges::find(options, option.name, &OptionSpec::name);
    if (known == options.end()) {
      options.push_back(std::move(option));
    } else if (option.choices.size() < known->choices.size()) {
      *known = std::move(option);
    }
  }
}

// "INPUT" or "INPUT if OPTION_WORD".
Read read_input(const TomlTable& head, const std::string& text) {
  const std::size_t condition = text.find(" if ");
  const std::string name = text.substr(0, condition);
  const auto* const input = std::ranges::find(inputs, name, &Input::name);
  if (input == inputs.end()) {
    std::vector<std::string> known;
    for (const Input& each : inputs) known.emplace_back(each.name);
    throw head.error_at("reads", fmt::format("has `{:.80}`, which is not an input", name), suggestion(name, known));
  }
  if (condition == std::string::npos) return {input};
  return {.input = input, .option = text.substr(condition + 4)};  // split once the options are known
}

void split_condition(const TomlTable& head, const std::vector<OptionSpec>& options, Read& read) {
  if (read.option.empty()) return;
  for (const OptionSpec& option : options) {
    for (const std::string& choice : option.choices) {
      if (option.name + "_" + choice != read.option) continue;
      read.option = option.name;
      read.word = choice;
      return;
    }
  }
  throw head.error_at("reads", fmt::format("has the condition `{:.80}`, which no option sets", read.option),
                      "write OPTION_WORD of a [[option]] with choices");
}

EffectSet honoured(const TomlTable& head) {
  EffectSet effects = map_effects_but({});
  const std::vector<std::string> names = effect_names(EffectSet{}.set());
  for (const std::string& name : head.words("leaves_out").value_or(std::vector<std::string>{}))
    effects.reset(at_key(head, "leaves_out", [&] { return find_word(names, name, "effect", ""); }));
  return effects;
}

PrefilteredTexture read_named_image(const TomlTable& table, const fs::path& folder) {
  const std::string name = identifier(table);
  const fs::path file = folder / required_word(table, "file");
  const std::size_t filter =
      required(table, "filter", table.choice("filter", {"trilinear", "linear", "nearest"}), document);
  Image image = at_key(table, "file", [&] { return read_image(file, Transfer::linear, largest_image); });
  if (!std::ranges::all_of(image.texels, [](float value) { return std::isfinite(value); }))
    throw table.error_at("file", "has values that are not finite", "correct the image");
  if (filter == 0) return make_texture(name, mip_chain(std::move(image)), Storage::fp32, {});
  PrefilteredTexture texture = make_level_texture(name, std::move(image), Storage::fp32, {});
  texture.filter = filter == 1 ? TextureFilter::linear : TextureFilter::nearest;
  return texture;
}

void read_options(const TomlTable& table, Head& head) {
  for (const TomlTable& row : table.tables("option", {"name", "meaning", "default", "range", "whole", "choices"})) {
    OptionSpec option = read_option(row);
    if (std::ranges::find(head.info.options, option.name, &OptionSpec::name) != head.info.options.end())
      throw row.error_at("name", fmt::format("is `{}`, which comes with `reads` or is given twice", option.name),
                         "name it otherwise");
    head.info.options.push_back(std::move(option));
  }
}

Head read_head(const TomlTable& table, const fs::path& folder) {
  Head head;
  head.info.name = identifier(table);
  head.info.summary = required_word(table, "summary");
  head.info.paper = table.word("paper").value_or("");
  head.info.honours = honoured(table);
  for (const std::string& text : table.words("reads").value_or(std::vector<std::string>{})) {
    head.reads.push_back(read_input(table, text));
    add_options(*head.reads.back().input, head.info.options);
    if (head.reads.back().input->name == "screen_derivatives") head.info.screen_derivatives = true;
  }
  read_options(table, head);
  for (Read& read : head.reads) split_condition(table, head.info.options, read);
  for (const TomlTable& row : table.tables("image", {"name", "file", "filter"}))
    head.images.push_back(read_named_image(row, folder));
  return head;
}

// The comment in front of everything, whose lines are those of the file.
TomlTable head_of(const ShaderModule& module) {
  const std::size_t end = module.text.find("*/");
  if (!module.text.starts_with("/*") || end == std::string_view::npos)
    throw Error(ErrorKind::usage, fmt::format("{}:1", module.file), "does not start with a head `/* ... */`",
                fmt::format("see {}", document));
  return {fs::path(module.file),
          module.text.substr(2, end - 2),
          {"name", "summary", "paper", "reads", "leaves_out", "option", "image"}};
}

Prefiltered baked(const Head& head, const Material& material, const Options& options, const EffectSet& effects) {
  const bool stores = options.all().contains("storage");
  const Job job{material, options, effects, stores ? parse_storage(options.word("storage")) : Storage::fp32};
  Prefiltered out;
  for (const Read& read : head.reads) {
    if (!read.option.empty() && options.word(read.option) != read.word) continue;
    Prefiltered more = read.input->bake(job);
    append(out.textures, std::move(more.textures));
    std::ranges::move(more.notes, std::back_inserter(out.notes));
  }
  append(out.textures, head.images);
  return out;
}

Method made(Head head, ShaderModule module) {
  MethodInfo info = head.info;
  return {.info = std::move(info),
          .precompute = [head = std::make_shared<const Head>(std::move(head))](
                            const Material& material, const Options& options, const EffectSet& effects,
                            const Progress& /*progress*/) { return baked(*head, material, options, effects); },
          .shader = std::move(module)};
}

// The text of a file, with the line ends of Unix.
std::string text_of(const std::string& name, const fs::path& file) {
  const auto bytes = [&] {
    try {
      return read_file_bytes(file, largest_file);
    } catch (const Error& error) {
      throw Error(error.kind(), name, error.message(), error.hint());
    }
  }();
  std::string text(bytes.begin(), bytes.end());
  std::erase(text, '\r');
  const auto strange =
      std::ranges::find_if(text, [](char c) { return static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t'; });
  if (strange == text.end()) return text;
  throw Error(ErrorKind::usage, fmt::format("{}:{}", name, std::count(text.begin(), strange, '\n') + 1),
              fmt::format("byte {:#04x} is not text", static_cast<unsigned char>(*strange)), "give a GLSL file");
}

// The file's text, which the method's module refers to.
struct MethodOfFile {
  std::string name, text;
  Method method;
};

}  // namespace

Method method_of(const ShaderModule& module) { return made(read_head(head_of(module), {}), module); }

std::shared_ptr<const Method> read_method_file(std::string_view name, const fs::path& folder) {
  auto owner = std::make_shared<MethodOfFile>();
  owner->name = name;
  const fs::path file = folder / owner->name;
  owner->text = text_of(owner->name, file);
  const ShaderModule module{.file = owner->name, .text = owner->text};
  Head head = read_head(head_of(module), file.parent_path());
  ContentHash content;
  content.add(owner->text);
  for (const PrefilteredTexture& image : head.images) content.add(fmt::format("{}", texel_content(image)));
  owner->method = made(std::move(head), module);
  owner->method.file_content = content.hex();
  return {owner, &owner->method};
}

}  // namespace footprint
