#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "commands.h"
#include "device_option.h"
#include "packing.h"
#include "stereo_arguments.h"
#include "views_argument.h"
#include "wheatstone/display/arrange.h"
#include "wheatstone/error.h"
#include "wheatstone/stereo/reduced_pair.h"
#include "write_views_output.h"

namespace wheatstone::cli {
namespace {

struct PackArguments {
  ViewsArguments input;
  PackingArguments packing;
  std::string output;
  float shift_px = 0;
  int max_size = 0;                                   ///< longer side of what is matched; 0: as large as it is
  std::optional<std::array<int, 2>> floating_window;  ///< widths of the strips, left and right
};

/// The views of which the packing needs all: shifted, and with the window where it is wanted.
std::vector<Image<Rgb8>> adjusted(std::vector<Image<Rgb8>> views, const PackArguments& arguments) {
  if (arguments.shift_px != 0) views = shifted_views(std::move(views), arguments.shift_px);
  if (arguments.floating_window) {
    if (views.size() != 2)
      throw Error(ErrorKind::wrong_usage,
                  fmt::format("--floating-window: is for two views, but there are {}", views.size()));
    const auto [left, right] = *arguments.floating_window;
    const int width = views[0].width();
    if (left + right >= width)
      throw Error(ErrorKind::wrong_usage,
                  fmt::format("--floating-window: is '{},{}', which leaves nothing of {} pixels", left, right, width));
    StereoPair pair{std::move(views[0]), std::move(views[1])};
    put_floating_window(pair, left, right);
    views[0] = std::move(pair.left);
    views[1] = std::move(pair.right);
  }
  return views;
}

/// What to read, and how. A graphics processor that draws the views of a painting puts them into one picture, too,
/// where nothing is done to them before.
ViewsArguments input_of(const PackArguments& arguments, const Packing& packing, const Session& session) {
  ViewsArguments input = arguments.input;
  settle_device(input.device, session);
  const int views = packing.format->views;
  const bool untouched = arguments.shift_px == 0 && !arguments.floating_window && !input.swap &&
                         (views == 0 || input.views == 0 || input.views == views);
  if (input.device != Device::processor && packing.format->composition && untouched)
    input.composition = packing.format->composition(packing);
  return input;
}

/// Makes the views smaller where their longer side is above `longest_px`.
void reduce(std::vector<Image<Rgb8>>& views, int longest_px) {
  const PictureSize whole{views.front().width(), views.front().height()};
  const PictureSize size = reduced_size(whole, longest_px);
  if (size.width == whole.width && size.height == whole.height) return;
  for (Image<Rgb8>& view : views) view = reduced(view, size);
}

Report run_pack(const PackArguments& arguments, const Session& session) {
  // What cannot be packed is said before anything is read.
  const Packing packing = find_packing(arguments.packing, arguments.output);
  check_ending(packing, arguments.output);
  ViewsOutput output{arguments.output, files_read(arguments.input), arguments.packing.format};
  output.inputs.emplace_back(arguments.packing.screen);
  check_views_output(output);
  ReadViews read = read_views_argument(input_of(arguments, packing, session), views_wanted(packing), session);
  if (arguments.max_size > 0 && !read.views.empty()) reduce(read.views, arguments.max_size);
  const std::vector<Image<Rgb8>> views = adjusted(std::move(read.views), arguments);
  report(session.progress, "packing", 0);
  const std::string written = write_packed({packing, arguments.packing, views, read.composed, output, session});
  const std::size_t count = views.empty() ? static_cast<std::size_t>(read.count) : views.size();
  const PictureSize size = views.empty() ? read.size : PictureSize{views.front().width(), views.front().height()};
  return {
      {{"views", count,
        session.verbose ? fmt::format("{} views of {}x{} pixels, {}", count, size.width, size.height, read.how) : ""},
       {"output", written, fmt::format("written to {}", written)},
       {"packing", packing.name},
       {"width", size.width},
       {"height", size.height},
       {"input", read.how}}};
}

Rows pack_rows(PackArguments& a) {
  const auto parse_strips = [](const std::string& option, const std::string& words) {
    const std::vector<int> strips = parse_integers(option, words, {',', 2, {0, 65535}, "LEFT,RIGHT"});
    return std::array{strips[0], strips[1]};
  };
  Row max_size = max_size_row(a.max_size, {unless_matched(a.packing, a.output)});
  max_size.help = "Match a reduced copy whose longer side has at most this many pixels";
  return join({views_rows(a.input),
               {views_device_row(a.input), row("-o,--output", required(output_name(a.output)),
                                               "File; a folder for views; the stem of the file for a quilt")},
               packing_rows(a.packing, a.output),
               {row("--zero-parallax,--shift", number(a.shift_px, {-65535, 65535}),
                    "Disparity in pixels, from each view to the next, that lies on the screen plane"),
                max_size,
                row("--floating-window", parsed(a.floating_window, parse_strips),
                    "Width LEFT,RIGHT in pixels of the black strips at the left edge of the left view and the right "
                    "edge of the right view")}});
}

}  // namespace

Command pack_command() {
  return make_command("pack", "Convert views to the format of a display", pack_rows, run_pack,
                      R"(Examples:
  wheatstone pack photograph.mpo --to anaglyph -o anaglyph.png
  wheatstone pack left.png right.png --to top-bottom-half -o tv.jpg
  wheatstone pack left.png right.png -o photograph.mpo
  wheatstone pack views --to lenticular --screen step-9 -o screen.png
  wheatstone pack views --to quilt --quilt 8x6 -o universe)");
}

}  // namespace wheatstone::cli
