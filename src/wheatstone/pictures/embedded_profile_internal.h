#pragma once

#include <string>
#include <string_view>

namespace wheatstone {

/// The ICC profile in the bytes of a PNG (chunk iCCP), WebP (chunk ICCP) or HEIF file, whose decoders do not hand it
/// on; empty where there is none, or a damaged one, and for all other kinds of file.
std::string embedded_profile(std::string_view bytes);

}  // namespace wheatstone
