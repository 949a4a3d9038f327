#include "style_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/painting/style_parameters.h"

namespace wheatstone::cli {

namespace {

[[noreturn]] void refuse_for_marks(const StyleParameter& parameter, Marks marks) {
  std::vector<std::string_view> works_with;
  for (const Marks kind : parameter.read_by) works_with.push_back(name_of(kind));
  throw Error(ErrorKind::wrong_usage, fmt::format("--{}: has no effect on a painting of {}; it works with {}",
                                                  parameter.name, name_of(marks), fmt::join(works_with, ", ")));
}

}  // namespace

Rows style_rows(StyleArguments& arguments) {
  Rows rows{row("--style", text(arguments.style),
                fmt::format("{}, or a style file (.toml)", fmt::join(style_names(), ", ")))};
  for (const StyleParameter& parameter : style_parameters()) {
    const std::string name(parameter.name);
    const auto keep = [&arguments, name](const std::string&, const std::vector<std::string>& words) {
      arguments.changes[name] = words.front();
    };
    // "--depth-test" and "--depth-test=false" are both understood.
    if (parameter.is_switch)
      rows.push_back(
          {fmt::format("--{0},!--no-{0}", name), {keep, {}, {}, Value::Takes::nothing}, std::string(parameter.help)});
    else
      rows.push_back({"--" + name, {keep}, std::string(parameter.help)});
  }
  return under("Style", std::move(rows));
}

Style style_from(const StyleArguments& arguments, std::uint64_t seed) {
  Style style = read_style(arguments.style);
  for (const StyleParameter& parameter : style_parameters()) {
    const auto change = arguments.changes.find(std::string(parameter.name));
    if (change != arguments.changes.end()) parameter.set(style, change->second);
  }
  for (const StyleParameter& parameter : style_parameters())
    if (arguments.changes.contains(std::string(parameter.name)) && !is_read_by(parameter, style.marks))
      refuse_for_marks(parameter, style.marks);
  style.seed = seed;
  check_style(style);
  return style;
}

}  // namespace wheatstone::cli
