#pragma once

#include <iosfwd>

namespace wheatstone {

/// False where the file is an OpenEXR picture with an attribute that is longer than what follows in the file. OpenEXR
/// allocates such an attribute, up to 2 GiB, before it finds that the file ends. True for everything that is not
/// OpenEXR. OpenEXR file layout, sec. "Header".
bool exr_header_fits(std::istream& file);

}  // namespace wheatstone
