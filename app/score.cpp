// `footprint score`: images of any origin against a reference.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/commands.hpp"
#include "app/messages.hpp"
#include "app/number_check.hpp"
#include "app/output.hpp"
#include "app/progress_display.hpp"
#include "app/run_options.hpp"
#include "experiments/studies/run_info.hpp"
#include "experiments/studies/score.hpp"
#include "experiments/studies/stage.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/files.hpp"
#include "renderer/core/names.hpp"
#include "renderer/image/false_color.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/scene/assembly/load_scene.hpp"
#include "results/report/markup.hpp"
#include "results/report/report.hpp"

namespace footprint {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* score_examples =
    "IMAGE is an EXR or Radiance HDR of linear radiance, or a PNG, JPEG, TIFF, BMP or WebP of displayed colours "
    "(sRGB),\n"
    "for which measures of radiance are left out. Two images are scored separately, then compared pixel by pixel.\n"
    "\n"
    "Examples:\n"
    "  footprint score engine.exr --reference model.gltf --spp 256\n"
    "  footprint score engine.exr --reference reference.exr\n"
    "  footprint score before.png after.png --reference reference.exr --exposure 0.5 -o score\n"
    "  footprint score a.exr b.exr --reference out/images/d1_reference.exr --mask object.png -o score\n"
    "\n"
    "If `footprint compare` wrote the reference, its exposure and standard error are used.";

constexpr int scoring_pictures = 6;  // mean, squares, two halves, error, and one to spare

struct ScoreArguments {
  explicit ScoreArguments(CLI::App& command) : run(command) {}

