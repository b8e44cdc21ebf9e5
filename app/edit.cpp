// `footprint edit`: small-scale geometry that changes every frame, with the time of each stage up to the picture.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "app/commands.hpp"
#include "app/messages.hpp"
#include "app/output.hpp"
#include "app/run_options.hpp"
#include "experiments/studies/edit.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/files.hpp"

namespace footprint {
namespace {

constexpr const char* edit_examples =
    R"(KIND.PARAMETER is a parameter of the scene's [microgeometry] (docs/reference/scenes.md) or brdf.PARAMETER:
roughness, exponent, alpha, kappa, specular, metallic, or measured with two MERL files. The folder gets
images/METHOD_NNNN (.exr and .png), edit.json, edit.csv and table.md.

Examples:
  footprint edit woven_cloth --set weave.warp_width=0.1:0.5 --frames 10 -o out
  footprint edit woven_cloth --set weave.warp_width=0.9:0.3 --set weave.height=0.1 --method iwasaki_sg:j=4 -o out
  footprint edit ribbed_plane --set brdf.exponent=10:1000 --method xu_vmf -o out)";

struct EditArguments : RunArguments {
  explicit EditArguments(CLI::App& command) : RunArguments(command) {
    add_value(command, "--set", sets, "KIND.PARAMETER=FROM:TO",
              "Change a parameter from FROM to TO, or set it to VALUE; may be repeated")
        ->required()
        ->expected(1)
        ->take_all();
    command.add_option("--frames", frames, "Number of edits, at equal steps of the parameters")
        ->check(CLI::Range(1, 10000))
        ->capture_default_str();
    add_output_folder(command, output, "Folder for edit.json, edit.csv, table.md, images/");
    add_quiet_flag(command, quiet);
  }

  std::vector<std::string> sets;
  int frames = EditSettings{}.frames;
  std::string output = "out";
};

EditSettings settings_from(const EditArguments& arguments) {
  EditSettings settings{.run = arguments.run.settings(), .sweeps = {}, .frames = arguments.frames};
  for (const std::string& set : arguments.sets) settings.sweeps.push_back(parse_sweep(set));
  if (settings.run.methods.front().name == "reference")
    throw Error(ErrorKind::usage, "--method", "`reference` has no precompute to time", "name a method");
  return settings;
}

EditRun edit_into(OutputFolder& folder, const EditSettings& settings, const Progress& progress) {
  EditRun run = run_edit(settings, folder.path(), progress);
  keep_results(run, folder, write_edit, "edit.json");
  return run;
}

void run_edit_command(const EditArguments& arguments) {
  const EditSettings settings = settings_from(arguments);
  ProgressDisplay display(progress_style(arguments.quiet));
  const auto [run, path] = write_whole(
      arguments.output, [&](OutputFolder& folder) { return edit_into(folder, settings, display.callback()); });
  display.finish();
  write_output(fmt::format("{}\nframes: {}\n", edit_table(run), (path / "images").string()));
}

}  // namespace

void add_edit_command(CLI::App& app) {
  add_command(app, "edit", "Edit small-scale geometry or the base BRDF frame by frame and time each stage",
              edit_examples, run_edit_command);
}

}  // namespace footprint
