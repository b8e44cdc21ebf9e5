// The chunks of a PNG that declare what its colours are.
#pragma once

#include <OpenImageIO/filesystem.h>

#include <string>

#include "renderer/image/declarations.hpp"

namespace footprint {

/// Walks a PNG to its end, and takes what its chunks eXIf, cICP, iCCP, sRGB, gAMA and cHRM declare. Of the last five
/// the first one in this order counts, as the PNG specification says. Throws Error (usage): the file ends early.
void read_png_chunks(OIIO::Filesystem::IOProxy& source, const std::string& name, Declarations& declared);

}  // namespace footprint
