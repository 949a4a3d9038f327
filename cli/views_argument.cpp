#include "views_argument.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <utility>

#include "depth_argument.h"
#include "device_option.h"
#include "display_argument.h"
#include "stereo_arguments.h"
#include "wheatstone/app/display_views.h"
#include "wheatstone/depth/rig.h"
#include "wheatstone/display/quilt.h"
#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/multiview/render_slices.h"
#include "wheatstone/multiview/slice_file.h"
#include "wheatstone/painting/two_eyes.h"
#include "wheatstone/photograph/find_photographs.h"
#include "wheatstone/photograph/read_views.h"
#include "wheatstone/pictures/multiview_exr.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/stereo/stereo_layout.h"
#include "wheatstone/video/film_files.h"
#include "write_views_output.h"

namespace wheatstone::cli {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> pictures_in(const std::string& folder) {
  std::vector<std::string> files;
  for (const fs::path& file : pictures_in_folder(folder)) files.push_back(file.string());
  if (files.size() < 2)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: has {} pictures, expected two views or more", folder, files.size()));
  return files;
}

ReadViews read_pictures(const std::vector<std::string>& files, bool keep_profile, const Progress& progress) {
  ReadViews read;
  read.how = "a file each";
  std::vector<PictureInProfile> pictures;
  for (const std::string& file : files) {
    report(progress, "reading", static_cast<double>(pictures.size()) / static_cast<double>(files.size()));
    pictures.push_back(read_in_profile(file));
    const Image<Rgb8>& first = pictures.front().picture;
    const Image<Rgb8>& last = pictures.back().picture;
    if (!same_size(first, last))
      throw Error(ErrorKind::bad_input, fmt::format("{}: is {}x{} pixels, expected {}x{} as {}", file, last.width(),
                                                    last.height(), first.width(), first.height(), files.front()));
  }
  read.colour_profile = bring_to_one_profile(pictures, keep_profile);
  for (PictureInProfile& picture : pictures) read.views.push_back(std::move(picture.picture));
  return read;
}

/// The same; two that differ by a few rows are framed to their common part, as photographs are.
ReadViews read_files(const std::vector<std::string>& files, bool keep_profile, const Session& session) {
  if (files.size() != 2) return read_pictures(files, keep_profile, session.progress);
  report(session.progress, "reading", 0);
  NamedPair read = read_named_pair({.left = files[0], .right = files[1], .keep_profile = keep_profile});
  tell_of_layout(read, session);
  ReadViews views{{}, "a file each", std::move(read.colour_profile)};
  views.views.push_back(std::move(read.pictures.left));
  views.views.push_back(std::move(read.pictures.right));
  return views;
}

int count_of(const ViewsArguments& arguments, int wanted) {
  if (arguments.views > 0) return arguments.views;
  return wanted > 0 ? wanted : 2;
}

bool are_of_the_eyes(const ViewsArguments& arguments, int count) { return count == 2 && arguments.span == 1; }

ReadViews render_stack(const std::string& file, int count, float span, const Progress& progress) {
  const SliceStack stack = read_slices(file);
  const Rig rig = evenly_spaced(stack.width, stack.height, count, span);
  return {render_slices(stack, rig, SliceFilter::centroid, progress), "made from slices"};
}

/// As the option or else the file's name says it; nothing where the file is no quilt.
std::optional<QuiltLayout> quilt_layout_of(const ViewsArguments& arguments, const std::string& file) {
  if (arguments.quilt) return arguments.quilt;
  const std::optional<NamedQuilt> named = quilt_of_name(fs::path(file).filename().string());
  if (!named || !arguments.layout.empty()) return {};
  return named->layout;
}

/// The views that a picture holds.
ReadViews read_views_in_picture(const ViewsArguments& arguments, const std::string& file, const Progress& progress) {
  report(progress, "reading", 0);
  ReadViewsOptions options = arguments.layout.empty() ? ReadViewsOptions() : options_for_layout(arguments.layout);
  options.keep_profile = arguments.keep_profile;
  std::optional<ViewsFile> found = find_views(file, options);
  if (!found)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: holds one view; give all views, or --layout for several views in one picture", file));
  std::string how = describe_views(*found);
  if (!found->note.empty()) how += "; " + found->note;
  return {std::move(found->views), std::move(how), std::move(found->colour_profile)};
}

enum class ViewsKind { files, folder, photographs, film, quilt, painting, slices, multiview_exr, picture };

ViewsKind kind_of(const ViewsArguments& arguments) {
  if (arguments.files.size() != 1) return ViewsKind::files;
  const std::string& file = arguments.files.front();
  if (fs::is_directory(file))
    return !(arguments.into_one_file && arguments.into_one_file()) && holds_photographs(file) ? ViewsKind::photographs
                                                                                              : ViewsKind::folder;
  if (is_film(file)) return ViewsKind::film;
  if (quilt_layout_of(arguments, file)) return ViewsKind::quilt;
  if (file.ends_with(".wst")) return ViewsKind::painting;
  if (!file.ends_with(".exr")) return ViewsKind::picture;
  return is_multiview_exr(file) ? ViewsKind::multiview_exr : ViewsKind::slices;
}

std::string_view views_situation(ViewsKind kind) {
  constexpr std::array<std::string_view, 9> words{
      "on several files",     "on a folder of views", "on a folder of photographs", "on a film",  "on a quilt",
      "on a painting (.wst)", "on slices (.exr)",     "on a multi-view OpenEXR",    "on pictures"};
  return words[static_cast<std::size_t>(kind)];
}

Reason only(const ViewsArguments& arguments, std::vector<ViewsKind> kinds, const char* where) {
  return only_on<ViewsKind>([&arguments] { return kind_of(arguments); }, std::move(kinds), views_situation, where);
}

}  // namespace

