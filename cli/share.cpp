#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "commands.h"
#include "depth_argument.h"
#include "display_argument.h"
#include "model_argument.h"
#include "photograph_run.h"
#include "slicing_options.h"
#include "stereo_arguments.h"
#include "views_argument.h"
#include "wheatstone/app/paint_photograph.h"
#include "wheatstone/display/quilt.h"
#include "wheatstone/error.h"
#include "wheatstone/files/output_paths.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/models/read_model.h"
#include "wheatstone/multiview/slice_file.h"
#include "wheatstone/photograph/carried_depth.h"
#include "wheatstone/photograph/photograph_notes.h"
#include "wheatstone/pictures/multiview_exr.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/share/gallery_page.h"
#include "wheatstone/share/page.h"
#include "wheatstone/share/share_pictures.h"
#include "wheatstone/stereo/geometry_from_disparity.h"
#include "wheatstone/stereo/picture_sizes.h"
#include "wheatstone/stereo/stereo_layout.h"
#include "wheatstone/video/film_files.h"

namespace wheatstone::cli {
namespace {

namespace fs = std::filesystem;

struct ShareArguments {
  Given given;
  FolderArguments walk;  ///< of a folder of photographs
  ViewsArguments views;  ///< the files, as all kinds have them
  DepthArguments depth;
  ModelArguments model;
  Slicing slicing;  ///< of a painting
  std::string disparity;
  std::string output = "page.html";
  PageWords words;
  std::string element;    ///< file for the element's code; empty: it is not wanted
  std::string max_size;   ///< of the page; empty: what is usual for its kind
  std::string subtitles;  ///< of a film, in a WebVTT file; empty: none
  std::string thumbnail;  ///< small picture beside the page, for a gallery; empty: none
};

std::vector<fs::path> files_that_are_read(const ShareArguments& arguments) {
  std::vector<fs::path> files = files_read(arguments.views);
  for (const std::string& file :
       {arguments.depth.file, arguments.depth.model, arguments.disparity, arguments.subtitles})
    files.emplace_back(file);
  files.push_back(arguments.model.seen.model.choice.texture);
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
  return views.files.size() > 2 || fs::is_directory(first) || views.quilt || first.ends_with(".exr") ||
         quilt_of_name(fs::path(first).filename().string()).has_value();
}

SharedPicture share_picture_with_depth(const ShareArguments& arguments, const Session& session) {
  StereoArguments files{.left = arguments.views.files.front(), .layout = arguments.views.layout};
  DepthArguments depth = arguments.depth;
  depth.carried = !has_depth(depth);
  const SinglePicture single = read_single_picture(files, depth, session);
  return share_photograph(single.pair.pictures, single.pair.geometry, arguments.words.title);
}

SharedPicture share_model(const ShareArguments& arguments, const Session& session) {
  ModelPictures made = render_model_argument(arguments.views.files.front(), arguments.model, shared_views, session);
  const StereoGeometry geometry = geometry_from_both(std::move(made.left_disparity), std::move(made.right_disparity));
  return share_photograph(made.pictures, geometry, arguments.words.title, made.known);
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

enum class SharedKind {
  photographs,
  painting,
  film,
  quilt_film,
  slices,
  model,
  views,
  picture_with_depth,
  stereo_photograph
};

SharedKind shared_kind_of(const ShareArguments& arguments) {
  const ViewsArguments& views = arguments.views;
  const std::string& first = views.files.front();
  const bool is_one = views.files.size() == 1;
  if (is_one && is_photograph_folder(views)) return SharedKind::photographs;
  if (is_one && first.ends_with(".wst")) return SharedKind::painting;
  if (is_one && is_film(first))
    return views.quilt || quilt_of_name(fs::path(first).filename().string()) ? SharedKind::quilt_film
                                                                             : SharedKind::film;
  if (is_one && first.ends_with(".exr") && !is_multiview_exr(first)) return SharedKind::slices;
  if (is_one && is_model(first)) return SharedKind::model;
  if (are_ready_views(views)) return SharedKind::views;
  const bool has_own = is_one && (has_depth(arguments.depth) || views.layout == depth_layout || carries_depth(first));
  return has_own ? SharedKind::picture_with_depth : SharedKind::stereo_photograph;
}

std::string_view shared_situation(SharedKind kind) {
  constexpr std::array<std::string_view, 9> words{"on a folder of photographs",
                                                  "on a painting (.wst)",
                                                  "on a film",
                                                  "on a film of quilts",
                                                  "on slices",
                                                  "on a model of triangles",
                                                  "on views",
                                                  "on one picture with its depth",
                                                  "on a stereo photograph"};
  return words[static_cast<std::size_t>(kind)];
}

SharedPicture share_film_file(const ShareArguments& arguments) {
  const ViewsArguments& views = arguments.views;
  const fs::path film = views.files.front();
  ShareFilmOptions options{.title = arguments.words.title, .page = arguments.output};
  options.quilt = views.quilt;
  if (const auto named = quilt_of_name(film.filename().string()); named && !views.quilt) options.quilt = named->layout;
  if (!views.layout.empty()) {
    options.layout = find_stereo_layout(views.layout);
    if (!options.layout)
      throw Error(ErrorKind::wrong_usage, fmt::format("--layout: there is no layout '{}', expected one of {}",
                                                      views.layout, stereo_layout_names()));
  }
  if (const auto most = most_bytes(arguments)) options.most_bytes = *most;
  options.subtitles = arguments.subtitles;
  return share_film(film, options);
}

SharedPicture share_slice_file(const ShareArguments& arguments) {
  ShareSlicesOptions options{.title = arguments.words.title};
  if (const auto most = most_bytes(arguments)) options.most_bytes = *most;
  return share_slices(read_slices(arguments.views.files.front()), options);
}

SharedPicture share(const ShareArguments& arguments, const Session& session) {
  const std::string& title = arguments.words.title;
  switch (shared_kind_of(arguments)) {
    case SharedKind::painting:
      return share_painting(sliced(read_painting(arguments.views.files.front()), arguments.slicing),
                            {.title = title, .most_bytes = most_bytes(arguments)});
    case SharedKind::film:
    case SharedKind::quilt_film:
      return share_film_file(arguments);
    case SharedKind::slices:
      return share_slice_file(arguments);
    case SharedKind::model:
      return share_model(arguments, session);
    case SharedKind::views:
      return share_views(read_views_argument(arguments.views, 0, session).views, title);
    case SharedKind::picture_with_depth:
      return share_picture_with_depth(arguments, session);
    case SharedKind::photographs:  // a page each
    case SharedKind::stereo_photograph:
      break;
  }
  return share_stereo_photograph(arguments, session);
}

/// The picture that stands for a page, small.
void write_thumbnail(const std::string& file, const SharedPicture& picture) {
  constexpr int longest_px = 480, quality = 85;
  const Image<Rgb8> still = decode_jpeg(picture.still_jpeg, file);
  write_whole_file(file,
                   encode_jpeg(reduced(still, reduced_size({still.width(), still.height()}, longest_px)), quality));
}

Report share_one(const ShareArguments& given, const Session& session) {
  ShareArguments arguments = given;
  most_bytes(arguments);  // refused before anything is read
  const std::vector<fs::path> inputs = files_that_are_read(arguments);
  for (const std::string& output : {arguments.output, arguments.element}) check_not_an_input(output, inputs);
  check_distinct_outputs(
      std::array<NamedOutput, 2>{{{"--output", arguments.output}, {"--element", arguments.element}}});
  if (arguments.words.title.empty()) arguments.words.title = fs::path(arguments.views.files.front()).stem().string();
  report(session.progress, "reading", 0);
  const SharedPicture picture = share(arguments, session);
  refuse_too_large(arguments, picture);
  const std::string page = html_page(picture, arguments.words);
  if (!arguments.thumbnail.empty()) write_thumbnail(arguments.thumbnail, picture);
  write_whole_file(arguments.output, page);
  if (!arguments.element.empty()) write_whole_file(arguments.element, page_element_code());
  Report report{
      {{"output", arguments.output},
       {"bytes", page.size(),
        fmt::format("written to {} ({:.0f} kB)", arguments.output, static_cast<double>(page.size()) / 1000)}}};
  if (!picture.note.empty())
    report.facts.insert(report.facts.begin(), Fact{"note", picture.note, fmt::format("note: {}", picture.note)});
  return report;
}

std::string thumbnail_of(const PhotographJob& job) { return fs::path(job.output).replace_extension(".jpg").string(); }

/// A page of each photograph in a folder, and a gallery that leads to them.
Report share_folder(const ShareArguments& arguments, const Session& session) {
  const std::string& folder = arguments.views.files.front();
  const std::string place = arguments.given("--output") ? arguments.output : "gallery";
  const StereoArguments photographs{
      .left = {}, .right = {}, .layout = arguments.views.layout, .swap = arguments.views.swap};
  const PhotographWork work{
      .input = folder,
      .output = place,
      .folder = arguments.walk,
      .done = "shared",
      .work = [&](const PhotographJob& job, const Session& of_one) -> PhotographResult {
        ShareArguments one = arguments;
        read_photograph_of(job, one.views, one.depth);
        one.output = job.output;
        one.thumbnail = thumbnail_of(job);
        one.words = {.title = read_photograph_notes(job.left).title, .description = {}, .caption = {}};
        if (one.words.title.empty()) one.words.title = fs::path(job.output).stem().string();
        return {share_one(one, of_one), job.output};
      },
      .is_done = [](const PhotographJob& job) { return fs::exists(job.output) && fs::exists(thumbnail_of(job)); },
      .shown = [](const PhotographJob& job) -> std::optional<fs::path> {
        const std::string file = thumbnail_of(job);
        return fs::exists(file) ? std::optional<fs::path>(file) : std::nullopt;
      }};
  const FolderOutput output{.folder = place, .ending = ".html", .placeholders = {}};
  PhotographList list = photographs_in_folder(folder, photographs, arguments.walk, output, session);
  const std::string gallery = (fs::path(place) / "index.html").string();
  for (PhotographJob& job : list.jobs)
    if (job.output == gallery) job.output = (fs::path(place) / "index-photograph.html").string();
  Report report = work_on_all(work, list, session);
  const std::vector<GalleryEntry> entries = gallery_entries(place);
  if (arguments.walk.dry_run || entries.empty()) return report;
  PageWords words = arguments.words;
  if (words.title.empty()) words.title = fs::canonical(folder).filename().string();
  write_whole_file(gallery, gallery_page(entries, words));
  report.facts.push_back({"gallery", gallery, fmt::format("gallery: {}", gallery)});
  return report;
}

Report run_share(const ShareArguments& arguments, const Session& session) {
  if (shared_kind_of(arguments) == SharedKind::photographs) return share_folder(arguments, session);
  return share_one(arguments, session);
}

Rows share_rows(ShareArguments& a) {
  const auto only = [&a](std::vector<SharedKind> kinds) {
    return only_on<SharedKind>([&a] { return shared_kind_of(a); }, std::move(kinds), shared_situation,
                               "it is for other pictures");
  };
  const Rows page{
      row("FILE", required(texts(a.views.files)),
          "Painting (.wst); LEFT and RIGHT photograph, or one file that holds both; one picture with its depth; views "
          "from left to right, a folder of them or a quilt; slices (.exr); film of both eyes or of quilts; model of "
          "triangles (glTF, OBJ, PLY, STL); a folder of photographs"),
      row("-o,--output", output_name(a.output),
          "Page: one HTML file, which needs nothing else; of a folder, the folder of the pages, 'gallery' by default"),
      row("--title", text(a.words.title), "Title of the page; the name of the file by default"),
      row("--caption", text(a.words.caption), "Text below the picture"),
      row("--description", text(a.words.description),
          "What the picture shows, for readers who cannot see it; the title by default"),
      row("--element", text(a.element),
          "Also write the code of the element <wheatstone-picture>, with which other pages embed this one, to this .js "
          "file"),
      row("--disparity", text(a.disparity),
          "Disparity of the left photograph, which replaces matching, as of 'wheatstone paint'",
          {only({SharedKind::stereo_photograph})}),
      row("--layout", text(a.views.layout),
          "Layout of one file that holds both views, as of 'wheatstone paint'; rgbd for a picture with its depth "
          "beside it",
          {only({SharedKind::film, SharedKind::photographs, SharedKind::picture_with_depth,
                 SharedKind::stereo_photograph})}),
      row("--swap", flag(a.views.swap), "Swap the two views, or reverse the order of all",
          {only({SharedKind::views, SharedKind::photographs, SharedKind::stereo_photograph})}),
      row("--from-quilt", quilt_layout(a.views.quilt), "Read the picture as a quilt of COLUMNSxROWS views",
          {only({SharedKind::quilt_film, SharedKind::views})}),
      row("--max-size", of_type("SIZE", text(a.max_size)),
          "Most bytes of the page, as 8MB: of a painting and of slices, numbers are rounded more and pictures made "
          "smaller; a film that is larger stays beside the page",
          {only({SharedKind::painting, SharedKind::film, SharedKind::quilt_film, SharedKind::slices})}),
      row("--subtitles", text(a.subtitles), "Subtitles of a film: a WebVTT file (.vtt)",
          {only({SharedKind::film, SharedKind::quilt_film})})};
  const Reason no_depth = when([&a] { return shared_kind_of(a) != SharedKind::picture_with_depth; }, "without --depth");
  const auto on_folder = [&a] { return shared_kind_of(a) == SharedKind::photographs; };
  Rows walk = folder_rows(a.walk, on_folder, "shared");
  walk.push_back(contact_sheet_row(a.walk, on_folder));
  return join({page, slicing_rows(a.slicing, {only({SharedKind::painting})}), walk,
               under({}, depth_rows(a.depth, no_depth), {only({SharedKind::picture_with_depth})}),
               under("Models", model_rows(a.model), {only({SharedKind::model})})});
}

}  // namespace

Command share_command() {
  return make_command("share", "Write a page that shows a picture with its depth in any browser", share_rows, run_share,
                      R"(Examples:
  wheatstone share painting.wst -o page.html
  wheatstone share painting.wst -o page.html --title Fruit --element wheatstone-picture.js
  wheatstone share painted.mp4 -o page.html
  wheatstone share slices.exr -o page.html --max-size 4MB
  wheatstone share left.png right.png -o page.html
  wheatstone share model.glb --azimuth 60 -o page.html
  wheatstone share photo.jpg --depth depth.png -o page.html
  wheatstone share photographs -o gallery)");
}

}  // namespace wheatstone::cli
