// Levels one behind the other through OpenImageIO, encoded in memory as image_io.cpp does it.
#include "renderer/image/exr_chain.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "renderer/core/error.hpp"
#include "renderer/core/file_bytes.hpp"
#include "renderer/core/files.hpp"
#include "renderer/core/memory.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/image/mipmap.hpp"

namespace footprint {
namespace {

constexpr int exr_tile = 64;  // as maketx makes it
constexpr int largest_chain_side = 16384;

void require_chain(const ExrChain& chain) {
  const auto& levels = chain.levels;
  if (levels.empty()) throw std::logic_error("a chain has a level");
  const Image& finest = levels.front();
  const bool is_whole = static_cast<int>(levels.size()) == mip_level_count(finest.width, finest.height);
  if (levels.size() > 1 && !is_whole) throw std::logic_error("a chain goes down to one texel");
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const bool fits = levels[i].width == std::max(finest.width >> i, 1) &&
                      levels[i].height == std::max(finest.height >> i, 1) && levels[i].channels == finest.channels;
    if (!fits) throw std::logic_error("the sizes of the levels do not form a mip chain");
  }
  if (chain.channels.size() != static_cast<std::size_t>(finest.channels))
    throw std::logic_error("every channel has a name");
}

OIIO::ImageSpec spec_of(const ExrChain& chain, std::size_t level, ExrTexel texel) {
  const Image& image = chain.levels[level];
  OIIO::ImageSpec spec(image.width, image.height, image.channels,
                       texel == ExrTexel::half ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT);
  spec.channelnames = chain.channels;
  spec.alpha_channel = -1;  // numbers, none of which is a coverage
  spec.attribute("compression", "zip");
  spec.attribute("oiio:ColorSpace", "Linear");
  spec.attribute("DateTime", "");  // else OpenImageIO stamps the hour, and equal maps are different files
  if (chain.levels.size() > 1) {
    spec.tile_width = spec.tile_height = exr_tile;
    spec.attribute("textureformat", "Plain Texture");  // which makes OpenImageIO write levels
    spec.attribute("openexr:roundingmode", 0);         // floor(n / 2), OpenGL's sizes
  }
  return spec;
}

bool write_level(OIIO::ImageOutput& output, const std::string& name, const ExrChain& chain, std::size_t level,
                 ExrTexel texel) {
  const auto mode = level == 0 ? OIIO::ImageOutput::Create : OIIO::ImageOutput::AppendMIPLevel;
  return output.open(name, spec_of(chain, level, texel), mode) &&
         output.write_image(OIIO::TypeDesc::FLOAT, chain.levels[level].texels.data());
}

std::vector<unsigned char> encoded_chain(const std::string& name, const ExrChain& chain, ExrTexel texel) {
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput target(bytes);
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("openexr", &target);
  bool whole = output != nullptr;
  for (std::size_t level = 0; whole && level < chain.levels.size(); ++level)
    whole = write_level(*output, name, chain, level, texel);
  if (whole && output->close()) return bytes;
  const std::string queued = OIIO::geterror();
  const std::string reason = output ? output->geterror() : queued;
  throw Error(ErrorKind::machine, name,
              fmt::format("cannot be encoded: {}", reason.empty() ? taken_memory_text() : reason));
}

Error damaged(const std::string& name, std::string reason) {
  if (reason.empty()) reason = OIIO::geterror();
  return {ErrorKind::usage, name, fmt::format("cannot be read: {}", reason.substr(0, reason.find('\n'))),
          "give a whole EXR"};
}

void require_readable(const OIIO::ImageSpec& spec, const std::string& name, int most_channels) {
  if (spec.width < 1 || spec.height < 1 || spec.depth != 1 || spec.deep) throw damaged(name, "it is not a flat image");
  if (spec.width > largest_chain_side || spec.height > largest_chain_side) {
    throw Error(ErrorKind::usage, name, fmt::format("declares {} x {} texels", spec.width, spec.height),
                fmt::format("at most {0} x {0} are taken; scale it down", largest_chain_side));
  }
  if (spec.nchannels > most_channels) {
    throw Error(ErrorKind::usage, name, fmt::format("has {} channels", spec.nchannels),
                fmt::format("give one with at most {}", most_channels));
  }
  const auto texels = static_cast<std::uint64_t>(spec.nchannels) * sizeof(float) * 2;  // with its chain
  require_memory(frame_bytes(static_cast<std::uint64_t>(spec.width), static_cast<std::uint64_t>(spec.height), texels),
                 name, "scale the map down, or free memory");
}

}  // namespace

void write_exr_chain(const std::filesystem::path& file, const ExrChain& chain, ExrTexel texel) {
  require_chain(chain);
  write_file_atomically(file, encoded_chain(file.string(), chain, texel));
}

ExrChain read_exr_chain(const std::filesystem::path& file, int most_channels) {
  const std::string name = file.string();
  if (!std::filesystem::exists(file)) throw Error(ErrorKind::usage, name, "there is no such file", "check the path");
  if (!is_exr(file)) throw Error(ErrorKind::usage, name, "is not an EXR", "give a whole EXR");
  OIIO::Filesystem::IOFile source(name, OIIO::Filesystem::IOProxy::Read);
  OIIO::Filesystem::IOProxy* proxy = &source;
  OIIO::ImageSpec config;
  config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, static_cast<void*>(&proxy));
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create("openexr", false, &config, proxy);
  OIIO::ImageSpec spec;
  if (!input || !input->open(name, spec, config)) throw damaged(name, input ? input->geterror() : std::string());
  ExrChain chain{.levels = {}, .channels = spec.channelnames};
  for (int level = 0; input->seek_subimage(0, level, spec); ++level) {
    require_readable(spec, name, most_channels);
    Image& image = chain.levels.emplace_back(spec.width, spec.height, spec.nchannels);
    if (!input->read_image(0, level, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, image.texels.data()))
      throw damaged(name, input->geterror());
  }
  (void)input->geterror();  // that there is no further level
  return chain;
}

}  // namespace footprint
