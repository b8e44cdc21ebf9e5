// `footprint score`: images of any origin against a reference.
#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "app/subcommand.hpp"
#include "experiments/studies/exposure.hpp"
#include "experiments/studies/score.hpp"
#include "experiments/studies/stage.hpp"
#include "renderer/core/names.hpp"
#include "renderer/image/false_color.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/image/pixel_script.hpp"
#include "renderer/scene/assembly/load_scene.hpp"
#include "results/report/experiment_report.hpp"
#include "results/report/json_archive.hpp"
#include "results/report/page.hpp"

namespace footprint {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr const char* score_examples =
    R"(IMAGE is an EXR, Radiance HDR or float TIFF of linear radiance, or a PNG, JPEG, TIFF, BMP or WebP of displayed colours
(sRGB unless it declares others), for which measures of radiance are left out. Two images are scored separately, then compared pixel by pixel.

Examples:
  footprint score engine.exr --reference model.gltf --spp 256
  footprint score engine.exr --reference reference.exr
  footprint score before.png after.png --reference reference.exr --exposure 0.5 -o score
  footprint score a.exr b.exr --reference out/images/d1_reference.exr --mask object.png -o score
  footprint score nightly --reference golden --max p99=0.05 --max share_above:0.1=0.01 --junit score.xml

If `footprint compare` wrote the reference, its exposure and standard error are used.)";

constexpr int scoring_pictures = 6;  // mean, squares, two halves, error, and one to spare

struct ScoreArguments : RunArguments {
  explicit ScoreArguments(CLI::App& command) : RunArguments(command) {
    add_value(command, "pictures", pictures, "IMAGE", "One image, two, or a folder of images")
        ->required()
        ->expected(1, 2);
    add_value(command, "--reference", reference, "SCENE|EXR|FOLDER",
              "Scene, an EXR of linear radiance, with coverage in alpha if present, or a folder of such images")
        ->required();
    add_value(command, "--standard-error", standard_error, "EXR",
              "EXR of the reference's standard error, RGB; without it, noise counts as error");
    add_value(command, "--mask", mask, "IMAGE", "Image that is black where pixels do not count");
    add_value(command, "--picture-error", picture_error, "EXR",
              "EXR of the image's own standard error, for --significance");
    command
        .add_option("--significance", significance,
                    "Test every pixel: count those whose difference noise explains with less than this probability, "
                    "over all pixels")
        ->check(within(1e-9, 0.5));
    add_value(command, "--max", limits, "NAME=VALUE",
              "Fail (exit code 1) above VALUE; NAME is a measure of score.json, pN (percentile), share_above:E or "
              "rejected; "
              "may be repeated")
        ->expected(1)
        ->take_all();
    add_value(command, "--junit", junit, "FILE", "Also write every limit as JUnit XML");
    command.add_flag("--github", github, "Also print failures as annotations for GitHub workflows");
    command
        .add_option("--pixels-per-degree", pixels_per_degree,
                    "Pixels per degree of the observer's field of view, for FLIP")
        ->check(within(5.0, 1000.0))
        ->capture_default_str();
    add_output_folder(command, output, "Folder for index.html, score.json and images; default: none");
  }

  std::vector<std::string> pictures;
  std::string reference, standard_error, picture_error, mask, output, junit;
  std::vector<std::string> limits;
  double pixels_per_degree = flip_pixels_per_degree;
  std::optional<double> significance;
  bool github = false;
};

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
  RunSettings run = arguments.settings();
  run.scene = arguments.reference;
  const Image first = read_image(arguments.pictures.front(), Transfer::declared);
  run.view.size = {first.width, first.height};
  ProgressDisplay display(progress_style(arguments.quiet));
  ProgressParts parts(display.callback(), 3);
  const Stage stage(load_scene(run.scene, run.scene_library, run.overrides), run, parts.next(1, ""),
                    {.pictures = scoring_pictures});
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

void write_notes(const ScoredPicture& picture) {
  for (const std::string& note : picture.notes) write_message(fmt::format("warning: {}: {}", picture.name, note));
}

