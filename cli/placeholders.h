#pragma once

#include <span>
#include <string>
#include <string_view>

namespace wheatstone::cli {

/// What stands for a placeholder: {title}, as it is typed, and its text.
struct Placeholder {
  std::string_view name;  ///< without braces
  std::string text;
};

/// The words with each {name} replaced. Other braces stay as they are. Throws Error{wrong_usage} that begins with
/// `option` and lists the names where the words have a {name} that there is not.
std::string filled(const std::string& option, std::string_view words, std::span<const Placeholder> placeholders);

}  // namespace wheatstone::cli
