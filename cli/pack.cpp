#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "commands.h"
#include "device_option.h"
#include "display_argument.h"
#include "made_views.h"
#include "pack_film.h"
#include "packing.h"
#include "photograph_run.h"
#include "print_options.h"
#include "slicing_options.h"
#include "stereo_arguments.h"
#include "views_argument.h"
#include "wheatstone/app/eyes_in_film.h"
#include "wheatstone/app/slice_film.h"
#include "wheatstone/app/slices_of_pictures.h"
#include "wheatstone/app/write_results.h"
#include "wheatstone/depth/display_presets.h"
#include "wheatstone/display/print_frame.h"
#include "wheatstone/error.h"
#include "wheatstone/files/output_paths.h"
#include "wheatstone/multiview/slice_file.h"
#include "wheatstone/photograph/find_layout.h"
#include "wheatstone/photograph/photograph_notes.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/stereo/picture_sizes.h"
#include "wheatstone/video/film_files.h"
#include "write_views_output.h"

namespace wheatstone::cli {
namespace {

namespace fs = std::filesystem;

struct PackArguments {
  Given given;
  FolderArguments walk;  ///< of a folder of photographs
  ViewsArguments input;
  DepthArguments depth;  ///< of one picture
  PackingArguments packing;
  PrintArguments print;
  SliceFilmArguments planes;  ///< of a painting
  std::string output;
  float shift_px = 0;
  int max_size = 0;  ///< longer side of what is matched; 0: as large as it is
  FilmWriterOptions film;
};

/// What to read, and how. A graphics processor that draws the views of a painting puts them into one picture, too,
/// where nothing is done to them before.
ViewsArguments input_of(const PackArguments& arguments, const Packing& packing, const Session& session) {
  ViewsArguments input = arguments.input;
  input.keep_profile = keeps_profile(packing, arguments.packing, arguments.output);
  settle_device(input.device, session);
  const int views = packing.format->views;
  const bool untouched = arguments.shift_px == 0 && !arguments.print.floating_window && !input.swap &&
                         !has_print_frame(arguments.print.frame) && arguments.print.caption.empty() &&
                         !arguments.given("--framing") && (views == 0 || input.views == 0 || input.views == views);
  if (input.device != Device::processor && packing.format->composition && untouched)
    input.composition = packing.format->composition(packing);
  return input;
}

/// What the first file says of its photograph; nothing of files that are no pictures.
PictureNotes notes_of(const PackArguments& arguments, const std::vector<fs::path>& files) {
  if (files.empty() || is_film(files.front())) return {};
  if (files.front().extension() == ".wst" || files.front().extension() == ".exr") return {};
  return read_photograph_notes(files.front(), arguments.print.keep_location);
}

/// Makes the views smaller where their longer side is above `longest_px`.
void reduce(std::vector<Image<Rgb8>>& views, int longest_px) {
  const PictureSize whole{views.front().width(), views.front().height()};
  const PictureSize size = reduced_size(whole, longest_px);
  if (size.width == whole.width && size.height == whole.height) return;
  for (Image<Rgb8>& view : views) view = reduced(view, size);
}

/// Brings views that were made elsewhere to the shape of those that the display takes.
void reframe(std::vector<Image<Rgb8>>& views, const PackArguments& arguments) {
  const DisplayPreset& display = find_display(arguments.packing.display);
  const int width = display.view_width_px, height = display.view_height_px;
  const double stretch = static_cast<double>(width) / height / display.aspect;
  for (Image<Rgb8>& view : views)
    view = framed_view(view, width, height,
                       shown_part(view.width(), view.height(), width, height, arguments.packing.framing, stretch));
}

PhotographResult pack_one(const PackArguments& arguments, const Session& session) {
  // What cannot be packed is said before anything is read.
  const Packing packing = find_packing(arguments.packing, arguments.output);
  check_ending(packing, arguments.output);
  ViewsOutput output{arguments.output, files_read(arguments.input), arguments.packing.format};
  output.inputs.emplace_back(arguments.packing.screen);
  output.inputs.emplace_back(arguments.depth.file);
  check_views_output(output);
  const std::string first = output.inputs.front().string();
  output.notes = notes_of(arguments, output.inputs);
  PrintFrame frame = print_frame_from(arguments.print, output.notes, first);
  std::string caption;
  if (sets_caption(packing)) caption.swap(frame.caption);
  const bool are_made = makes_views(arguments.input, packing, arguments.packing, arguments.depth);
  ReadViews read = are_made
                       ? make_views({arguments.input, arguments.packing, arguments.depth, arguments.given,
                                     arguments.shift_px, arguments.max_size},
                                    packing, session)
                       : read_views_argument(input_of(arguments, packing, session), views_wanted(packing), session);
  output.notes.colour_profile = std::move(read.colour_profile);
  if (arguments.max_size > 0 && !read.views.empty()) reduce(read.views, arguments.max_size);
  if (arguments.given("--framing") && !arguments.packing.display.empty() && !are_made) reframe(read.views, arguments);
  PackArguments rest = arguments;
  if (are_made && read.views.size() != 2) rest.shift_px = 0;  // it is done
  const std::vector<Image<Rgb8>> views = put_in_frame(std::move(read.views), rest.print, frame, rest.shift_px, session);
  report(session.progress, "packing", 0);
  const std::string written =
      write_packed({packing, arguments.packing, views, caption, read.composed, output, session});
  const std::size_t count = views.empty() ? static_cast<std::size_t>(read.count) : views.size();
  const PictureSize size = views.empty() ? read.size : PictureSize{views.front().width(), views.front().height()};
  Report told{
      {{"views", count,
        session.verbose ? fmt::format("{} views of {}x{} pixels, {}", count, size.width, size.height, read.how) : ""},
       {"output", written, fmt::format("written to {}", written)},
       {"packing", packing.name},
       {"width", size.width},
       {"height", size.height},
       {"input", read.how}}};
  return {std::move(told), written};
}

/// How a film of such frames is coded, where it is not told.
FilmWriterOptions writing_of_film(const PackArguments& arguments, const Packing& packing, PictureSize view) {
  FilmWriterOptions writing = arguments.film;
  writing.frame_rate = arguments.planes.rate;
  const DisplayComposition composition = packing.format->composition(packing);
  const auto* const layout = std::get_if<StereoLayout>(&composition);
  if (layout != nullptr) writing.layout = *layout;
  const bool is_of_eyes = layout != nullptr || std::holds_alternative<AnaglyphKind>(composition);
  if (!is_of_eyes)
    choose_coding(arguments.given,
                  {.views = {.width = view.width, .height = view.height},
                   .quilt = packing.format->name == "quilt" ? packing.quilt : std::nullopt,
                   .screen = packing.screen},
                  writing);
  const Arrangement arrangement = layout != nullptr ? traits_of(*layout).arrangement : Arrangement::whole;
  const bool are_apart = arrangement == Arrangement::side_by_side || arrangement == Arrangement::over_under;
  // What lies pixel beside pixel, or is told apart by its colour, keeps its colours at full size.
  if (is_of_eyes && !are_apart) keep_full_colour(writing);
  return writing;
}

/// A film in which planes travel through a painting.
Report pack_slice_film(const PackArguments& arguments, const Session& session) {
  const Packing packing = find_packing(arguments.packing, arguments.output);
  if (!packing.format->composition)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("--to {}: is no format of a film's frames, expected a layout of both views, an anaglyph, "
                            "quilt or lenticular",
                            packing.name));
  const ViewsArguments input = input_of(arguments, packing, session);
  std::vector<fs::path> inputs = files_read(input);
  inputs.emplace_back(arguments.packing.screen);
  const int wanted = views_wanted(packing);
  report(session.progress, "reading", 0);
  const Painting painting = read_painting_argument(input, wanted);
  const PictureSize size{width_of(painting), height_of(painting)};
  const double aspect = packing.aspect > 0 ? packing.aspect : static_cast<double>(size.width) / size.height;
  const bool is_quilt = packing.format->name == "quilt";
  const std::string output = name_of_film(arguments.output, is_quilt ? packing.quilt : std::nullopt, aspect);
  check_not_an_input(output, inputs);
  const PrintFrame frame = print_frame_from(arguments.print, {}, inputs.front());
  PictureSize frame_size{0, 0};
  const auto picture = [&](const Painting& sliced_painting) {
    ReadViews read = draw_painting_argument(sliced_painting, input, wanted, {});
    if (input.swap) std::ranges::reverse(read.views);
    if (arguments.given("--framing") && !arguments.packing.display.empty()) reframe(read.views, arguments);
    Image<Rgb8> composed = std::move(read.composed);
    if (composed.empty())
      composed = compose(put_in_frame(std::move(read.views), arguments.print, frame, arguments.shift_px, session),
                         packing.format->composition(packing));
    frame_size = {composed.width(), composed.height()};
    return composed;
  };
  const SliceFilmOptions options{.slicing = input.slicing,
                                 .from = arguments.planes.from,
                                 .to = arguments.planes.to,
                                 .frames = arguments.planes.frames,
                                 .writing = writing_of_film(arguments, packing, size)};
  const std::vector<std::string> notes = write_slice_film(painting, picture, output, options, session.progress);
  return {{{"output", output, fmt::format("written to {}", output)},
           {"frames", options.frames},
           {"packing", packing.name},
           {"width", frame_size.width},
           {"height", frame_size.height},
           {"notes", notes, lines("note: ", notes)}}};
}

bool makes_slices(const PackArguments& arguments) { return arguments.packing.to == "slices"; }

/// The surfaces of a painting, or of a photograph, with the pictures on them.
PicturesOnSurfaces read_surfaces(const PackArguments& arguments, const Session& session) {
  if (unless_painting(arguments.input)().empty()) {
    report(session.progress, "reading", 0);
    Painting painting = read_painting_for_views(arguments.input.files.front());
    const int longer = std::max(width_of(painting), height_of(painting));
    if (arguments.max_size > 0 && arguments.max_size < longer)
      painting = scaled(painting, static_cast<double>(arguments.max_size) / longer);
    return pictures_on_surfaces(sliced(painting, arguments.input.slicing));
  }
  if (!is_photograph(arguments.input) || is_photograph_folder(arguments.input))
    throw Error(ErrorKind::wrong_usage,
                fmt::format("--to slices: works on a painting (.wst) or a photograph, not on {}",
                            arguments.input.files.front()));
  const MeasuredPhotograph photograph = measure_photograph(
      {arguments.input, arguments.packing, arguments.depth, arguments.given, arguments.shift_px, arguments.max_size},
      session);
  constexpr ViewRange wanted{ViewPosition(-1.f), ViewPosition(1.f)};
  return pictures_on_surfaces(photograph.pictures, photograph.geometry, wanted);
}

/// A painting, or a photograph, as slices, whose depth is chosen when they are shown.
Report pack_slices(const PackArguments& arguments, const Session& session) {
  if (fs::path(arguments.output).extension() != ".exr")
    throw Error(ErrorKind::wrong_usage,
                fmt::format("--output: is {}, expected a name that ends with .exr for slices", arguments.output));
  std::vector<fs::path> inputs = files_read(arguments.input);
  inputs.emplace_back(arguments.depth.file);
  check_not_an_input(arguments.output, inputs);
  const PicturesOnSurfaces scene = read_surfaces(arguments, session);
  report(session.progress, "slicing", 0);
  const SliceStack stack =
      slices_of(scene, arguments.given("--zero-parallax") ? std::optional(arguments.shift_px) : std::nullopt);
  report(session.progress, "writing", 0);
  write_slices(arguments.output, stack);
  return {{{"slices", stack.slices.size()},
           {"output", arguments.output, fmt::format("written to {}", arguments.output)},
           {"packing", "slices"},
           {"width", stack.width},
           {"height", stack.height}}};
}

/// The packed file of a job, or its folder of views; none where it was not packed. A quilt's name says its layout.
std::optional<fs::path> packed_file(const PhotographJob& job, const Packing& packing) {
  const fs::path file = job.output;
  std::error_code error;
  if (packing.format->name != "quilt") return fs::exists(file, error) ? std::optional(file) : std::nullopt;
  const std::string begin = file.filename().string() + "_qs";
  for (const fs::directory_entry& entry : fs::directory_iterator(file.parent_path(), error))
    if (entry.path().filename().string().starts_with(begin)) return entry.path();
  return {};
}

/// The picture of a packed file for the contact sheet.
std::optional<fs::path> shown_of(const PhotographJob& job, const Packing& packing, const std::string& format) {
  std::optional<fs::path> file = packed_file(job, packing);
  if (file && packing.format->name == "views") file = *file / fmt::format("view_000.{}", format);
  return file && (is_picture_name(*file) || is_stereo_file_name(*file)) ? file : std::nullopt;
}

/// Packs each photograph in a folder.
Report pack_folder(const PackArguments& arguments, const Session& session) {
  const Packing packing = find_packing(arguments.packing, arguments.output);
  const StereoArguments photographs{
      .left = {}, .right = {}, .layout = arguments.input.layout, .swap = arguments.input.swap};
  PhotographWork work{
      .input = arguments.input.files.front(),
      .output = arguments.output,
      .folder = arguments.walk,
      .done = "packed",
      .max_size = arguments.max_size,
      .work = {},
      .is_done = [&](const PhotographJob& job) { return packed_file(job, packing).has_value(); },
      .shown = [&](const PhotographJob& job) { return shown_of(job, packing, arguments.packing.format); }};
  work.work = [&](const PhotographJob& job, const Session& of_one) {
    PackArguments one = arguments;
    read_photograph_of(job, one.input, one.depth);
    one.output = job.output;
    one.packing.to = packing.name;  // whatever the ending says
    if (one.input.files.size() > 1 && one.input.swap) std::swap(one.input.files[0], one.input.files[1]);
    if (one.input.files.size() > 1) one.input.swap = false;
    return pack_one(one, of_one);
  };
  const FolderOutput output{.folder = arguments.output,
                            .ending = ending_for(packing, arguments.packing, arguments.given("--format")),
                            .placeholders = {{"to", packing.name}}};
  return work_on_all(work, photographs_in_folder(work.input, photographs, arguments.walk, output, session), session);
}

Report run_pack(const PackArguments& arguments, const Session& session) {
  if (makes_slice_film(arguments.planes)) return pack_slice_film(arguments, session);
  if (are_films(arguments.input.files, arguments.output))
    return run_pack_film({arguments.input.files, arguments.input.layout, arguments.packing.to, arguments.output,
                          arguments.input.swap, arguments.shift_px, arguments.film},
                         session);
  if (makes_slices(arguments)) return pack_slices(arguments, session);
  if (is_photograph_folder(arguments.input)) return pack_folder(arguments, session);
  return pack_one(arguments, session).report;
}

Rows pack_rows(PackArguments& a) {
  a.input.into_one_file = [&a] { return fs::path(a.output).has_extension(); };
  const auto are_made = [&a] { return makes_views(a.input, find_packing(a.packing, a.output), a.packing, a.depth); };
  Row max_size = max_size_row(
      a.max_size, {[are_made, unless = unless_matched(a.packing, a.output)] { return are_made() ? "" : unless(); }});
  const Reason no_depth = when([&a] { return !has_own_depth(a.input, a.depth); }, "without --depth");
  const Reason no_picture =
      when([&a] { return a.input.files.size() != 1 || !is_photograph(a.input) || is_photograph_folder(a.input); },
           "on several views; it works on one picture");
  const Reason no_frame =
      when([&a] { return a.packing.display.empty() && !sets_caption(find_packing(a.packing, a.output)); },
           "without --display; it works with --display and --to card");
  const auto on_folder = [&a] { return is_photograph_folder(a.input); };
  const Reason no_painting = unless_painting(a.input);
  const auto is_film_of_planes = [&a] { return makes_slice_film(a.planes); };
  const Reason strips_vary =
      when([&a] { return makes_slice_film(a.planes) && a.print.floating_window && !*a.print.floating_window; },
           "as 'auto' on a film of planes; it works with widths");
  Rows walk = folder_rows(a.walk, on_folder, "packed", "; {to}, the format");
  walk.push_back(contact_sheet_row(a.walk, on_folder));
  const auto on_films = [&a] { return are_films(a.input.files, a.output); };
  max_size.help =
      "Match a reduced copy whose longer side has at most this many pixels; slices of a painting get this size";
  Rows rows =
      join({views_rows(a.input, are_made),
            {views_device_row(a.input),
             row("-o,--output", required(output_name(a.output)),
                 "File; a folder for views, or for the results of a folder; the stem of the file for a quilt")},
            packing_rows(a.packing, a.output),
            {row("--zero-parallax,--shift", number(a.shift_px, {-65535, 65535}),
                 "Disparity in pixels, from each view to the next, that lies on the screen plane"),
             max_size},
            {framing_row(a.packing.framing, "on the display or the card", {no_frame})},
            slicing_rows(a.input.slicing, {no_painting}, is_film_of_planes),
            walk,
            under({}, depth_rows(a.depth, no_depth), {no_picture}),
            print_rows(a.print, {if_matched(a.packing, a.output)}, {if_card(a.packing, a.output)}, {strips_vary})});
  // What works on films, too; of all else it is said first, before formats of pictures are looked for.
  constexpr std::array<std::string_view, 6> for_films{"VIEWS",    "--layout", "--swap",
                                                      "--output", "--to",     "--zero-parallax"};
  for (Row& row : rows)
    if (std::ranges::find(for_films, name_of(row)) == for_films.end())
      row.unless.insert(row.unless.begin(), when(on_films, "on a film; it works on pictures"));
  constexpr std::array<std::string_view, 8> for_slices{
      "VIEWS", "--output", "--max-size", "--to", "--zero-parallax", "--slice-layer", "--slice-depth", "--slice-keep"};
  constexpr std::array<std::string_view, 7> for_slices_of_photographs{
      "--layout", "--swap", "--rectify", "--depth", "--depth-model", "--depth-is", "--strength"};
  for (Row& row : rows) {
    if (std::ranges::find(for_slices, name_of(row)) != for_slices.end()) continue;
    const bool of_photographs =
        std::ranges::find(for_slices_of_photographs, name_of(row)) != for_slices_of_photographs.end();
    row.unless.push_back(
        when([&a, of_photographs] { return makes_slices(a) && !(of_photographs && is_photograph(a.input)); },
             of_photographs ? "on a painting's slices; it works on a photograph"
                            : "with --to slices; it works where views are made"));
  }
  const Reason no_film = when([on_films] { return !on_films(); }, "on pictures; it works on a film");
  const Reason writes_no_film = when([on_films, is_film_of_planes] { return !on_films() && !is_film_of_planes(); },
                                     "on pictures; it works on a film, and with --slice-from and --slice-to");
  return join({rows, slice_film_rows(a.planes, {no_painting}), pack_film_rows(a.film, no_film, writes_no_film)});
}

}  // namespace

