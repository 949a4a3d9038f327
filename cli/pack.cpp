#include <fmt/format.h>
#include <fmt/ostream.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "command.h"
#include "numbers_argument.h"
#include "output_option.h"
#include "packing.h"
#include "views_argument.h"
#include "wheatstone/display/arrange.h"
#include "wheatstone/error.h"
#include "write_views_output.h"

namespace wheatstone::cli {
namespace {

struct Arguments {
  ViewsArguments input;
  PackingArguments packing;
  std::string output;
  float shift_px = 0;
  std::string floating_window;
};

/// The views of which the packing needs all: shifted, and with the window where it is wanted.
std::vector<Image<Rgb8>> adjusted(std::vector<Image<Rgb8>> views, const Arguments& arguments) {
  if (arguments.shift_px != 0) views = shifted_views(std::move(views), arguments.shift_px);
  if (!arguments.floating_window.empty()) {
    if (views.size() != 2)
      throw Error(ErrorKind::wrong_usage,
                  fmt::format("--floating-window: is for two views, but there are {}", views.size()));
    const std::vector<float> strips = parse_numbers("--floating-window", arguments.floating_window, ',', 2);
    StereoPair pair{std::move(views[0]), std::move(views[1])};
    put_floating_window(pair, static_cast<int>(strips[0]), static_cast<int>(strips[1]));
    views[0] = std::move(pair.left);
    views[1] = std::move(pair.right);
  }
  return views;
}

void run(const Arguments& arguments, const Session& session) {
  // What cannot be packed is said before anything is read.
  const Packing packing = find_packing(arguments.packing, arguments.output);
  ViewsOutput output{arguments.output, files_read(arguments.input)};
  output.inputs.emplace_back(arguments.packing.screen);
  check_views_output(output);
  ReadViews read = read_views_argument(arguments.input, views_wanted(packing), session);
  const std::vector<Image<Rgb8>> views = adjusted(std::move(read.views), arguments);
  const std::string written = write_packed({packing, arguments.packing, views, output, session});
  if (session.json) {
    const nlohmann::ordered_json facts{{"output", written},
                                       {"packing", packing.name},
                                       {"views", views.size()},
                                       {"width", views.front().width()},
                                       {"height", views.front().height()},
                                       {"input", read.how}};
    fmt::print(session.output, "{}\n", facts.dump(2));
    return;
  }
  if (session.verbose)
    fmt::print(session.output, "{} views of {}x{} pixels, {}\n", views.size(), views.front().width(),
               views.front().height(), read.how);
  fmt::print(session.output, "written to {}\n", written);
}

}  // namespace

void add_pack_command(CLI::App& program, const Session& session) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = program.add_subcommand("pack", "Put views into the format of a display");
  add_views_arguments(*command, arguments->input);
  add_output_option(*command, arguments->output, "File; or for quilts its stem, for views a folder")->required();
  add_packing_options(*command, arguments->packing);
  command->add_option("--shift", arguments->shift_px,
                      "Move the views apart by so many pixels from each to the next: what has this disparity comes to "
                      "lie on the screen");
  command->add_option("--zero-parallax", arguments->shift_px, "The same")->excludes("--shift");
  command->add_option("--floating-window", arguments->floating_window,
                      "LEFT,RIGHT pixels of black at the left eye's left and the right eye's right edge");
  command->footer(
      "Examples:\n"
      "  wheatstone pack photograph.mpo --to anaglyph -o anaglyph.png\n"
      "  wheatstone pack left.png right.png --to top-bottom-half -o tv.jpg\n"
      "  wheatstone pack left.png right.png -o photograph.mpo\n"
      "  wheatstone pack views --to lenticular --screen step-9 -o screen.png\n"
      "  wheatstone pack views --to quilt --quilt 8x6 -o universe");
  command->callback([arguments, &session] { run(*arguments, session); });
}

}  // namespace wheatstone::cli
