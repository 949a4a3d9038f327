#include "match_options.h"

#include <fmt/format.h>

#include <array>
#include <string_view>
#include <vector>

#include "number_arguments.h"
#include "option_use.h"
#include "typed_options.h"
#include "wheatstone/error.h"

namespace wheatstone::cli {
namespace {

DisparityRange parse_range(const std::string& text) {
  const std::vector<int> ends =
      parse_integers("--range", text, {':', 2, {-65535, 65535}, "MIN:MAX, as 0:64 or -20:40"});
  return {ends[0], ends[1]};
}

}  // namespace

void add_match_options(CLI::App& command, MatchArguments& arguments) {
  constexpr auto group = match_options_group;
  add_name(command, "--quality", arguments.quality, match_quality_names(),
           "Matching quality: fast matches at half the size; best finds parts of a pixel at twice the size, and with "
           "other matchers than census replaces unreliable places")
      ->group(group);
  CLI::Option* matcher = add_name(command, "--matcher", arguments.matcher, matcher_names(),
                                  "Matching method: semi-global matching of census transforms from coarse to fine, "
                                  "OpenCV's semi-global or block matching, scan-line dynamic programming, or a "
                                  "network (--model)")
                             ->group(group);
  CLI::Option* model =
      command
          .add_option("--model", arguments.model,
                      "Network (.onnx) for --matcher onnx: takes left and right, 1x3xHxW each or stacked 1x6xHxW; "
                      "returns a disparity map")
          ->needs(matcher)
          ->group(group);
  add_name(command, "--model-values", arguments.model_values, network_values_names(),
           "Value range of the network's inputs: 0..255, 0..1, or ImageNet's normalisation")
      ->needs(model)
      ->group(group);
  command
      .add_option("--range", arguments.range, "Disparity range MIN:MAX in pixels; estimated from the pair by default")
      ->group(group);
  add_number(command, "--block", arguments.block_px, {1, 51}, "Side of the matching window in pixels, an odd number")
      ->group(group);
  command.add_flag("--no-left-right-check", arguments.no_left_right_check, "Skip the left-right consistency check")
      ->group(group);
  static constexpr std::array<std::string_view, 2> refinements{"none", "wls"};
  add_name(command, "--refine", arguments.refine, refinements,
           "Edge-aware refinement of the disparity; chosen by --quality by default")
      ->group(group);
}

MatchOptions match_options_from(const MatchArguments& arguments) {
  MatchOptions options = match_options_for(*match_quality_by_name(arguments.quality));
  options.matcher = *matcher_by_name(arguments.matcher);
  if (options.matcher == Matcher::onnx && arguments.model.empty())
    throw Error(ErrorKind::wrong_usage, "--matcher: onnx needs a network, expected --model FILE.onnx");
  if (options.matcher != Matcher::onnx && !arguments.model.empty())
    throw Error(ErrorKind::wrong_usage,
                fmt::format("--model: has no effect with --matcher {}; it works with onnx", arguments.matcher));
  options.model = arguments.model;
  options.model_values = *network_values_by_name(arguments.model_values);
  if (!arguments.range.empty()) options.range = parse_range(arguments.range);
  options.block_px = arguments.block_px;
  options.left_right_check = !arguments.no_left_right_check;
  if (!arguments.refine.empty()) {
    options.wls = arguments.refine == "wls";
    options.wls_keeps_confirmed = false;
  }
  return options;
}

void refuse_match_options_without_effect(const CLI::App& command, const MatchArguments& arguments,
                                         const std::string& disparity_given) {
  if (!disparity_given.empty())
    refuse_group(command, match_options_group, {}, disparity_given, "nothing is matched where the disparity is given");
  const std::string situation = fmt::format("with --matcher {}", arguments.matcher);
  // The refinement takes its radius from the window.
  const bool refines = arguments.refine == "wls" || (arguments.refine.empty() && arguments.quality == "best");
  if (arguments.matcher != "sgbm" && arguments.matcher != "bm" && !refines)
    refuse_options(command, {"--block"}, situation, "it works with sgbm and bm");
  if (arguments.matcher == "onnx") refuse_options(command, {"--range"}, situation, "the network has its own range");
}

}  // namespace wheatstone::cli