Command pack_command() {
  return make_command("pack", "Convert views, or a film, to the format of a display", pack_rows, run_pack,
                      R"(Examples:
  wheatstone pack photograph.mpo --to anaglyph -o anaglyph.png
  wheatstone pack left.png right.png --to top-bottom-half -o tv.jpg
  wheatstone pack left.png right.png -o photograph.mpo
  wheatstone pack photograph.mpo --to anaglyph --floating-window auto --border 3% --caption {title} -o print.jpg
  wheatstone pack photograph.mpo --caption {title} -o card.pdf
  wheatstone pack photo.jpg --depth depth.png --display looking-glass-portrait -o photo
  wheatstone pack painting.wst --slice-depth 40% -o sliced.mpo
  wheatstone pack painting.wst --to slices -o planes.exr
  wheatstone pack photo.jpg --depth depth.png --to slices -o photo.exr
  wheatstone pack painting.wst --slice-from 0% --slice-to 100% --frames 120 -o slices.mp4
  wheatstone pack views --to lenticular --screen step-9 -o screen.png
  wheatstone pack views --to quilt --quilt 8x6 -o universe
  wheatstone pack photographs --to anaglyph --format jpg -o anaglyphs
  wheatstone pack film.mp4 --to left-right-half -o tv.mp4)");
}

}  // namespace wheatstone::cli
