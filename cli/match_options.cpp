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

CLI::IsMember one_of(std::span<const std::string_view> names) {
  return CLI::IsMember(std::vector<std::string>(names.begin(), names.end()));
}

}  // namespace

void add_match_options(CLI::App& command, MatchArguments& arguments) {
  constexpr auto group = "Matching";
  command
      .add_option("--quality", arguments.quality,
                  "fast (at half the size), good, or best (doubtful places replaced, edges refined)")
      ->check(one_of(match_quality_names()))
      ->capture_default_str()
      ->group(group);
  CLI::Option* matcher = command.add_option(
      "--matcher", arguments.matcher,
      "How pixels are matched: sgbm, bm, dp (scan-line dynamic programming), or onnx (a network, --model)");
  matcher->check(one_of(matcher_names()))->capture_default_str()->group(group);
  CLI::Option* model = command.add_option(
      "--model", arguments.model,
      "Network for --matcher onnx: takes left and right, 1x3xHxW each or stacked 1x6xHxW; gives a disparity map");
  model->needs(matcher)->group(group);
  command
      .add_option("--model-values", arguments.model_values,
                  "What the network's pictures consist of: 255 (0..255), 1 (0..1), or imagenet")
      ->check(one_of(network_values_names()))
      ->needs(model)
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
  command
      .add_option("--refine", arguments.refine, "Edge-aware refinement: none or wls; as --quality has it if not given")
      ->check(CLI::IsMember({"none", "wls"}))
      ->group(group);
}

MatchOptions match_options_from(const MatchArguments& arguments) {
  MatchOptions options = match_options_for(*match_quality_by_name(arguments.quality));
  options.matcher = *matcher_by_name(arguments.matcher);
  if (options.matcher == Matcher::onnx && arguments.model.empty())
    throw Error(ErrorKind::wrong_usage, "--matcher onnx needs --model FILE");
  if (options.matcher != Matcher::onnx && !arguments.model.empty())
    throw Error(ErrorKind::wrong_usage, "--model is for --matcher onnx only");
  options.model = arguments.model;
  options.model_values = *network_values_by_name(arguments.model_values);
  if (!arguments.range.empty()) options.range = parse_range(arguments.range);
  options.block_px = arguments.block_px;
  options.left_right_check = !arguments.no_check;
  if (!arguments.refine.empty()) {
    options.wls = arguments.refine == "wls";
    options.wls_keeps_confirmed = false;
  }
  return options;
}

}  // namespace wheatstone::cli
