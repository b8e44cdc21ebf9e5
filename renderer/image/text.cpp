// OpenImageIO draws the text, centred on a point, straight into the picture's own memory.
#include "renderer/image/text.hpp"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <fmt/format.h>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

using namespace OIIO::ImageBufAlgo;

Error no_font(const std::string& font) {
  return {ErrorKind::machine, "captions", fmt::format("the font {} was not found", font),
          "install the package fonts-dejavu-core"};
}

}  // namespace

int text_width(const std::string& text, int size, const std::string& font) {
  if (text.empty()) return 0;
  const OIIO::ROI extent = text_size(text, size, font);
  if (!extent.defined()) throw no_font(font);
  return extent.width();
}

void draw_text(Image& picture, int x, int y, const std::string& text, int size, const std::string& font) {
  if (text.empty()) return;
  const OIIO::ImageSpec spec(picture.width, picture.height, picture.channels, OIIO::TypeDesc::FLOAT);
  OIIO::ImageBuf canvas(spec, picture.texels.data());  // draws into the picture's own memory
  if (!render_text(canvas, x, y, text, size, font, 1.0F, TextAlignX::Center, TextAlignY::Center)) throw no_font(font);
}

}  // namespace footprint
