// Reads [environment], refuses the keys of other kinds, and makes the map that the settings name.
#include "renderer/scene/settings/environment.hpp"

#include <cmath>
#include <numbers>

#include "renderer/core/error.hpp"
#include "renderer/core/toml_table.hpp"

namespace footprint {
namespace {

// The keys that one kind alone has.
struct OwnKeys {
  EnvironmentKind kind;
  std::vector<std::string> keys;
};

const std::vector<OwnKeys>& own_keys() {
  static const std::vector<OwnKeys> keys{{EnvironmentKind::file, {"file", "files", "package"}},
                                         {EnvironmentKind::constant, {"color"}},
                                         {EnvironmentKind::sky, {"sun_direction"}}};
  return keys;
}

EnvironmentKind read_kind(const TomlTable& table) {
  const auto choice = table.choice("kind", {"file", "constant", "sky"});
  const EnvironmentKind kind = choice ? static_cast<EnvironmentKind>(*choice) : EnvironmentKind::file;
  for (const OwnKeys& own : own_keys()) {
    for (const std::string& key : own.keys) {
      if (own.kind != kind && table.has(key))
        throw table.error_at(key, "does not belong to an environment of this kind", "leave it out, or change `kind`");
    }
  }
  return kind;
}

void read_files(const TomlTable& table, const std::filesystem::path& folder, EnvironmentSettings& settings) {
  if (table.has("file") == table.has("files")) {
    throw table.error_at("file", "or `files` must be given, and only one of them",
                         R"(name the image, or give kind = "constant" or "sky")");
  }
  const auto names = table.has("file") ? std::vector{*table.word("file")} : *table.words("files");
  for (const std::string& name : names) settings.candidates.push_back(folder / name);
  settings.package = table.word("package").value_or("");
}

void read_sky(const TomlTable& table, SkySettings& sky) {
  const auto sun = table.numbers("sun_direction", 3, {-1e9, 1e9});
  if (!sun) return;
  sky.sun_direction = {(*sun)[0], (*sun)[1], (*sun)[2]};
  const bool below = sky.sun_direction.y < 0.0;
  if (below || glm::length(sky.sun_direction) < 1e-9) {
    throw table.error_at("sun_direction", below ? "points below the horizon" : "has no length",
                         "give a direction towards the sun such as [0.4, 0.6, 0.7]");
  }
}

Environment load_first(const EnvironmentSettings& settings, std::vector<std::string>& warnings) {
  std::error_code ignored;  // what cannot be asked cannot be opened either
  for (const auto& candidate : settings.candidates) {
    if (std::filesystem::exists(candidate, ignored)) return load_environment(candidate, warnings);
  }
  std::string tried;
  for (const auto& candidate : settings.candidates) tried += (tried.empty() ? "" : ", ") + candidate.string();
  throw Error(ErrorKind::usage, tried, "there is no such environment",
              settings.package.empty() ? "check the path" : "install the package " + settings.package);
}

Environment unscaled(const EnvironmentSettings& settings, std::vector<std::string>& warnings) {
  switch (settings.kind) {
    case EnvironmentKind::constant:
      return constant_environment(settings.color);
    case EnvironmentKind::sky:
      return sky_environment(settings.sky);
    case EnvironmentKind::file:
      break;
  }
  return load_first(settings, warnings);
}

}  // namespace

const std::vector<std::string>& environment_keys() {
  static const std::vector<std::string> keys = [] {
    std::vector<std::string> all{"kind", "intensity", "rotation_degrees"};
    for (const OwnKeys& own : own_keys()) all.insert(all.end(), own.keys.begin(), own.keys.end());
    return all;
  }();
  return keys;
}

EnvironmentSettings read_environment(const TomlTable& table, const std::filesystem::path& folder) {
  EnvironmentSettings settings;
  settings.kind = read_kind(table);
  if (settings.kind == EnvironmentKind::file) read_files(table, folder, settings);
  if (settings.kind == EnvironmentKind::sky) read_sky(table, settings.sky);
  if (const auto color = table.numbers("color", 3, {0.0, 1.0}))
    settings.color = {(*color)[0], (*color)[1], (*color)[2]};
  settings.intensity = table.number("intensity", {0.0, 1e6}).value_or(settings.intensity);
  settings.rotation_degrees = table.number("rotation_degrees", {-360.0, 360.0}).value_or(settings.rotation_degrees);
  return settings;
}

Environment make_environment(const EnvironmentSettings& settings, std::vector<std::string>& warnings) {
  Environment environment = unscaled(settings, warnings);
  environment.rotation = static_cast<float>(settings.rotation_degrees * std::numbers::pi / 180.0);
  if (settings.intensity == 1.0) return environment;
  Image scaled = *environment.radiance;
  for (float& value : scaled.texels) value = static_cast<float>(value * settings.intensity);
  environment.radiance = std::make_shared<const Image>(std::move(scaled));
  return environment;
}

}  // namespace footprint
