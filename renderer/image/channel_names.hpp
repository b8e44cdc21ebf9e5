// The channels of a file that an image has, chosen by their names.
#pragma once

#include <string>
#include <vector>

namespace footprint {

/// Channels chosen from a file's, in the order of the image.
struct ChosenChannels {
  std::vector<int> indices;           ///< one to four, numbers of the file's channels
  bool has_coverage = false;          ///< the last one is coverage (A)
  std::string layer;                  ///< the part of their names before the last dot; empty: the main image
  std::vector<std::string> left_out;  ///< the names of the others
};

/// Chooses RGB, X, Y and Z, or luminance, each with coverage (A) if there is some, or RG or XY, of the main image, or
/// of the only layer that has such channels. Without such names all channels count, if there are one to four. names: as
/// OpenImageIO gives them, such as "R", "diffuse.R", "channel3". takes_vectors: whether X, Y and Z are the components
/// of a vector; otherwise they are refused. Throws Error (usage) at `place`: several layers without a main image,
/// luminance with chroma, X, Y, Z that are no vector, none of these names among more than four.
[[nodiscard]] ChosenChannels choose_channels(const std::vector<std::string>& names, bool takes_vectors,
                                             const std::string& place);

/// Whether a file has red, green and blue of its main image.
[[nodiscard]] bool names_rgb(const std::vector<std::string>& names);

}  // namespace footprint
