#include "match_options.h"

#include <fmt/format.h>

#include <charconv>

#include "wheatstone/error.h"

namespace wheatstone::cli {
namespace {

DisparityRange parse_range(const std::string& text) {
  DisparityRange range;
  const char* end = text.data() + text.size();
  const auto least = std::from_chars(text.data(), end, range.least);
  const bool colon = least.ec == std::errc{} && least.ptr != end && *least.ptr == ':';
  const auto largest = colon ? std::from_chars(least.ptr + 1, end, range.largest) : least;
  if (!colon || largest.ec != std::errc{} || largest.ptr != end)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("--range: is '{}', expected LEAST:LARGEST, as 0:64 or -20:40", text));
  return range;
}

}  // namespace

void add_match_options(CLI::App& command, MatchArguments& arguments) {
  constexpr auto group = "Matching";
  const auto names = matcher_names();
  command
      .add_option("--matcher", arguments.matcher,
                  "How pixels are matched: sgbm, bm, or dp (scan-line dynamic programming)")
      ->check(CLI::IsMember(std::vector<std::string>(names.begin(), names.end())))
      ->capture_default_str()
      ->group(group);
  command
      .add_option("--range", arguments.range,
                  "Disparities looked for, LEAST:LARGEST in pixels; found by itself if not given")
      ->group(group);
  command.add_option("--block", arguments.block_px, "Side of the compared windows, an odd number of pixels")
      ->capture_default_str()
      ->group(group);
  command.add_flag("--no-check", arguments.no_check, "Believe what the other view does not confirm")->group(group);
  command.add_option("--refine", arguments.refine, "Edge-aware refinement: none or wls")
      ->check(CLI::IsMember({"none", "wls"}))
      ->capture_default_str()
      ->group(group);
}

MatchOptions match_options_from(const MatchArguments& arguments) {
  MatchOptions options;
  options.matcher = *matcher_by_name(arguments.matcher);
  if (!arguments.range.empty()) options.range = parse_range(arguments.range);
  options.block_px = arguments.block_px;
  options.left_right_check = !arguments.no_check;
  options.wls = arguments.refine == "wls";
  return options;
}

}  // namespace wheatstone::cli
