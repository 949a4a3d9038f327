#include "style_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "wheatstone/marks/style_parameters.h"

namespace wheatstone::cli {

void add_style_options(CLI::App& command, StyleArguments& arguments) {
  constexpr auto group = "Style";
  command
      .add_option("--style", arguments.style,
                  fmt::format("{}, or a style file (.toml)", fmt::join(style_names(), ", ")))
      ->capture_default_str()
      ->group(group);
  for (const StyleParameter& parameter : style_parameters()) {
    const std::string name(parameter.name);
    const auto keep = [&arguments, name](const std::string& text) { arguments.changes[name] = text; };
    const std::string option = "--" + name;
    if (parameter.is_switch) {
      // "--depth-test" and "--depth-test=false" are both understood.
      command
          .add_flag_function(
              option + ",!--no-" + name, [keep](std::int64_t count) { keep(count > 0 ? "true" : "false"); },
              std::string(parameter.help))
          ->group(group);
    } else {
      command.add_option_function<std::string>(option, keep, std::string(parameter.help))->group(group);
    }
  }
}

Style style_from(const StyleArguments& arguments, std::uint64_t seed) {
  Style style = read_style(arguments.style);
  for (const StyleParameter& parameter : style_parameters()) {
    const auto change = arguments.changes.find(std::string(parameter.name));
    if (change != arguments.changes.end()) parameter.set(style, change->second);
  }
  style.seed = seed;
  check_style(style);
  return style;
}

}  // namespace wheatstone::cli
