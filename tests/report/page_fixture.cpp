// Writes a report with pictures for the tests of the page and of the schema: footprint_page_fixture FOLDER KIND.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string_view>

#include "renderer/core/files.hpp"
#include "renderer/image/false_color.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/image/metrics.hpp"
#include "renderer/image/pixel_script.hpp"
#include "results/report/page.hpp"
#include "results/report/report.hpp"
#include "tests/report/example_animation.hpp"
#include "tests/report/example_results.hpp"

namespace footprint {
namespace {

/// A lit ball with a glittering highlight; `sharpness` sets the size of the glitter, 0 the smooth mean.
Image ball(int size, double sharpness) {
  Image picture(size, size, 4);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const double u = 2.2 * (x + 0.5) / size - 1.1;
      const double v = 2.2 * (y + 0.5) / size - 1.1;
      if (u * u + v * v > 1) continue;
      const double toward_light = std::max(0.0, -0.4 * u - 0.5 * v + 0.77 * std::sqrt(1 - u * u - v * v));
      const double glitter = 1 + sharpness * std::sin(x * 1.7) * std::sin(y * 2.3 + x * 0.4);
      const double shine = 0.9 * std::pow(toward_light, 30) * glitter;
      const std::span<float> texel = picture.at(x, y);
      texel[0] = static_cast<float>(0.35 * toward_light + shine);
      texel[1] = static_cast<float>(0.14 * toward_light + shine);
      texel[2] = static_cast<float>(0.10 * toward_light + shine);
      texel[3] = 1;
    }
  }
  return picture;
}

std::filesystem::path png_of(const std::filesystem::path& folder, const std::string& image) {
  return (folder / image).replace_extension(".png");
}

// Writes the files that write_page_picture of the studies writes.
void write_picture(const std::filesystem::path& folder, const std::string& exr, const Image& radiance,
                   double exposure) {
  const std::filesystem::path file = folder / exr;
  write_exr(file, radiance);
  write_png(png_of(folder, exr), to_display(radiance, static_cast<float>(exposure)));
  write_pixel_script(file.parent_path() / (file.stem().string() + "_values.js"), radiance);
}

void write_pictures(const Results& results, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder / "images");
  for (const Record& record : results.records) {
    const Image reference = ball(record.width, 0.05);
    const Image picture = ball(record.width, 20 * (record.error ? record.error->normalized_color : 0));
    write_picture(folder, record.images.reference, reference, results.scene.exposure);
    const bool left_out = record.images.color.find("absent") != std::string::npos;
    if (!left_out) write_picture(folder, record.images.color, picture, results.scene.exposure);
    const auto scale = std::ranges::find(results.error_scales, record.distance, &ErrorScale::distance);
    const Image errors = error_map(picture, reference, 1);
    write_png(folder / record.images.error, false_color(errors, static_cast<float>(scale->error)));
    write_png(folder / record.images.error_shared, false_color(errors, static_cast<float>(results.error_scale)));
    write_png(folder / record.images.flip, false_color(errors, 0.5F));
    write_png(png_of(folder, record.images.interior), to_display(ball(record.width, 1), 1));
  }
  for (const MethodPair& pair : results.pairs) {
    if (pair.picture.find("absent") == std::string::npos)
      write_png(folder / pair.picture, to_display(ball(results.records.front().width, 1), 1));
  }
  if (!results.experiment) return;
  for (const std::string& name : results.experiment->pictures) write_png(folder / name, to_display(ball(64, 1), 1));
}

void write_film(const Results& animation, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder / "images");
  for (const Record& record : animation.records) {
    const auto brightness = static_cast<float>(record.frame + 1);
    write_png(png_of(folder, record.images.reference), to_display(ball(64, 0.05), brightness));
    write_png(png_of(folder, record.images.color), to_display(ball(64, 4), brightness));
  }
  write_report(animation, folder);
}

constexpr std::size_t few_members = 4, many_members = 84;  // the latter: 1008 records
constexpr std::size_t with_pictures = 1;                   // members

void write_matrix(const std::filesystem::path& folder, std::size_t members) {
  const MatrixResults matrix = example_matrix(members);
  for (const MatrixMember& member : std::span(matrix.members).first(with_pictures))
    write_pictures(member.results, folder / member.folder);
  write_matrix_report(matrix, folder);
}

// A page without runs, as of `recommend` and `score`: two views, and a section with everything.
void write_views(const std::filesystem::path& folder) {
  Page page{.title = "views", .eyebrow = "a test", .lede = "Two views.", .text = "as text", .answer = {"b is chosen."}};
  for (const int view : {1, 2}) {
    std::vector<PageImage> images;
    for (const char* name : {"reference", "a", "b"}) {
      const std::string stem = fmt::format("{}_{}", name, view);
      write_picture(folder, stem + ".exr", ball(96, 0.3 * view * (*name - 'a' + 1)), 1);
      images.push_back(
          {.name = name, .png = stem + ".png", .values = stem + "_values.js", .caption = "caption of " + stem});
    }
    page.views.push_back({.label = fmt::format("view {}", view), .images = std::move(images)});
  }
  page.sections.push_back(
      {.heading = "steel </script>",
       .sentences = {"b is chosen.", "a is cheaper."},
       .command = "footprint bake <steel>",
       .plot = {.title = "Relative cost",
                .points = {{.name = "a", .x = 1, .low = 0.9, .high = 1.1, .y = 0.1},
                           {.name = "b", .x = 2, .low = 1.9, .high = 2.2, .y = 0.05, .chosen = true},
                           {.name = "worse", .x = 3, .low = 2, .high = 4, .y = 0.2}},
                .most_y = 0.08},
       .table = {.columns = {{"Method", false}, {"Error"}}, .rows = {{"a", "0.1"}, {"b", "0.05"}}},
       .marked = 1,
       .links = {"a b/index.html"}});
  page.provenance = {{"Version", "none"}};
  write_file_atomically(folder / "index.html", page_html(page));
}

void write_fixture(const std::filesystem::path& folder, std::string_view kind) {
  if (kind == "film") return write_film(example_animation(), folder);
  if (kind == "hostile_film") return write_film(hostile_animation(), folder);
  if (kind == "views") return write_views(folder);
  if (kind == "matrix") return write_matrix(folder, few_members);
  if (kind == "large") return write_matrix(folder, many_members);
  const Results results = kind == "hostile" ? hostile_results() : example_results();
  write_pictures(results, folder);
  write_report(results, folder);
}

}  // namespace
}  // namespace footprint

int main(int argc, char** argv) {
  try {
    if (argc != 3)
      throw std::invalid_argument(
          "usage: footprint_page_fixture FOLDER example|hostile|film|hostile_film|views|matrix|large");
    footprint::write_fixture(argv[1], argv[2]);
    return 0;
  } catch (const std::exception& fault) {
    fmt::print(stderr, "{}\n", fault.what());
    return 2;
  }
}
