#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace wheatstone::cli {

// An option that is accepted has an effect; one that has none in this run is refused. A command says which of its
// options have none, and where they have one.

/// Throws Error{wrong_usage} where one of these options was given, on the line or in a file of options:
/// "--scale: has no effect on photographs; it …". `situation` says what this run is, `where` what the option is for.
void refuse_options(const CLI::App& command, const std::vector<std::string>& options, std::string_view situation,
                    std::string_view where);

/// The same for all options under one heading of the help, but for `kept`.
void refuse_group(const CLI::App& command, const std::string& group, const std::vector<std::string>& kept,
                  std::string_view situation, std::string_view where);

/// Throws Error{wrong_usage} where anything but these options was given; positional arguments and the options of every
/// command are left alone.
void refuse_all_but(const CLI::App& command, const std::vector<std::string>& kept, std::string_view situation,
                    std::string_view where);

/// Whether an option was given; one that the command does not have was not.
bool was_given(const CLI::App& command, const std::string& option);

}  // namespace wheatstone::cli
