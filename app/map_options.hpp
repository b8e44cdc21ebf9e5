// The argument MAP of subcommands that read normals: stored normals, or heights by --height-scale.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "app/number_check.hpp"
#include "renderer/scene/normal_file.hpp"

namespace footprint {

/// The options of a subcommand that say how its MAP is read. Must outlive the parsing and running of the subcommand.
class MapOptions {
 public:
  void add_to(CLI::App& command) {
    auto* scale =
        command.add_option("--height-scale", scale_, "MAP stores heights; the height of value 1 in widths of the map")
            ->type_name("X")
            ->check(within(-100.0, 100.0));
    command.add_option("--slope-filter", filter_, "Derivative of the heights: central, sobel or scharr")
        ->type_name("WORD")
        ->needs(scale)
        ->capture_default_str();
  }

  /// The file with these options. Throws Error (usage): an unknown filter.
  [[nodiscard]] NormalFile of(const std::string& path) const {
    NormalFile file{.path = path};
    const SlopeFilter filter = word_value(slope_filters, filter_, "slope filter", "--slope-filter");
    if (!scale_) return file;
    file.scale = *scale_;
    file.heights = HeightSettings{.filter = filter};
    return file;
  }

 private:
  std::optional<double> scale_;
  std::string filter_ = "central";
};

}  // namespace footprint
