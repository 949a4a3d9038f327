#pragma once

#include <string>
#include <string_view>

namespace wheatstone {

/// Text that HTML shows as it is, between tags and in quoted attributes. Always UTF-8: what is not becomes U+FFFD.
std::string html_text(std::string_view text);

}  // namespace wheatstone
