// Finds the format by the first bytes, and opens the file by libwebp or OpenImageIO.
#include "renderer/image/opened_image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <numeric>
#include <string_view>
#include <utility>

#include "renderer/core/memory.hpp"
#include "renderer/image/png_chunks.hpp"
#include "renderer/image/radiance_header.hpp"
#include "renderer/image/webp_file.hpp"

namespace footprint {
namespace {

using IOProxy = OIIO::Filesystem::IOProxy;

struct Signature {
  std::size_t offset;
  std::string_view bytes;
  const char* format;  // OpenImageIO's name
};

// The format by the first bytes, because glTF buffers have no names and names may be wrong.
constexpr std::array<Signature, 10> signatures{{{0, "\x89PNG\r\n\x1a\n", "png"},
                                                {0, "\xff\xd8\xff", "jpeg"},
                                                {0, "\x76\x2f\x31\x01", "openexr"},
                                                {0, "#?", "hdr"},
                                                {0, {"II*\0", 4}, "tiff"},
                                                {0, {"MM\0*", 4}, "tiff"},
                                                {0, {"II+\0", 4}, "tiff"},  // BigTIFF
                                                {0, {"MM\0+", 4}, "tiff"},
                                                {0, "BM", "bmp"},
                                                {8, "WEBP", "webp"}}};

// OpenImageIO ends some messages with line breaks and repeats others.
std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

// The reason that the reader gives, or else the one in OpenImageIO's queue of this thread, which must not be left for
// the next caller to find.
std::string reason_of_failure(const OIIO::ImageInput* input) {
  const std::string queued = OIIO::geterror();
  const std::string own = input != nullptr ? input->geterror() : std::string{};
  const std::string reason = first_line(own.empty() ? queued : own);
  return reason.empty() ? "it is damaged" : reason;
}

std::string detect_format(IOProxy& source, const std::string& name) {
  std::array<char, 16> head{};
  if (source.size() == 0) throw unreadable_image(name, "the file is empty");
  const std::size_t length = source.pread(head.data(), std::min(head.size(), source.size()), 0);
  const std::string_view start(head.data(), length);
  for (const Signature& signature : signatures) {
    if (start.size() > signature.offset && start.substr(signature.offset).starts_with(signature.bytes)) {
      return signature.format;
    }
  }
  if (start.starts_with("\xabKTX 20")) throw unreadable_image(name, "is a KTX2 image, which is not read");
  throw unreadable_image(name, "is not an image of a known kind");
}

std::vector<unsigned char> bytes_from(IOProxy& source, std::size_t start, const std::string& name) {
  const std::size_t size = source.size() - start;
  require_memory(size, name, "give a smaller image, or free memory");
  std::vector<unsigned char> bytes(size);
  bytes.resize(source.pread(bytes.data(), size, static_cast<std::int64_t>(start)));
  return bytes;
}

Error refusal_of_chroma(const std::string& name) {
  return {ErrorKind::usage, name, "stores luminance and chroma (Y, RY, BY), which are not read", "save it as RGB"};
}

// OpenImageIO 2.4 refuses chroma of half the size in words about sampling.
Error refusal_of(const std::string& name, const std::string& reason) {
  if (reason.find("ubsampled") != std::string::npos) return refusal_of_chroma(name);
  return unreadable_image(name, fmt::format("cannot be read: {}", reason));
}

PixelWindow stored_window(const OIIO::ImageSpec& spec) { return {spec.x, spec.y, spec.width, spec.height}; }

PixelWindow shown_window(const OIIO::ImageSpec& spec) {
  return {spec.full_x, spec.full_y, spec.full_width, spec.full_height};
}

void check_window(const PixelWindow& window, const std::string& name, int side) {
  if (window.width > side || window.height > side) {
    throw Error(ErrorKind::usage, name, fmt::format("declares {} x {} texels", window.width, window.height),
                fmt::format("at most {0} x {0} are taken; scale it down", side));
  }
  constexpr int farthest = 1 << 24;
  if (window.width < 1 || window.height < 1 || std::abs(window.x) > farthest || std::abs(window.y) > farthest)
    throw unreadable_image(
        name, fmt::format("declares {} x {} texels at ({}, {})", window.width, window.height, window.x, window.y));
}

bool overlap(const PixelWindow& a, const PixelWindow& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

}  // namespace

std::unique_ptr<IOProxy> opened_source(const std::filesystem::path& file) {
  const std::string name = file.string();
  std::error_code ignored;  // opening the file will fail
  const std::filesystem::file_status status = std::filesystem::status(file, ignored);
  if (!std::filesystem::exists(status)) throw Error(ErrorKind::usage, name, "no such file", "check the path");
  if (!std::filesystem::is_regular_file(status)) throw unreadable_image(name, "is not a file");
  auto source = std::make_unique<OIIO::Filesystem::IOFile>(name, IOProxy::Read);
  if (!source->opened()) throw Error(ErrorKind::usage, name, "cannot be opened", "check its permissions");
  return source;
}

Error unreadable_image(const std::string& name, const std::string& message) {
  return {ErrorKind::usage, name, message, "give a whole PNG, JPEG, EXR, Radiance HDR, TIFF, BMP or WebP file"};
}

OpenedImage::OpenedImage(IOProxy& source, std::string name, const ImageLimits& limits)
    : name_(std::move(name)), format_(detect_format(source, name_)), limits_(limits) {
  if (format_ == "png") read_png_chunks(source, name_, declared_);
  if (format_ == "hdr") rewrite_radiance(source);
  if (format_ == "webp") {
    open_webp(source);
  } else {
    open_by_oiio(memory_ ? *memory_ : source);
  }
  check_size();
}

void OpenedImage::open_webp(IOProxy& source) {
  bytes_ = bytes_from(source, 0, name_);
  WebpHeader header = read_webp_header(bytes_, name_);
  declared_ = std::move(header.declared);
  spec_ = OIIO::ImageSpec(header.width, header.height, header.channels, OIIO::TypeDesc::UINT8);
  declared_.stored = declared_.shown = stored_window(spec_);
  channels_ = choose_channels(spec_.channelnames, false, name_);
}

// Presents the pixels behind a header in the usual order: OpenImageIO reads few of the others, and no XYZE, whose
// pixels are coded like RGBE's.
void OpenedImage::rewrite_radiance(IOProxy& source) {
  std::string head(std::min(source.size(), largest_radiance_header), '\0');
  head.resize(source.pread(head.data(), head.size(), 0));
  const RadianceHeader header = read_radiance_header(head, name_);
  declared_ = header.declared;
  check_window({0, 0, header.width, header.height}, name_, limits_.side);
  bytes_ = bytes_from(source, header.size, name_);
  const std::string plain = plain_radiance_header(header);
  bytes_.insert(bytes_.begin(), plain.begin(), plain.end());
  memory_ = std::make_unique<OIIO::Filesystem::IOMemReader>(bytes_.data(), bytes_.size());
}

void OpenedImage::open_by_oiio(IOProxy& source) {
  OIIO::ImageSpec config;
  IOProxy* proxy = &source;
  config.attribute("oiio:UnassociatedAlpha", 1);
  config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  input_ = OIIO::ImageInput::create(format_, false, &config, proxy);
  if (!input_ || !input_->open(name_, spec_, config)) throw refusal_of(name_, reason_of_failure(input_.get()));
  // OpenImageIO 2.5 calls the channels R, G and B, and converts only chroma of half the size.
  if (spec_.get_int_attribute("openexr:luminancechroma") != 0) throw refusal_of_chroma(name_);
  if (format_ == "openexr" && limits_.channels == 0) choose_part();
  take_declarations();
  if (limits_.channels == 0) {
    channels_ = choose_channels(spec_.channelnames, limits_.takes_vectors, name_);
    return;
  }
  if (spec_.nchannels < 1 || spec_.nchannels > limits_.channels) {
    throw Error(ErrorKind::usage, name_, fmt::format("has {} channels", spec_.nchannels),
                fmt::format("give one with 1 to {} channels", limits_.channels));
  }
  channels_.indices.resize(static_cast<std::size_t>(spec_.nchannels));
  std::iota(channels_.indices.begin(), channels_.indices.end(), 0);
}

// The first part with red, green and blue, or else the first one.
void OpenedImage::choose_part() {
  const int parts = spec_.get_int_attribute("oiio:subimages", 1);
  if (parts < 2) return;
  while (part_ < parts && input_->seek_subimage(part_, 0, spec_) && !names_rgb(spec_.channelnames)) ++part_;
  if (part_ == parts || !names_rgb(spec_.channelnames)) part_ = 0;
  if (!input_->seek_subimage(part_, 0, spec_)) throw unreadable_image(name_, reason_of_failure(input_.get()));
  declared_.left_out.push_back(fmt::format("{} of its {} parts is read: `{}`", part_ == 0 ? "the first" : "one", parts,
                                           std::string(spec_.get_string_attribute("oiio:subimagename"))));
}

void OpenedImage::take_declarations() {
  declared_.floats = spec_.format.is_floating_point();
  declared_.stored = declared_.shown = {0, 0, spec_.width, spec_.height};
  if (format_ == "openexr") {
    declared_.stored = stored_window(spec_);
    declared_.shown = shown_window(spec_);
  }
  if (format_ == "tiff" || format_ == "jpeg" || format_ == "openexr")
    declared_.orientation = spec_.get_int_attribute("Orientation", 1);
  if (format_ == "tiff" || format_ == "jpeg") {
    declared_.profile = std::string(spec_.get_string_attribute("ICCProfile:profile_description"));
    declared_.associated = format_ == "tiff" && spec_.get_int_attribute("oiio:UnassociatedAlpha", 0) == 0;
  }
  if (const auto* found = spec_.find_attribute("chromaticities", {OIIO::TypeDesc::FLOAT, 8})) {
    const auto* values = static_cast<const float*>(found->data());
    std::copy_n(values, 8, declared_.chromaticities.emplace().begin());
  }
}

void OpenedImage::check_size() const {
  if (spec_.width < 1 || spec_.height < 1 || spec_.depth != 1 || spec_.deep) {
    throw unreadable_image(name_,
                           fmt::format("is not a flat image ({} x {} x {})", spec_.width, spec_.height, spec_.depth));
  }
  check_window(declared_.stored, name_, limits_.side);
  check_window(declared_.shown, name_, limits_.side);
  if (!overlap(declared_.stored, declared_.shown))
    throw unreadable_image(name_, "stores no pixel within its picture (data and display window)");
}

Image OpenedImage::texels() {
  const std::vector<int>& wanted = channels_.indices;
  require_memory(frame_bytes(spec_.width, spec_.height, wanted.size() * sizeof(float)), name_,
                 "scale the image down, or free memory");
  if (!input_) {
    const WebpHeader header{spec_.width, spec_.height, spec_.nchannels, {}};
    return decode_webp(bytes_, header, name_);
  }
  Image image(spec_.width, spec_.height, static_cast<int>(wanted.size()));
  const auto stride = static_cast<OIIO::stride_t>(wanted.size() * sizeof(float));
  for (std::size_t i = 0; i < wanted.size();) {
    std::size_t count = 1;  // of channels that follow one another in the file, too
    while (i + count < wanted.size() && wanted[i + count] == wanted[i] + static_cast<int>(count)) ++count;
    const int first = wanted[i];
    // The JPEG reader fills missing data, returns success and leaves a message.
    if (!input_->read_image(part_, level_, first, first + static_cast<int>(count), OIIO::TypeDesc::FLOAT,
                            image.texels.data() + i, stride) ||
        input_->has_error())
      throw unreadable_image(name_, fmt::format("is truncated or damaged: {}", reason_of_failure(input_.get())));
    i += count;
  }
  return image;
}

bool OpenedImage::seek_level(int level) {
  if (!input_ || !input_->seek_subimage(part_, level, spec_)) {
    if (input_) (void)input_->geterror();  // clears the message that no level follows
    return false;
  }
  level_ = level;
  take_declarations();
  check_size();
  return true;
}

}  // namespace footprint
