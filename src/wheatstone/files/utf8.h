#pragma once

#include <cstddef>
#include <string_view>

namespace wheatstone {

/// The bytes of the UTF-8 character that the text, which is not empty, begins with; 0 where it begins with none
/// (RFC 3629, section 4).
std::size_t utf8_character_bytes(std::string_view text);

/// Whether all of the text is UTF-8.
bool is_utf8(std::string_view text);

}  // namespace wheatstone
