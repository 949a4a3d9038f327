#include "option_use.h"

#include <fmt/format.h>

#include <algorithm>

#include "wheatstone/error.h"

namespace wheatstone::cli {
namespace {

std::string name_of(const CLI::Option& option) {
  return option.get_lnames().empty() ? option.get_name() : "--" + option.get_lnames().front();
}

bool is_one_of(const CLI::Option& option, const std::vector<std::string>& names) {
  return std::ranges::any_of(names, [&](const std::string& name) { return option.check_name(name); });
}

[[noreturn]] void refuse_option(const std::string& option, std::string_view situation, std::string_view where) {
  throw Error(ErrorKind::wrong_usage, where.empty()
                                          ? fmt::format("{}: has no effect {}", option, situation)
                                          : fmt::format("{}: has no effect {}; {}", option, situation, where));
}

}  // namespace

bool was_given(const CLI::App& command, const std::string& option) {
  const CLI::Option* const known = command.get_option_no_throw(option);
  return known != nullptr && known->count() > 0;
}

void refuse_options(const CLI::App& command, const std::vector<std::string>& options, std::string_view situation,
                    std::string_view where) {
  for (const std::string& option : options)
    if (was_given(command, option)) refuse_option(option, situation, where);
}

void refuse_group(const CLI::App& command, const std::string& group, const std::vector<std::string>& kept,
                  std::string_view situation, std::string_view where) {
  for (const CLI::Option* option : command.get_options())
    if (option->get_group() == group && option->count() > 0 && !is_one_of(*option, kept))
      refuse_option(name_of(*option), situation, where);
}

void refuse_all_but(const CLI::App& command, const std::vector<std::string>& kept, std::string_view situation,
                    std::string_view where) {
  for (const CLI::Option* option : command.get_options())
    if (option->nonpositional() && option->count() > 0 && !is_one_of(*option, kept))
      refuse_option(name_of(*option), situation, where);
}

}  // namespace wheatstone::cli