Painting read_painting_for_views(const std::string& file) {
  Painting painting = read_painting(file);
  if (painting.surfaces.seen.empty())
    throw Error(
        ErrorKind::bad_input,
        fmt::format("{}: has no surfaces, so it cannot show more than two views (it is of version 1 or 2, or each eye "
                    "was painted alone); paint its photographs again",
                    file));
  return painting;
}

Painting read_painting_argument(const ViewsArguments& arguments, int wanted) {
  const std::string& file = arguments.files.front();
  return are_of_the_eyes(arguments, count_of(arguments, wanted)) ? read_painting(file) : read_painting_for_views(file);
}

ReadViews draw_painting_argument(const Painting& painting, const ViewsArguments& arguments, int wanted,
                                 const Progress& progress) {
  const int count = count_of(arguments, wanted);
  ReadViews read;
  read.how = "drawn from a painting";
  read.count = count;
  read.size = {width_of(painting), height_of(painting)};
  Presented shown;
  if (are_of_the_eyes(arguments, count)) {
    Presentation presentation = for_two_eyes();
    presentation.composition = arguments.composition;
    presentation.device = arguments.device;
    shown = present(painting, presentation);
  } else {
    const DisplayViewsOptions options{.views = count,
                                      .width = width_of(painting),
                                      .height = height_of(painting),
                                      .span = arguments.span,
                                      .device = arguments.device};
    shown = draw_display_views(painting, options, progress, arguments.composition).shown;
  }
  read.views = std::move(shown.views);
  read.composed = std::move(shown.composed);
  return read;
}

bool is_photograph(const ViewsArguments& arguments) {
  const ViewsKind kind = kind_of(arguments);
  return kind == ViewsKind::picture || kind == ViewsKind::photographs ||
         (kind == ViewsKind::files && arguments.files.size() == 2);
}

bool is_photograph_folder(const ViewsArguments& arguments) { return kind_of(arguments) == ViewsKind::photographs; }

