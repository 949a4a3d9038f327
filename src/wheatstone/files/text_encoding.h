#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace wheatstone {

/// The bytes of the UTF-8 character that the text, which is not empty, begins with; 0 where it begins with none
/// (RFC 3629, section 4).
std::size_t utf8_character_bytes(std::string_view text);

/// Whether all of the text is UTF-8.
bool is_utf8(std::string_view text);

/// The text with small letters in place of capitals (ASCII).
std::string lower_case(std::string text);

/// Text that HTML shows as it is, between tags and in quoted attributes. Always UTF-8: what is not becomes U+FFFD.
std::string html_text(std::string_view text);

/// A page of HTML up to the begin of its body. `title` is plain text; `policy` says what the page may load
/// (Content-Security-Policy), empty: anything; `scripts` stand behind the style sheet.
std::string html_head(std::string_view title, std::string_view style, std::string_view policy = {},
                      std::string_view scripts = {});

/// Bytes as text (RFC 4648), with padding and without line breaks.
std::string base64(std::string_view bytes);

}  // namespace wheatstone
