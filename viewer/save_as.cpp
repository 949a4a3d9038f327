#include "save_as.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "cli/packing.h"
#include "cli/print_options.h"
#include "output_mode.h"
#include "view_drawer.h"
#include "wheatstone/depth/display_presets.h"
#include "wheatstone/depth/rig.h"
#include "wheatstone/display/arrange.h"
#include "wheatstone/display/quilt.h"
#include "wheatstone/error.h"
#include "wheatstone/photograph/find_layout.h"
#include "wheatstone/photograph/photograph_notes.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::viewer {
namespace {

namespace fs = std::filesystem;

bool is_of_display(std::string_view format) { return format == "quilt" || format == "lenticular"; }

/// The packing as `pack` understands it. For a display it is the one that is chosen.
cli::PackingArguments packing_arguments(const std::string& format, const ViewState& state) {
  cli::PackingArguments arguments;
  arguments.to = format;
  if (!is_of_display(format)) return arguments;
  const DisplayPreset& display = find_display(state.display);
  const bool is_right = format == "quilt" ? display.quilt_columns > 0 : display.lenses.screen_width_px > 0;
  if (format == "lenticular" && !state.screen.empty())
    arguments.screen = state.screen;
  else if (is_right)
    arguments.display = display.name;
  else
    throw Error(ErrorKind::wrong_usage,
                fmt::format("{} takes no {}; choose a display that does with 'display'", display.name,
                            format == "quilt" ? "quilts" : "lenticular pictures"));
  return arguments;
}

/// Where the views stand, with what is seen of them from the side left out.
std::vector<ViewPosition> positions_of(const ViewState& state, int count) {
  return evenly_spaced(0, 0, count, state.adjustment.separation).positions;
}

std::vector<Image<Rgb8>> drawn_views(ViewDrawer& drawer, const SeenToSave& seen, int count) {
  const PictureSize own = size_of(seen.content);
  const PictureSize size = own.width > 0 ? own : seen.eye;
  const WantedPart part{1, 0, 0, size.width, size.height};
  const std::vector<ViewPosition> positions = positions_of(seen.state, count);
  const Content& content = drawer.bent(drawer.placed(seen.content, seen.state), seen.state);
  const bool shows_depth = seen.state.comparison == Comparison::depth;
  const bool photograph_only = seen.state.comparison == Comparison::photograph || shows_depth;
  const DrawnViews* const photograph =
      photograph_only ? drawer.photographed(content, part, positions, shows_depth) : nullptr;
  return (photograph != nullptr ? *photograph : drawer.painted(content, seen.state, part, positions)).pictures;
}

/// Options of pack, each as "crop=4:3".
cli::PrintArguments print_arguments(std::span<const std::string> framing) {
  cli::PrintArguments arguments;
  std::vector<cli::NamedWords> options;
  for (const std::string& option : framing) {
    const std::size_t equals = option.find('=');
    if (equals == std::string::npos)
      throw Error(ErrorKind::wrong_usage,
                  fmt::format("'{}' is no option, expected crop=, border=, caption= or floating-window=", option));
    std::string name = option.substr(0, equals);
    std::ranges::replace(name, '-', '_');
    options.emplace_back(std::move(name), std::vector{option.substr(equals + 1)});
  }
  cli::set_rows(cli::print_rows(arguments, {}, {}, {}), options);
  return arguments;
}

PictureNotes notes_of(const Item& files) {
  if (files.empty() || !(is_picture_name(files.front()) || is_stereo_file_name(files.front()))) return {};
  return read_photograph_notes(files.front(), false);
}

}  // namespace

