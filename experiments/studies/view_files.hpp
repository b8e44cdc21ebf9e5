// The images of a measured view as files.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "experiments/studies/finished_work.hpp"
#include "experiments/studies/measured_view.hpp"
#include "experiments/studies/reference.hpp"
#include "renderer/core/options.hpp"
#include "renderer/core/run_folder.hpp"

namespace footprint {

/// Writes the images of a view into FOLDER/images, and names them in its records: the reference, its masks and the
/// methods; of an animation no masks. An image that cannot be written is a loss of the folder.
/// methods: of the records, in their order.
void write_view(const RunFolder& folder, std::span<const MethodSpec> methods, const Reference& reference,
                float exposure, MeasuredView& measured);

/// Compares every two methods, and writes a picture of each verdict into FOLDER/images.
[[nodiscard]] std::vector<MethodPair> write_pairs(const RunFolder& folder, std::span<const MethodSpec> methods,
                                                  const MeasuredView& measured, const Reference& reference,
                                                  float exposure);

/// The files in a folder that write_view and write_pairs made for a view.
[[nodiscard]] std::vector<std::string> files_of_view(const DistanceResult& result);

}  // namespace footprint