// An image. If `footprint compare` wrote it, exposure and standard error are those of its results.json unless they are
// given, so that equal images have equal errors in both.
Reference given_reference(const ScoreArguments& arguments) {
  const RunSettings run = arguments.settings();
  std::vector<std::string> of_scenes = arguments.given_of("reference");
  if (run.view.distances.front() != 1.0) of_scenes.emplace_back("--distance");
  if (!of_scenes.empty()) {
    throw Error(ErrorKind::usage, of_scenes.front(), fmt::format("{} is an image, not a scene", arguments.reference),
                "use it with a scene as the reference");
  }
  ScoredPicture read = read_reference(arguments.reference);
  write_notes(read);
  Reference out{std::move(read.radiance), {}, 1.0F};
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
  std::string reference;
  std::vector<Image> radiance;  // of the reference and of each image, for the page; empty without a folder
  std::vector<PictureScore> pictures;
  std::optional<PairScore> pair;
  float exposure = 1.0F;
  std::size_t pixels = 0, unresolved = 0;
};

std::optional<std::size_t> tested(const ScoreArguments& arguments, const ScoredPicture& picture,
                                  const Reference& reference) {
  if (!arguments.significance) return {};
  if (picture.displayed)
    throw Error(ErrorKind::usage, picture.name, "it stores displayed colours, but --significance tests radiance",
                "give an EXR");
  if (reference.standard_error.empty())
    throw Error(ErrorKind::usage, "--significance", "the noise of the reference is not known",
                "give --standard-error, or a reference that `footprint compare` wrote");
  if (!arguments.picture_error.empty() && arguments.pictures.size() > 1)
    throw Error(ErrorKind::usage, "--picture-error", "it is the noise of one image", "score the images one by one");
  const Image own = arguments.picture_error.empty() ? Image() : read_standard_error(arguments.picture_error);
  return rejected_pixels(
      picture.radiance, reference.picture,
      {.reference_error = reference.standard_error, .picture_error = own, .significance = *arguments.significance});
}

Scores take_scores(const ScoreArguments& arguments) {
  Reference reference = names_a_scene(arguments.reference) ? rendered_reference(arguments) : given_reference(arguments);
  Scores out;
  out.reference = arguments.reference;
  out.exposure = reference.exposure;
  if (!reference.standard_error.empty())
    out.unresolved = leave_out_unresolved(reference.picture, reference.standard_error, reference.exposure);
  if (!arguments.mask.empty()) {
    reference.picture =
        masked(std::move(reference.picture), read_image(arguments.mask, Transfer::declared), arguments.mask);
  }
  std::vector<ScoredPicture> pictures;
  for (const std::string& file : arguments.pictures) {
    pictures.push_back(read_scored(file, out.exposure));
    write_notes(pictures.back());
  }
  for (const ScoredPicture& picture : pictures) {
    out.pictures.push_back(score_picture(picture, reference.picture, out.exposure, arguments.pixels_per_degree));
    out.pictures.back().rejected = tested(arguments, picture, reference);
  }
  if (pictures.size() == 2) {
    out.pair = score_pair(pictures[0], pictures[1], reference.picture, reference.standard_error, out.exposure);
  }
  out.pixels = object_pixel_count(reference.picture);
  if (arguments.output.empty()) return out;
  out.radiance.push_back(std::move(reference.picture));
  for (ScoredPicture& picture : pictures) out.radiance.push_back(std::move(picture.radiance));
  return out;
}

Json score_json(const PictureScore& score) {
  Json json{{"picture", score.name}, {"displayed", score.displayed}};
  for (const ScoreMetric& metric : score_metrics()) {
    json[metric.key] = to_json_value(metric.value(score));
  }
  json["rejected"] = score.rejected ? Json(*score.rejected) : Json(nullptr);
  return json;
}

Json scores_json(const ScoreArguments& arguments, const Scores& scores) {
  Json pictures = Json::array();
  for (const PictureScore& score : scores.pictures) pictures.push_back(score_json(score));
  Json json{{"schema", "footprint-score/1"},
            {"tool", {{"name", "footprint"}, {"version", FOOTPRINT_VERSION}}},
            {"reference", scores.reference},
            {"mask", arguments.mask.empty() ? Json(nullptr) : Json(arguments.mask)},
            {"exposure", scores.exposure},
            {"pixels_per_degree", arguments.pixels_per_degree},
            {"significance", to_json_value(arguments.significance)},
            {"pixels", scores.pixels},
            {"unresolved", scores.unresolved},
            {"pictures", std::move(pictures)}};
  if (scores.pair) {
    json["closer"] = {{"shares", scores.pair->shares}, {"beyond_noise", scores.pair->beyond_noise}};
  }
  return json;
}

std::string cell(const std::optional<double>& value) { return value ? fmt::format("{:.4g}", *value) : "n/a"; }

