// `footprint edit`: small-scale geometry that changes every frame, with the time of each stage up to the picture.
#include "experiments/studies/edit.hpp"
#include "app/subcommand.hpp"

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
        ->check(within(1, 10000))
        ->capture_default_str();
    add_output_folder(command, output, "Folder for edit.json, edit.csv, table.md, images/");
  }

  std::vector<std::string> sets;
  int frames = EditSettings{}.frames;
  std::string output = "out";
};

EditSettings settings_from(const EditArguments& arguments) {
  EditSettings settings{.run = arguments.settings(), .frames = arguments.frames};
  for (const std::string& set : arguments.sets) settings.sweeps.push_back(parse_sweep(set));
  if (settings.run.methods.front().name == "reference")
    throw Error(ErrorKind::usage, "--method", "`reference` has no precompute to time", "name a method");
  return settings;
}

void run_edit_command(const EditArguments& arguments) {
  const EditSettings settings = settings_from(arguments);
  ProgressDisplay display(progress_style(arguments.quiet));
  const auto [run, path, lost] = write_whole(arguments.output, [&](OutputFolder& folder) {
    EditRun edits = run_edit(settings, folder.run(), display.callback());
    keep_results(edits, folder, write_edit, "edit.json");
    return edits;
  });
  display.finish();
  write_output(fmt::format("{}\nframes: {}\n", edit_table(run), (path / "images").string()));
  throw_first({lost});
}

}  // namespace

void add_edit_command(CLI::App& app) {
  add_command(app, "edit", "Edit small-scale geometry or the base BRDF frame by frame and time each stage",
              edit_examples, run_edit_command);
}

}  // namespace footprint