Rows views_rows(ViewsArguments& a, const std::function<bool()>& makes_views) {
  const Reason count = [&a, none = only(a, {ViewsKind::film, ViewsKind::painting, ViewsKind::slices},
                                        "it works on a photograph, a painting (.wst) or slices (.exr)")] {
    return is_photograph(a) ? "" : none();
  };
  const Reason made = [makes_views, none = only(a, {ViewsKind::film, ViewsKind::painting, ViewsKind::slices},
                                                "it works where views are made")] {
    return makes_views() ? "" : none();
  };
  return {row("VIEWS", required(texts(a.files)),
              "Pictures from left to right; a folder of them, or of photographs; or one file: MPO, JPS, both views in "
              "one picture, "
              "multi-view OpenEXR, painting (.wst), slices (.exr), film; or a film for each eye"),
          row("--layout", text(a.layout),
              fmt::format("Layout of one picture that holds both views: {}{}; detected by default",
                          fmt::join(photograph_layout_names(), ", "), depth_layout_words),
              {only(a, {ViewsKind::film, ViewsKind::picture, ViewsKind::photographs},
                    "it works on one picture that holds both views")}),
          row("--from-quilt", quilt_layout(a.quilt),
              "Read the picture as a quilt of COLUMNSxROWS views; by default where its name says so, as in "
              "gas_qs8x6a0.75.png",
              {only(a, {ViewsKind::film, ViewsKind::quilt}, "it works on one picture")}),
          row("--swap", flag(a.swap), "Reverse the order of the views: they are stored from right to left"),
          row("--views", without_default(number(a.views, view_count_range)),
              "Number of views to make from a photograph, a painting or slices", {count}),
          row("--span", number(a.span, view_span_range),
              "Distance from the first view to the last, in eye separations, of views that are made; by default, a "
              "photograph's is chosen from its depth",
              {made})};
}

Reason unless_painting(const ViewsArguments& arguments) {
  return only(arguments, {ViewsKind::film, ViewsKind::painting}, "it works on a painting (.wst)");
}

Row views_device_row(ViewsArguments& a) {
  return device_row(a.device, "Device that draws the views of a painting", {unless_painting(a)});
}

std::vector<fs::path> files_read(const ViewsArguments& arguments) {
  if (arguments.files.size() == 1 && is_folder(arguments.files.front()))
    return pictures_in_folder(arguments.files.front());
  return {arguments.files.begin(), arguments.files.end()};
}

ReadViews read_views_argument(const ViewsArguments& arguments, int wanted, const Session& session) {
  const std::string& file = arguments.files.front();
  const Progress& progress = session.progress;
  const auto read = [&]() -> ReadViews {
    switch (kind_of(arguments)) {
      case ViewsKind::files:
        return read_files(arguments.files, arguments.keep_profile, session);
      case ViewsKind::folder:
      case ViewsKind::photographs:
        return read_pictures(pictures_in(file), arguments.keep_profile, progress);
      case ViewsKind::film:
        throw Error(
            ErrorKind::bad_input,
            fmt::format(
                "{}: is a film, expected pictures; of a film a single frame can be packed, saved as a picture{}", file,
                quilt_of_name(fs::path(file).filename().string()) ? " with such a name" : ""));
      case ViewsKind::quilt:
        return {views_of_quilt(read_image(file), *quilt_layout_of(arguments, file)), "taken from a quilt"};
      case ViewsKind::painting:
        return draw_painting_argument(sliced(read_painting_argument(arguments, wanted), arguments.slicing), arguments,
                                      wanted, progress);
      case ViewsKind::slices:
        return render_stack(file, count_of(arguments, wanted), arguments.span, progress);
      case ViewsKind::multiview_exr:
        return {read_multiview_exr(file), "a multi-view OpenEXR"};
      case ViewsKind::picture:
        break;
    }
    return read_views_in_picture(arguments, file, progress);
  };
  ReadViews views = read();
  if (arguments.swap) std::ranges::reverse(views.views);
  return views;
}

}  // namespace wheatstone::cli
