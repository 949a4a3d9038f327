#pragma once

#include <string>
#include <string_view>

namespace wheatstone {

/// A page that shows the pictures of a result folder, by their names there, and the report's numbers below them.
/// `format` is the ending of the pictures that are painted.
std::string gallery_html(std::string_view format, std::string_view report_json);

}  // namespace wheatstone