Table table_of(const Scores& scores) {
  Table table{.columns = {{"Image", false}}};
  for (const ScoreMetric& metric : score_metrics()) table.columns.push_back({std::string(metric.title)});
  for (const PictureScore& score : scores.pictures) {
    table.rows.push_back({score.name});
    for (const ScoreMetric& metric : score_metrics()) table.rows.back().push_back(cell(metric.value(score)));
  }
  return table;
}

std::string scores_table(const Scores& scores) {
  std::string text = markdown_table(table_of(scores));
  for (const PictureScore& score : scores.pictures) {
    if (score.rejected)
      text += fmt::format("\n{}: {} of {} pixels are off by more than noise.\n", score.name, *score.rejected,
                          scores.pixels);
  }
  if (!scores.pair) return text;
  return text +
         fmt::format("\nThe first is closer to the reference in {:.1f}% of the pixels, the second in {:.1f}%{}\n",
                     100 * scores.pair->shares[0], 100 * scores.pair->shares[1],
                     scores.pair->beyond_noise ? " (by more than three standard errors of the reference)."
                                               : " (noise unknown: give --standard-error).");
}

void write_pictures(const RunFolder& folder, const Scores& scores) {
  const auto write = [&](const std::string& file, const auto& picture) {
    folder.attempt(file, [&] { write_png(folder / file, picture()); });
  };
  for (std::size_t i = 0; i < scores.pictures.size(); ++i) {
    const PictureScore& score = scores.pictures[i];
    write(fmt::format("ldr_flip_{}.png", i + 1), [&] { return false_color(score.ldr_map, 1.0F); });
    if (!score.hdr_map.empty())
      write(fmt::format("hdr_flip_{}.png", i + 1), [&] { return false_color(score.hdr_map, 1.0F); });
  }
  if (scores.pair) write("closer.png", [&] { return verdict_picture(scores.pair->verdicts, scores.pair->object); });
}

PageImage page_image(const RunFolder& folder, const std::string& name, const std::string& stem, const Image& radiance,
                     float exposure) {
  // Scores count the pixels that are not finite.
  folder.attempt(stem, [&] { write_png(folder / (stem + ".png"), to_display(finite_part(radiance), exposure)); });
  folder.attempt(stem, [&] { write_pixel_script(folder / (stem + "_values.js"), radiance); });
  return {.name = name, .png = stem + ".png", .values = stem + "_values.js"};
}

// "a.png has the least error, 0.0123." of two images.
std::string answer_of(const Scores& scores) {
  const auto error = [](const PictureScore& score) { return score.error.normalized_color; };
  const PictureScore& best = *std::ranges::min_element(scores.pictures, {}, error);
  return fmt::format("{} {} {:.4g} against {}.", best.name,
                     scores.pictures.size() > 1 ? "has the least error," : "has error", error(best), scores.reference);
}

void write_page(const RunFolder& folder, const Scores& scores) {
  PageView view{.label = "image",
                .images = {page_image(folder, "reference", "reference", scores.radiance.front(), scores.exposure)}};
  for (std::size_t i = 0; i < scores.pictures.size(); ++i) {
    view.images.push_back(page_image(folder, scores.pictures[i].name, fmt::format("image_{}", i + 1),
                                     scores.radiance.at(i + 1), scores.exposure));
    view.images.back().flip = fmt::format("ldr_flip_{}.png", i + 1);
    view.images.back().caption = fmt::format("error {:.4g}", scores.pictures[i].error.normalized_color);
  }
  std::vector<Provenance> provenance{{"Version", fmt::format("footprint {}", FOOTPRINT_VERSION)}};
  if (std::string lost = folder.losses_text(); !lost.empty()) provenance.push_back({"Warning", std::move(lost)});
  const Page page{.title = "Scores against " + scores.reference,
                  .eyebrow = "images against a reference",
                  .lede = fmt::format("{} pixels, exposure {:.4g}.", scores.pixels, scores.exposure),
                  .text = scores_table(scores),
                  .answer = {answer_of(scores)},
                  .views = {std::move(view)},
                  .exposure = scores.exposure,
                  .sections = {{.heading = "Measures", .table = table_of(scores)}},
                  .provenance = std::move(provenance)};
  folder.write_text("index.html", [&] { return page_html(page); });
}

// Sorts formats of linear radiance before those of displayed colours, EXR first.
std::size_t format_rank(const fs::path& image) {
  constexpr std::array<std::string_view, 6> of_radiance{".exr", ".hdr", ".pic", ".rgbe", ".tif", ".tiff"};
  return static_cast<std::size_t>(std::ranges::find(of_radiance, lower_extension(image)) - of_radiance.begin());
}

fs::path without_extension(fs::path image) { return image.replace_extension(); }

