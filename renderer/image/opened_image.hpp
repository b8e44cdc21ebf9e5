// An image file of any format, opened: its header is read and checked, its texels are not.
#pragma once

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "renderer/core/error.hpp"
#include "renderer/image/channel_names.hpp"
#include "renderer/image/declarations.hpp"
#include "renderer/image/image.hpp"

namespace footprint {

/// A file or bytes in memory. Throws Error (usage): missing, not a file, not readable.
[[nodiscard]] std::unique_ptr<OIIO::Filesystem::IOProxy> opened_source(const std::filesystem::path& file);

/// The error of a file that is no image that can be read.
[[nodiscard]] Error unreadable_image(const std::string& name, const std::string& message);

/// The limits of a reader.
struct ImageLimits {
  int side = 16384;           ///< texels per side, of the stored pixels and of the picture
  int channels = 0;           ///< 0: channels are chosen by name; otherwise all count, up to this number
  bool takes_vectors = true;  ///< whether channels X, Y and Z are a vector
};

/// An open file. It reads from `source`, which must outlive it.
class OpenedImage {
 public:
  /// Throws Error (usage): empty, of no known format, damaged, over a limit, without a channel that counts.
  OpenedImage(OIIO::Filesystem::IOProxy& source, std::string name, const ImageLimits& limits);

  [[nodiscard]] const Declarations& declared() const { return declared_; }
  [[nodiscard]] const ChosenChannels& channels() const { return channels_; }
  [[nodiscard]] const std::vector<std::string>& channel_names() const { return spec_.channelnames; }
  [[nodiscard]] bool is_radiance_hdr() const { return format_ == "hdr"; }

  /// The texels of the chosen channels as stored: 0 to 1 for integers. Throws Error (usage): truncated or damaged;
  /// (machine): not enough memory.
  [[nodiscard]] Image texels();

  /// Goes to a level of a mip chain, from 0; false if there is none. Throws Error (usage): it is over a limit.
  [[nodiscard]] bool seek_level(int level);

 private:
  void open_webp(OIIO::Filesystem::IOProxy& source);
  void open_by_oiio(OIIO::Filesystem::IOProxy& source);
  void rewrite_radiance(OIIO::Filesystem::IOProxy& source);
  void choose_part();
  void take_declarations();
  void check_size() const;

  std::string name_, format_;
  ImageLimits limits_;
  std::vector<unsigned char> bytes_;                   // the whole file, if its format needs that
  std::unique_ptr<OIIO::Filesystem::IOProxy> memory_;  // reads `bytes_`
  std::unique_ptr<OIIO::ImageInput> input_;            // null for WebP
  OIIO::ImageSpec spec_;                               // of the current part and level
  int part_ = 0, level_ = 0;
  ChosenChannels channels_;
  Declarations declared_;
};

}  // namespace footprint
