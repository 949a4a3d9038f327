#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace wheatstone::viewer {

using Words = std::vector<std::string>;

/// The words of a line: separated by white space, but for what stands in double quotes. Empty lines, and those that
/// begin with #, have none. Throws Error{wrong_usage} where a quote is not closed.
Words words_of(std::string_view line);

// What a word says. They throw Error{wrong_usage}, as "'a' is no number".

double number_of(const std::string& word);
double number_of(const std::string& word, double least, double most);
bool switch_of(const std::string& word);  ///< "on" or "off"

}  // namespace wheatstone::viewer
