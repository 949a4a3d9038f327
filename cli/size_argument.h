#pragma once

#include <string>

namespace wheatstone::cli {

/// "960x720" as two numbers, as --size takes them. Throws Error{wrong_usage}.
void take_size(const std::string& text, int& width, int& height);

/// The same for the views of a display: from 1x1 to 16384x16384. Throws Error{wrong_usage}.
void take_view_size(const std::string& text, int& width, int& height);

}  // namespace wheatstone::cli
