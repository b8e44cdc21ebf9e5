// The form of `--help`: two columns, wrapped to a terminal's width.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <string>

namespace footprint {

/// Prints an option as "-o, --output DIR", its meaning, its range and its default.
class HelpFormat : public CLI::Formatter {
 public:
  static constexpr std::size_t width = 100;

  HelpFormat();

  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
  std::string make_description(const CLI::App* app) const override;
  std::string make_usage(const CLI::App* app, std::string name) const override;
  std::string make_option(const CLI::Option* option, bool is_positional) const override;
  std::string make_subcommand(const CLI::App* command) const override;
};

}  // namespace footprint
