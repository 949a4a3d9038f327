#include "render_call.h"

#include <algorithm>
#include <array>
#include <regex>
#include <string_view>

#include "wheatstone/error.h"

namespace wheatstone::cli {
namespace {

constexpr std::array<std::string_view, 8> of_files{"FILE",     "--output",      "--quilt",  "--interleave",
                                                   "--values", "--save-slices", "--format", "--stream"};

/// "--look-at" as "look_at".
std::string as_named_in_calls(const std::string& message) {
  static const std::regex option("--[a-z]+(-[a-z]+)*");
  std::string changed;
  auto from = message.begin();
  for (std::sregex_iterator found(message.begin(), message.end(), option), end; found != end; ++found) {
    changed.append(from, (*found)[0].first);
    std::string name = found->str().substr(2);
    std::ranges::replace(name, '-', '_');
    changed += name;
    from = (*found)[0].second;
  }
  return changed.append(from, message.end());
}

}  // namespace

Rows call_rows(RenderArguments& arguments) {
  Rows rows = render_rows(arguments);
  std::erase_if(rows, [](const Row& row) {
    return row.heading == "Film" || row.needs == "--stream" ||
           std::ranges::find(of_files, name_of(row)) != of_files.end();
  });
  for (Row& row : rows) std::erase_if(row.excludes, [](const std::string& other) { return other == "--quilt"; });
  return rows;
}

RenderArguments arguments_of_call(const std::string& file, std::span<const NamedWords> options) try {
  RenderArguments arguments;
  arguments.file = file;
  const Rows rows = call_rows(arguments);
  arguments.given = set_rows(rows, options);
  refuse_without_effect(rows, arguments.given);
  return for_display(arguments);
} catch (const Error& error) {
  throw Error(error.kind(), as_named_in_calls(error.what()));
}

}  // namespace wheatstone::cli
