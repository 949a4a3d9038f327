#pragma once

#include <string>

#include "wheatstone/pictures/find_faces.h"

namespace wheatstone {

/// Finds faces with the cascade in a file; false where it cannot be read. It is of a module, because OpenCV's objdetect
/// loads all libraries of its networks.
using FindFaces = bool(const std::string& cascade, ImageView<const Rgb8> picture, int searched_width_px,
                       std::vector<PixelBox>& faces);
inline constexpr auto faces_module_name = "wheatstone_objdetect";
inline constexpr std::size_t faces_module_bytes = std::size_t{128} << 20;
inline constexpr auto find_faces_name = "wheatstone_find_faces";

}  // namespace wheatstone
