#include <fmt/format.h>
#include <fmt/ostream.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "command.h"
#include "device_option.h"
#include "number_arguments.h"
#include "output_option.h"
#include "packing.h"
#include "print_facts.h"
#include "typed_options.h"
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
  int max_size = 0;  ///< longer side of what is matched; 0: as large as it is
  std::string floating_window;
};

/// The views of which the packing needs all: shifted, and with the window where it is wanted.
std::vector<Image<Rgb8>> adjusted(std::vector<Image<Rgb8>> views, const PackArguments& arguments) {
  if (arguments.shift_px != 0) views = shifted_views(std::move(views), arguments.shift_px);
  if (!arguments.floating_window.empty()) {
    if (views.size() != 2)
      throw Error(ErrorKind::wrong_usage,
                  fmt::format("--floating-window: is for two views, but there are {}", views.size()));
    const std::vector<int> strips =
        parse_integers("--floating-window", arguments.floating_window, {',', 2, {0, 65535}, "LEFT,RIGHT"});
    const int width = views[0].width();
    if (strips[0] + strips[1] >= width)
      throw Error(ErrorKind::wrong_usage, fmt::format("--floating-window: is '{}', which leaves nothing of {} pixels",
                                                      arguments.floating_window, width));
    StereoPair pair{std::move(views[0]), std::move(views[1])};
    put_floating_window(pair, strips[0], strips[1]);
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
  const bool untouched = arguments.shift_px == 0 && arguments.floating_window.empty() && !input.swap &&
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

void run_pack(const PackArguments& arguments, const CLI::App& command, const Session& session) {
  // What cannot be packed is said before anything is read.
  const Packing packing = find_packing(arguments.packing, arguments.output);
  check_packing(command, packing, arguments.output);
  ViewsOutput output{arguments.output, files_read(arguments.input), arguments.packing.format};
  output.inputs.emplace_back(arguments.packing.screen);
  check_views_output(output);
  ReadViews read = read_views_argument(input_of(arguments, packing, session), views_wanted(packing), command, session);
  if (arguments.max_size > 0 && !read.views.empty()) reduce(read.views, arguments.max_size);
  const std::vector<Image<Rgb8>> views = adjusted(std::move(read.views), arguments);
  report(session.progress, "packing", 0);
  const std::string written = write_packed({packing, arguments.packing, views, read.composed, output, session});
  const std::size_t count = views.empty() ? static_cast<std::size_t>(read.count) : views.size();
  const PictureSize size = views.empty() ? read.size : PictureSize{views.front().width(), views.front().height()};
  if (session.json) {
    const nlohmann::ordered_json facts{{"output", written},   {"packing", packing.name}, {"views", count},
                                       {"width", size.width}, {"height", size.height},   {"input", read.how}};
    print_facts(facts, session);
    return;
  }
  if (session.verbose)
    fmt::print(session.output, "{} views of {}x{} pixels, {}\n", count, size.width, size.height, read.how);
  fmt::print(session.output, "written to {}\n", written);
}

}  // namespace

void add_pack_command(CLI::App& program, const Session& session) {
  auto arguments = std::make_shared<PackArguments>();
  CLI::App* command = program.add_subcommand("pack", "Convert views to the format of a display");
  add_views_arguments(*command, arguments->input);
  add_device_option(*command, arguments->input.device, "What draws the views of a painting");
  add_output_option(*command, arguments->output, "File; a folder for views; the stem of the file for a quilt")
      ->required();
  add_packing_options(*command, arguments->packing);
  add_number(*command, "--zero-parallax,--shift", arguments->shift_px, {-65535, 65535},
             "Disparity in pixels, from each view to the next, that lies on the screen plane");
  add_number(*command, "--max-size", arguments->max_size, {16, 65535},
             "Match a reduced copy whose longer side has at most this many pixels")
      ->default_str("");
  command->add_option(
      "--floating-window", arguments->floating_window,
      "Width LEFT,RIGHT in pixels of the black strips at the left edge of the left view and the right edge "
      "of the right view");
  command->footer(
      "Examples:\n"
      "  wheatstone pack photograph.mpo --to anaglyph -o anaglyph.png\n"
      "  wheatstone pack left.png right.png --to top-bottom-half -o tv.jpg\n"
      "  wheatstone pack left.png right.png -o photograph.mpo\n"
      "  wheatstone pack views --to lenticular --screen step-9 -o screen.png\n"
      "  wheatstone pack views --to quilt --quilt 8x6 -o universe");
  command->callback([arguments, command, &session] { run_pack(*arguments, *command, session); });
}

}  // namespace wheatstone::cli
