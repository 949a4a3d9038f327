#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "command.h"
#include "depth_argument.h"
#include "disparity_argument.h"
#include "film_argument.h"
#include "number_arguments.h"
#include "option_use.h"
#include "output_option.h"
#include "print_facts.h"
#include "stereo_arguments.h"
#include "views_argument.h"
#include "wheatstone/app/paint_photograph.h"
#include "wheatstone/display/multiview_exr.h"
#include "wheatstone/display/quilt.h"
#include "wheatstone/error.h"
#include "wheatstone/files/input_guard.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/multiview/slice_file.h"
#include "wheatstone/photograph/carried_depth.h"
#include "wheatstone/share/page.h"
#include "wheatstone/share/share_film.h"
#include "wheatstone/share/share_painting.h"
#include "wheatstone/share/share_photograph.h"
#include "wheatstone/share/share_slices.h"
#include "wheatstone/share/share_views.h"
#include "wheatstone/video/film_files.h"

namespace wheatstone::cli {
namespace {

namespace fs = std::filesystem;

struct ShareArguments {
  ViewsArguments views;  ///< the files, as all kinds have them
  DepthArguments depth;
  std::string disparity;
  std::string output = "page.html";
  PageWords words;
  std::string element;    ///< file for the element's code; empty: it is not wanted
  std::string max_size;   ///< of the page; empty: what is usual for its kind
  std::string subtitles;  ///< of a film, in a WebVTT file; empty: none
};

std::vector<fs::path> files_that_are_read(const ShareArguments& arguments) {
  std::vector<fs::path> files = files_read(arguments.views);
  for (const std::string& file :
       {arguments.depth.file, arguments.depth.model, arguments.disparity, arguments.subtitles})
    files.emplace_back(file);
  return files;
}

/// Most bytes of the page but for its words, as `page_bytes` counts them.
std::optional<std::size_t> most_bytes(const ShareArguments& arguments) {
  if (arguments.max_size.empty()) return std::nullopt;
  const std::size_t of_words = html_page({}, arguments.words).size() - html_page({}, {}).size();
  const std::size_t most = parse_bytes("--max-size", arguments.max_size);
  return most - std::min(most, of_words);
}

/// Numbers are rounded and pictures made smaller to a certain degree only.
void refuse_too_large(const ShareArguments& arguments, const SharedPicture& picture) {
  const std::optional<std::size_t> most = most_bytes(arguments);
  if (!most || picture.has_file_beside || page_bytes(picture) <= *most) return;
  throw Error(ErrorKind::wrong_usage,
              fmt::format("--max-size: is '{}', but the smallest page of {} has {:.0f} kB", arguments.max_size,
                          arguments.views.files.front(), std::ceil(static_cast<double>(page_bytes(picture)) / 1000)));
}

/// Whether the files are views that are shown as they are, and no photograph of two that is looked into.
bool are_ready_views(const ViewsArguments& views) {
  const std::string& first = views.files.front();
  return views.files.size() > 2 || fs::is_directory(first) || !views.quilt.empty() || first.ends_with(".exr") ||
         quilt_of_name(fs::path(first).filename().string()).has_value();
}

SharedPicture share_ready_views(const ViewsArguments& views, const std::string& title, const CLI::App& command,
                                const Session& session) {
  return share_views(read_views_argument(views, 0, command, session).views, title);
}

SharedPicture share_picture_with_depth(const ShareArguments& arguments, const Session& session) {
  StereoArguments files{.left = arguments.views.files.front(), .layout = arguments.views.layout};
  DepthArguments depth = arguments.depth;
  depth.carried = !has_depth(depth);
  const SinglePicture single = read_single_picture(files, depth, session);
  return share_photograph(single.pair.pictures, single.pair.geometry, arguments.words.title);
}

SharedPicture share_stereo_photograph(const ShareArguments& arguments, const Session& session) {
  const std::vector<std::string>& files = arguments.views.files;
  const ReadPhotograph read = read_photographs({.left = files.front(),
                                                .right = files.size() > 1 ? files[1] : "",
                                                .layout = arguments.views.layout,
                                                .swap = arguments.views.swap},
                                               !arguments.disparity.empty(), session);
  PaintPhotographOptions options;
  if (!arguments.disparity.empty()) options.left_disparity = read_disparity_argument(arguments.disparity);
  const FoundGeometry found = find_geometry(read.pair.pictures, options, session.progress);
  if (found.confidence) tell_of_match(read, *found.confidence, session);
  return share_photograph(read.pair.pictures, found.geometry, arguments.words.title);
}

/// Refuses options that have no effect on what is shared.
void refuse_others(const CLI::App& command, std::vector<std::string> kept, std::string_view situation) {
  kept.insert(kept.end(), {"--output", "--title", "--caption", "--description", "--element"});
  refuse_all_but(command, kept, situation, "it is for other pictures");
}

SharedPicture share_film_file(const ShareArguments& arguments, const CLI::App& command) {
  const ViewsArguments& views = arguments.views;
  const fs::path film = views.files.front();
  ShareFilmOptions options{.title = arguments.words.title, .page = arguments.output};
  if (const auto named = quilt_of_name(film.filename().string())) options.quilt = named->layout;
  if (!views.quilt.empty()) {
    const Size size = parse_size("--from-quilt", views.quilt, {1, 1000}, "COLUMNSxROWS");
    options.quilt = QuiltLayout{size.width, size.height};
  }
  refuse_others(command, {options.quilt ? "--from-quilt" : "--layout", "--max-size", "--subtitles"}, "on a film");
  options.layout = film_layout_option("--layout", views.layout);
  if (const auto most = most_bytes(arguments)) options.most_bytes = *most;
  options.subtitles = arguments.subtitles;
  return share_film(film, options);
}

SharedPicture share_slice_file(const ShareArguments& arguments, const CLI::App& command) {
  refuse_others(command, {"--max-size"}, "on slices");
  ShareSlicesOptions options{.title = arguments.words.title};
  if (const auto most = most_bytes(arguments)) options.most_bytes = *most;
  return share_slices(read_slices(arguments.views.files.front()), options);
}

SharedPicture share(const ShareArguments& arguments, const CLI::App& command, const Session& session) {
  const ViewsArguments& views = arguments.views;
  const std::string& first = views.files.front();
  const bool is_one = views.files.size() == 1;
  if (is_one && first.ends_with(".wst")) {
    refuse_others(command, {"--max-size"}, "on a painting (.wst)");
    return share_painting(read_painting(first), {.title = arguments.words.title, .most_bytes = most_bytes(arguments)});
  }
  if (is_one && is_film(first)) return share_film_file(arguments, command);
  if (is_one && first.ends_with(".exr") && !is_multiview_exr(first)) return share_slice_file(arguments, command);
  if (are_ready_views(views)) {
    refuse_others(command, {"--swap", "--from-quilt"}, "on views");
    return share_ready_views(views, arguments.words.title, command, session);
  }
  if (is_one && (has_depth(arguments.depth) || views.layout == depth_layout || carries_depth(first))) {
    refuse_others(command, {"--depth", "--depth-model", "--depth-is", "--strength", "--layout"},
                  "on one picture with its depth");
    return share_picture_with_depth(arguments, session);
  }
  refuse_others(command, {"--disparity", "--layout", "--swap"}, "on a stereo photograph");
  return share_stereo_photograph(arguments, session);
}

void run_share(ShareArguments arguments, const CLI::App& command, const Session& session) {
  most_bytes(arguments);  // refused before anything is read
  const std::vector<fs::path> inputs = files_that_are_read(arguments);
  for (const std::string& output : {arguments.output, arguments.element}) check_not_an_input(output, inputs);
  check_distinct_outputs(
      std::array<NamedOutput, 2>{{{"--output", arguments.output}, {"--element", arguments.element}}});
  if (arguments.words.title.empty()) arguments.words.title = fs::path(arguments.views.files.front()).stem().string();
  report(session.progress, "reading", 0);
  const SharedPicture picture = share(arguments, command, session);
  refuse_too_large(arguments, picture);
  const std::string page = html_page(picture, arguments.words);
  write_whole_file(arguments.output, page);
  if (!arguments.element.empty()) write_whole_file(arguments.element, page_element_code());
  if (session.json) {
    nlohmann::ordered_json facts{{"output", arguments.output}, {"bytes", page.size()}};
    if (!picture.note.empty()) facts["note"] = picture.note;
    print_facts(facts, session);
    return;
  }
  if (!picture.note.empty()) fmt::print(session.output, "note: {}\n", picture.note);
  fmt::print(session.output, "written to {} ({:.0f} kB)\n", arguments.output, static_cast<double>(page.size()) / 1000);
}

}  // namespace

void add_share_command(CLI::App& program, const Session& session) {
  auto arguments = std::make_shared<ShareArguments>();
  CLI::App* command =
      program.add_subcommand("share", "Write a page that shows a picture with its depth in any browser");
  command
      ->add_option(
          "FILE", arguments->views.files,
          "Painting (.wst); LEFT and RIGHT photograph, or one file that holds both; one picture with its "
          "depth; views from left to right, a folder of them or a quilt; slices (.exr); film of both eyes or of quilts")
      ->required();
  add_output_option(*command, arguments->output, "Page: one HTML file, which needs nothing else");
  command->add_option("--title", arguments->words.title, "Title of the page; the name of the file by default");
  command->add_option("--caption", arguments->words.caption, "Text below the picture");
  command->add_option("--description", arguments->words.description,
                      "What the picture shows, for readers who cannot see it; the title by default");
  command->add_option("--element", arguments->element,
                      "Also write the code of the element <wheatstone-picture>, with which other pages embed this one, "
                      "to this .js file");
  command->add_option("--disparity", arguments->disparity,
                      "Disparity of the left photograph, which replaces matching, as of 'wheatstone paint'");
  command->add_option("--layout", arguments->views.layout,
                      "Layout of one file that holds both views, as of 'wheatstone paint'");
  command->add_flag("--swap", arguments->views.swap, "Swap the two views, or reverse the order of all");
  command->add_option("--from-quilt", arguments->views.quilt, "Read the picture as a quilt of COLUMNSxROWS views");
  command
      ->add_option("--max-size", arguments->max_size,
                   "Most bytes of the page, as 8MB: of a painting and of slices, numbers are rounded more and pictures "
                   "made smaller; a film that is larger stays beside the page")
      ->type_name("SIZE");
  command->add_option("--subtitles", arguments->subtitles, "Subtitles of a film: a WebVTT file (.vtt)");
  add_depth_options(*command, arguments->depth);
  command->footer(
      "Examples:\n"
      "  wheatstone share painting.wst -o page.html\n"
      "  wheatstone share painting.wst -o page.html --title Fruit --element wheatstone-picture.js\n"
      "  wheatstone share painted.mp4 -o page.html\n"
      "  wheatstone share slices.exr -o page.html --max-size 4MB\n"
      "  wheatstone share left.png right.png -o page.html\n"
      "  wheatstone share photo.jpg --depth depth.png -o page.html");
  command->callback([arguments, command, &session] { run_share(*arguments, *command, session); });
}

}  // namespace wheatstone::cli
