// The settings of a history: of a run (`--history 24`), or of one of its methods (`toksvig:history=24`).
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/settings/setting.hpp"

namespace footprint {

/// A setting of histories.
struct HistoryOption {
  std::string_view name;  ///< of the option of a method, and of the key of a file
  SettingType type;
  std::string_view help;
};

[[nodiscard]] const std::array<HistoryOption, 4>& history_options();

/// Methods, each of which may have options of its own history. Errors (usage): those of parse_known_methods, or a value
/// that its option does not take.
[[nodiscard]] std::vector<MethodSpec> parse_methods_with_histories(const std::string& text,
                                                                   const std::filesystem::path& folder = {});

/// The history of a method's frames.
/// common: that of the run's methods; options of the method's own replace it.
[[nodiscard]] HistorySettings history_of(const MethodSpec& method, const HistorySettings& common);

/// The number of a run's methods whose images are histories.
[[nodiscard]] std::size_t count_histories(const RunSettings& run);

}  // namespace footprint
