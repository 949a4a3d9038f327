#pragma once

#include <iosfwd>
#include <string>

namespace wheatstone {

/// What is wrong with the header of an OpenEXR picture: an attribute that is longer than what follows in the file, for
/// which OpenEXR allocates up to 2 GiB before it finds that the file ends; or a channel whose kind of numbers does not
/// exist, at which OpenImageIO ends the program. Empty where nothing is, and for everything that is not OpenEXR.
/// OpenEXR file layout, sec. "Header" and "Predefined attribute types".
std::string exr_header_complaint(std::istream& file);

}  // namespace wheatstone
