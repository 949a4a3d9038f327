#pragma once

#include <string_view>

namespace wheatstone {

/// What every page has between its tags, and its SHA-256 in hexadecimal digits.
struct PageText {
  std::string_view text, sha256;
};

extern const PageText page_code;   ///< the script: page/*.ts in one file
extern const PageText page_style;  ///< page/page.css

}  // namespace wheatstone
