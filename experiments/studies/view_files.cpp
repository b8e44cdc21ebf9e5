// The names of a view's files, each of which has the view in it.
#include "experiments/studies/view_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "experiments/studies/picture_files.hpp"
#include "experiments/studies/score.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/image/metrics.hpp"

namespace footprint {
namespace {

// Writes what all methods of a view share. An animation has no images but those of its frames.
RecordImages write_reference(const RunFolder& folder, const Reference& reference, float exposure) {
  const PlannedView& place = reference.place;
  const std::string stem = place.stem("reference");
  RecordImages files;
  files.reference = write_page_picture(folder, stem, reference.whole, exposure, reference.unresolved);
  if (place.kind == RunKind::animation) return files;
  files.interior = write_mask(folder, place.stem("interior"), reference.parts.interior);
  files.standard_error = fmt::format("images/{}_standard_error.exr", stem);
  folder.attempt(files.standard_error,
                 [&] { write_exr(folder / files.standard_error, reference.reference.standard_error); });
  return files;
}

}  // namespace

void write_view(const RunFolder& folder, std::span<const MethodSpec> methods, const Reference& reference,
                float exposure, MeasuredView& measured) {
  const RecordImages shared = write_reference(folder, reference, exposure);
  for (std::size_t m = 0; m < measured.records.size(); ++m) {
    RecordImages& files = measured.records[m].images = shared;
    if (measured.images[m].texels.empty()) continue;
    const std::string stem = reference.place.stem(method_stem(methods, m));
    files.color = write_page_picture(folder, stem, measured.images[m], exposure);
  }
}

std::vector<MethodPair> write_pairs(const RunFolder& folder, std::span<const MethodSpec> methods,
                                    const MeasuredView& measured, const Reference& reference, float exposure) {
  const Image object = object_pixels(reference.reference.mean);
  const auto write = [&](std::size_t first, std::size_t second, const Image& verdicts) {
    const std::string stem = distance_stem(reference.place.at.distance, method_stem(methods, first));
    std::string file = fmt::format("images/{}_or_{}.png", stem, method_stem(methods, second));
    folder.attempt(file, [&] { write_png(folder / file, verdict_picture(verdicts, object)); });
    return file;
  };
  return compare_pairs(measured, reference, exposure, write);
}

std::vector<std::string> files_of_view(const DistanceResult& result) {
  std::vector<std::string> files;
  const auto add = [&](const std::string& exr) {
    std::ranges::move(page_picture_files(exr), std::back_inserter(files));
  };
  add(result.reference);
  for (const Record& record : result.records) {
    if (!record.failure) add(record.images.color);
  }
  const RecordImages& shared = result.records.front().images;
  if (shared.interior.empty()) return files;  // of an animation
  files.insert(files.end(), {shared.standard_error, shared.interior,
                             std::filesystem::path(shared.interior).replace_extension(".png").string()});
  for (const MethodPair& pair : result.pairs) files.push_back(pair.picture);
  return files;
}

}  // namespace footprint