std::span<const SaveFormat> save_formats() {
  static const std::vector<SaveFormat> formats{{"picture", "Picture of the window", ".png"},
                                               {"mpo", "MPO, both views in one file", ".mpo"},
                                               {"jps", "JPS, both views for stereo programs", ".jps"},
                                               {"left-right", "Side by side", ".png"},
                                               {"left-right-half", "Side by side, half width, for televisions", ".png"},
                                               {"right-left", "Side by side, for cross-eyed viewing", ".png"},
                                               {"top-bottom", "One above the other", ".png"},
                                               {"red-cyan", "Red-cyan anaglyph", ".png"},
                                               {"green-magenta", "Green-magenta anaglyph", ".png"},
                                               {"even-odd-rows", "Rows of an interlaced screen", ".png"},
                                               {"quilt", "Quilt of the display", ".png"},
                                               {"lenticular", "Picture under the display's lenses", ".png"},
                                               {"wiggle", "Animation of the views", ".gif"},
                                               {"exr", "OpenEXR with a view for each eye", ".exr"},
                                               {"card", "Stereo card (PDF)", ".pdf"},
                                               {"views", "A picture for each eye, in a folder", ""}};
  return formats;
}

std::string proposed_name_as(const Session& session, std::string_view format) {
  const auto found = std::ranges::find(save_formats(), format, &SaveFormat::name);
  const std::string ending(found == save_formats().end() ? ".png" : found->ending);
  const Item* const item = open_item(session);
  const std::string stem = item == nullptr ? "picture" : item->front().stem().string();
  const DisplayPreset& display = find_display(session.state.display);
  std::string name = stem + "_" + std::string(format) + ending;
  if (format == "picture") name = fmt::format("{}_{}{}", stem, session.state.mode, ending);
  if (ending != ".png" && !ending.empty()) name = stem + ending;
  if (format == "quilt" && display.quilt_columns > 0)
    name = quilt_name(stem, {display.quilt_columns, display.quilt_rows}, display.aspect);
  const bool is_open =
      item != nullptr && std::ranges::any_of(*item, [&](const fs::path& file) { return file.filename() == name; });
  return is_open ? stem + "_new" + ending : name;
}

std::vector<Image<Rgb8>> views_to_save(const SeenToSave& seen, int count, bool of_display) {
  ViewDrawer drawer;
  const Adjustment& adjustment = seen.state.adjustment;
  if (of_display) return drawer.display_views(drawer.placed(seen.content, seen.state), seen.state);
  if (has_one_view(seen.content)) throw Error(ErrorKind::wrong_usage, "there is one view only, expected two");
  std::vector<Image<Rgb8>> views = drawn_views(drawer, seen, count);
  if (seen.state.swap) std::ranges::reverse(views);
  const float step_px =
      adjustment.zero_parallax_px * adjustment.separation / static_cast<float>(std::max(count - 1, 1));
  return step_px == 0 ? views : shifted_views(std::move(views), seen.state.swap ? -step_px : step_px);
}

std::string save_as(const SeenToSave& given, const std::string& format, const fs::path& path,
                    std::span<const std::string> framing) {
  SeenToSave seen = given;
  const cli::PackingArguments arguments = packing_arguments(format, seen.state);
  const cli::Packing packing = cli::find_packing(arguments, path.string());
  cli::check_ending(packing, path.string());
  const cli::ViewsOutput output{path.string(), seen.files, arguments.format, notes_of(seen.files)};
  cli::check_views_output(output);
  const bool of_display = is_of_display(packing.format->name);
  if (of_display) seen.state.mode = packing.format->name;
  const int wanted = packing.format->name == "wiggle" ? wiggle_views : 2;
  const cli::PrintArguments print = print_arguments(framing);
  PrintFrame frame = cli::print_frame_from(print, output.notes, seen.files.empty() ? fs::path() : seen.files.front());
  std::string caption;
  if (cli::sets_caption(packing)) caption.swap(frame.caption);
  std::ostringstream told;
  const cli::Session session{.output = told, .errors = told, .quiet = true};
  const std::vector<Image<Rgb8>> views =
      cli::put_in_frame(views_to_save(seen, wanted, of_display), print, frame, 0, session);
  return cli::write_packed({packing, arguments, views, caption, {}, output, session});
}

}  // namespace wheatstone::viewer