  RunOptions run;
  std::vector<std::string> pictures;
  std::string reference, standard_error, mask, output;
  double pixels_per_degree = flip_pixels_per_degree;
  bool quiet = false;
};

// The reference of a score.
struct Reference {
  Image picture;
  Image standard_error;  // empty: not known
  float exposure = 1.0F;
};

// Whether the name is a scene's: that of a folder, or of a file of these kinds.
bool names_a_scene(const std::string& reference) {
  const std::string extension = lower_extension(reference);
  constexpr std::array<std::string_view, 4> scenes{".toml", ".gltf", ".glb", ".obj"};
  return extension.empty() || std::ranges::find(scenes, extension) != scenes.end();
}

// The reference of a scene, in the size of the first image.
Reference rendered_reference(const ScoreArguments& arguments) {
  if (!arguments.standard_error.empty())
    throw Error(ErrorKind::usage, "--standard-error", "the reference of a scene has its own", "leave it out");
  RunSettings run = arguments.run.settings();
  run.scene = arguments.reference;
  const Image first = read_image(arguments.pictures.front(), Transfer::linear);
  run.view.size = {first.width, first.height};
  ProgressDisplay display(progress_style(arguments.quiet));
  ProgressParts parts(display.callback(), 3);
  const Stage stage(load_scene(run.scene, run.scene_library, run.overrides), run, parts.next(1, ""), scoring_pictures);
  Supersampled drawn = stage.reference().render(stage.view(run.view.distances.front()), run.reference.spp,
                                                run.reference.seed, parts.next(2, ""));
  stage.context().check("rendering the reference");
  display.finish();
  write_scene_notes(stage.scene(), arguments.quiet);
  const float exposure = choose_exposure(run.view.exposure, stage.scene(), drawn.mean).factor;
  return {std::move(drawn.mean), drawn.halves ? std::move(drawn.standard_error) : Image(), exposure};
}

Image read_standard_error(const std::string& file) {
  Image error = read_image(file, Transfer::linear);
  if (error.channels >= 3) return error;
  throw Error(ErrorKind::usage, file, fmt::format("it has {} channels", error.channels),
              "give the RGB standard error that `footprint compare` writes next to its reference");
}

// An image. If `footprint compare` wrote it, exposure and standard error are those of its results.json unless they are
// given, so that equal images have equal errors in both.
Reference given_reference(const ScoreArguments& arguments) {
  const RunSettings run = arguments.run.settings();
  std::vector<std::string> of_scenes = arguments.run.given_of("reference");
  if (run.view.distances.front() != 1.0) of_scenes.emplace_back("--distance");
  if (!of_scenes.empty()) {
    throw Error(ErrorKind::usage, of_scenes.front(), fmt::format("{} is an image, not a scene", arguments.reference),
                "use it with a scene as the reference");
  }
  Reference out{read_reference(arguments.reference), {}, 1.0F};
  const std::optional<ListedReference> listed = listed_reference(arguments.reference);
  Scene scene;
  if (listed) scene.exposure = listed->exposure;
  out.exposure = choose_exposure(run.view.exposure, scene, out.picture).factor;
  std::string standard_error = arguments.standard_error;
  if (standard_error.empty() && listed) standard_error = listed->standard_error.string();
  if (!standard_error.empty()) out.standard_error = read_standard_error(standard_error);
  return out;
}

struct Scores {
  std::vector<PictureScore> pictures;
  std::optional<PairScore> pair;
  float exposure = 1.0F;
  std::size_t pixels = 0, unresolved = 0;
};

Scores take_scores(const ScoreArguments& arguments) {
  Reference reference = names_a_scene(arguments.reference) ? rendered_reference(arguments) : given_reference(arguments);
  Scores out;
  out.exposure = reference.exposure;
  if (!reference.standard_error.empty())
    out.unresolved = leave_out_unresolved(reference.picture, reference.standard_error, reference.exposure);
  if (!arguments.mask.empty()) {
    reference.picture =
        masked(std::move(reference.picture), read_image(arguments.mask, Transfer::linear), arguments.mask);
  }
  std::vector<ScoredPicture> pictures;
  for (const std::string& file : arguments.pictures) pictures.push_back(read_scored(file, out.exposure));
  for (const ScoredPicture& picture : pictures)
    out.pictures.push_back(score_picture(picture, reference.picture, out.exposure, arguments.pixels_per_degree));
  if (pictures.size() == 2) {
    out.pair = score_pair(pictures[0], pictures[1], reference.picture, reference.standard_error, out.exposure);
  }
  out.pixels = object_pixel_count(reference.picture);
  return out;
}

Json score_json(const PictureScore& score) {
  Json json{{"picture", score.name}, {"displayed", score.displayed}};
  for (const ScoreMetric& metric : score_metrics()) {
    const std::optional<double> value = metric.value(score);
    json[metric.key] = json_number(value && std::isfinite(*value) ? value : std::nullopt);
  }
  return json;
}

std::string scores_json(const ScoreArguments& arguments, const Scores& scores) {
  Json pictures = Json::array();
  for (const PictureScore& score : scores.pictures) pictures.push_back(score_json(score));
  Json json{{"schema", "footprint-score/1"},
            {"tool", {{"name", "footprint"}, {"version", FOOTPRINT_VERSION}}},
            {"reference", arguments.reference},
            {"mask", arguments.mask.empty() ? Json(nullptr) : Json(arguments.mask)},
            {"exposure", json_number(scores.exposure)},
            {"pixels_per_degree", json_number(arguments.pixels_per_degree)},
            {"pixels", scores.pixels},
            {"unresolved", scores.unresolved},
            {"pictures", std::move(pictures)}};
  if (scores.pair) {
    json["closer"] = {{"shares", {json_number(scores.pair->shares.a), json_number(scores.pair->shares.b)}},
                      {"beyond_noise", scores.pair->beyond_noise}};
  }
  return json_text(json, 2);
}

std::string cell(const std::optional<double>& value) { return value ? fmt::format("{:.4g}", *value) : "n/a"; }

std::string scores_table(const Scores& scores) {
  std::vector<MarkdownColumn> columns{{"Image", false}};
  std::vector<std::vector<std::string>> rows;
  for (const ScoreMetric& metric : score_metrics()) columns.push_back({std::string(metric.title)});
  for (const PictureScore& score : scores.pictures) {
    rows.push_back({score.name});
    for (const ScoreMetric& metric : score_metrics()) rows.back().push_back(cell(metric.value(score)));
  }
  std::string text = markdown_table(columns, rows);
  if (!scores.pair) return text;
  return text +
         fmt::format("\nThe first is closer to the reference in {:.1f}% of the pixels, the second in {:.1f}%{}\n",
                     100 * scores.pair->shares.a, 100 * scores.pair->shares.b,
                     scores.pair->beyond_noise ? " (by more than three standard errors of the reference)."
                                               : " (noise unknown: give --standard-error).");
}

void write_pictures(const std::filesystem::path& folder, const Scores& scores) {
  for (std::size_t i = 0; i < scores.pictures.size(); ++i) {
    const PictureScore& score = scores.pictures[i];
    write_png(folder / fmt::format("ldr_flip_{}.png", i + 1), false_color(score.ldr_map, 1.0F));
    if (!score.hdr_map.empty())
      write_png(folder / fmt::format("hdr_flip_{}.png", i + 1), false_color(score.hdr_map, 1.0F));
  }
  if (scores.pair) write_png(folder / "closer.png", verdict_picture(scores.pair->verdicts, scores.pair->object));
}

void run_score(const ScoreArguments& arguments) {
  const Scores scores = take_scores(arguments);
  std::string text =
      fmt::format("{} pixels{}, exposure {:.4g}\n\n{}", scores.pixels,
                  scores.unresolved == 0 ? "" : fmt::format(" ({} unresolved left out)", scores.unresolved),
                  scores.exposure, scores_table(scores));
  if (!arguments.output.empty()) {
    const auto [made, folder] = write_whole(arguments.output, [&](OutputFolder& out) {
      write_file_atomically(out.path() / "score.json", scores_json(arguments, scores));
      write_pictures(out.path(), scores);
      out.commit();
      return true;
    });
    text += fmt::format("\nscore: {}\n", (folder / "score.json").string());
  }
  write_output(text);
}

}  // namespace

void add_score_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("score", "Score images of any renderer against a reference");
  const auto arguments = std::make_shared<ScoreArguments>(*command);
  command->add_option("pictures", arguments->pictures, "One image, or two")
      ->type_name("IMAGE")
      ->required()
      ->expected(1, 2);
  command
      ->add_option("--reference", arguments->reference,
                   "Scene, or an EXR of linear radiance, with coverage in alpha if present")
      ->type_name("SCENE|EXR")
      ->required();
  command
      ->add_option("--standard-error", arguments->standard_error,
                   "EXR of the reference's standard error, RGB; without it, noise counts as error")
      ->type_name("EXR");
  command->add_option("--mask", arguments->mask, "Image that is black where pixels do not count")->type_name("IMAGE");
  command
      ->add_option("--pixels-per-degree", arguments->pixels_per_degree,
                   "Pixels per degree of the observer's field of view, for FLIP")
      ->check(within(5.0, 1000.0))
      ->capture_default_str();
  command->add_option("-o,--output", arguments->output, "Folder for score.json and images; default: none")
      ->type_name("DIR");
  add_quiet_flag(*command, arguments->quiet);
  command->footer(score_examples);
  command->callback([arguments] { run_score(*arguments); });
}

}  // namespace footprint
