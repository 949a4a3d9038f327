#include "match_options.h"

#include <array>

namespace wheatstone::cli {
namespace {

DisparityRange parse_range(const std::string& option, const std::string& words) {
  const std::vector<int> ends = parse_integers(option, words, {':', 2, {-65535, 65535}, "MIN:MAX, as 0:64 or -20:40"});
  return {ends[0], ends[1]};
}

/// Only some methods look at a window; the refinement takes its radius from it.
bool has_window(const MatchArguments& a) {
  return a.matcher == "sgbm" || a.matcher == "bm" || a.refine == "wls" || (a.refine.empty() && a.quality == "best");
}

}  // namespace

Rows match_rows(MatchArguments& a) {
  static constexpr std::array<std::string_view, 2> refinements{"none", "wls"};
  const auto with_matcher = [&a](bool (*holds)(const MatchArguments&), const char* where) -> Reason {
    return [&a, holds, where] { return holds(a) ? fmt::format("with --matcher {}; {}", a.matcher, where) : ""; };
  };
  return under(
      "Matching",
      {row("--quality", name(a.quality, match_quality_names()),
           "Matching quality: fast matches at half the size; best finds parts of a pixel at twice the size, and with "
           "other matchers than census replaces unreliable places"),
       row("--matcher", name(a.matcher, matcher_names()),
           "Matching method: semi-global matching of census transforms from coarse to fine, OpenCV's semi-global or "
           "block matching, scan-line dynamic programming, or a network (--model)"),
       row("--model", text(a.model),
           "Network (.onnx) for --matcher onnx: takes left and right, 1x3xHxW each or stacked 1x6xHxW; returns a "
           "disparity map",
           {with_matcher([](const MatchArguments& m) { return m.matcher != "onnx"; }, "it works with onnx")},
           "--matcher"),
       row("--model-values", name(a.model_values, network_values_names()),
           "Value range of the network's inputs: 0..255, 0..1, or ImageNet's normalisation", {}, "--model"),
       row("--range", parsed(a.range, parse_range),
           "Disparity range MIN:MAX in pixels; estimated from the pair by default",
           {with_matcher([](const MatchArguments& m) { return m.matcher == "onnx"; },
                         "the network has its own range")}),
       row("--block", number(a.block_px, {1, 51}), "Side of the matching window in pixels, an odd number",
           {with_matcher([](const MatchArguments& m) { return !has_window(m); }, "it works with sgbm and bm")}),
       row("--no-left-right-check", flag(a.no_left_right_check), "Skip the left-right consistency check"),
       row("--refine", name(a.refine, refinements),
           "Edge-aware refinement of the disparity; chosen by --quality by default")});
}

MatchOptions match_options_from(const MatchArguments& arguments) {
  MatchOptions options = match_options_for(*match_quality_by_name(arguments.quality));
  options.matcher = *matcher_by_name(arguments.matcher);
  if (options.matcher == Matcher::onnx && arguments.model.empty())
    throw Error(ErrorKind::wrong_usage, "--matcher: onnx needs a network, expected --model FILE.onnx");
  options.model = arguments.model;
  options.model_values = *network_values_by_name(arguments.model_values);
  if (arguments.range) options.range = *arguments.range;
  options.block_px = arguments.block_px;
  options.left_right_check = !arguments.no_left_right_check;
  if (!arguments.refine.empty()) {
    options.wls = arguments.refine == "wls";
    options.wls_keeps_confirmed = false;
  }
  return options;
}

}  // namespace wheatstone::cli