// The images of a folder that have a known format, by their paths in it without extension. Of an image in several
// formats the first by format_rank counts.
std::map<fs::path, fs::path> images_in(const fs::path& folder) {
  std::map<fs::path, fs::path> images;
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code ignored;
    if (!entry->is_regular_file(ignored) || !names_an_image(entry->path())) continue;
    const fs::path image = entry->path().lexically_relative(folder);
    fs::path& chosen = images.try_emplace(without_extension(image), image).first->second;
    if (std::pair(format_rank(image), image) < std::pair(format_rank(chosen), chosen)) chosen = image;
  }
  if (error) throw Error(ErrorKind::usage, folder.string(), error.message(), "give a folder that can be read");
  return images;
}

// One score per image of a reference folder, against the image of the same path in the other folder: in the same format
// if there is one, else in any.
std::vector<ScoreArguments> folder_scores(const ScoreArguments& arguments) {
  const fs::path pictures = arguments.pictures.front(), references = arguments.reference;
  const std::map<fs::path, fs::path> candidates = images_in(pictures);
  std::vector<ScoreArguments> scores;
  for (const auto& [name, image] : images_in(references)) {
    const auto candidate = candidates.find(name);
    if (candidate == candidates.end())
      throw Error(ErrorKind::usage, (pictures / image).string(),
                  fmt::format("no such file, but {} has one", references.string()),
                  "give folders with images of the same names");
    ScoreArguments& one = scores.emplace_back(arguments);
    one.pictures = {(pictures / (fs::is_regular_file(pictures / image) ? image : candidate->second)).string()};
    one.reference = (references / image).string();
  }
  if (!scores.empty()) return scores;
  throw Error(ErrorKind::usage, references.string(), "has no image", "give a folder of references");
}

// The scores that the arguments ask for: folders against each other, or one or two images.
std::vector<ScoreArguments> wanted_scores(const ScoreArguments& arguments) {
  std::error_code none;
  const bool folders = fs::is_directory(arguments.pictures.front(), none);
  if (!folders) return {arguments};
  if (arguments.pictures.size() == 1 && fs::is_directory(arguments.reference, none)) return folder_scores(arguments);
  throw Error(ErrorKind::usage, arguments.pictures.front(), "a folder is scored against a folder of references alone",
              "give two folders, or images");
}

std::string scores_text(const Scores& scores) {
  return fmt::format("{} pixels{}, exposure {:.4g}\n\n{}", scores.pixels,
                     scores.unresolved == 0 ? "" : fmt::format(" ({} unresolved left out)", scores.unresolved),
                     scores.exposure, scores_table(scores));
}

void write_scores(const ScoreArguments& arguments, std::span<const Scores> all, OutputFolder& out) {
  for (const Scores& scores : all) {
    const fs::path part =
        all.size() == 1 ? fs::path() : fs::path(scores.reference).lexically_relative(arguments.reference);
    fs::create_directories(out.path() / part);
    const RunFolder folder = out.run().below(part);
    folder.write_document("score.json", json_text(scores_json(arguments, scores), 2));
    write_pictures(folder, scores);
    write_page(folder, scores);
  }
  out.commit();
}

void run_score(const ScoreArguments& arguments) {
  std::vector<ScoreLimit> limits;
  for (const std::string& text : arguments.limits) limits.push_back(parse_score_limit(text));
  std::vector<Scores> all;
  std::vector<CheckOutcome> outcomes;
  std::string text;
  std::optional<Error> lost;
  for (const ScoreArguments& one : wanted_scores(arguments)) {
    all.push_back(take_scores(one));
    text += scores_text(all.back());
    for (const PictureScore& score : all.back().pictures)
      std::ranges::move(limit_outcomes(limits, score), std::back_inserter(outcomes));
  }
  if (!arguments.output.empty()) {
    const auto [made, folder, losses] = write_whole(arguments.output, [&](OutputFolder& out) {
      write_scores(arguments, all, out);
      return true;
    });
    text += fmt::format("\nscore: {}\n", (folder / (all.size() == 1 ? "score.json" : "")).string());
    lost = losses;
  }
  write_output(text);
  if (!arguments.junit.empty()) write_file_atomically(arguments.junit, junit_xml(outcomes));
  if (arguments.github) write_output(github_annotations(outcomes));
  require_none_failed("score", "limits", shortfalls_of(outcomes));
  throw_first({lost});
}

}  // namespace

void add_score_command(CLI::App& app) {
  add_command(app, "score", "Score images of any renderer against a reference", score_examples, run_score);
}

}  // namespace footprint
