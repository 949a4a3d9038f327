// Files and films.

#include <fmt/format.h>

#include <memory>

#include "command_line.h"
#include "command_table.h"
#include "folder_items.h"
#include "particle_film.h"
#include "particle_scene.h"
#include "save_as.h"
#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/painting/style_parameters.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::viewer {
namespace {

void open_files(Viewer& viewer, const Words& words) {
  const Item files(words.begin(), words.end());
  if (files.size() == 1 && is_folder(files.front())) return viewer.open_folder(files.front());
  const auto series = series_of_files(files);
  viewer.open_files(series ? Item{*series} : files);
}

void set_slideshow(Viewer& viewer, const Words& words) {
  constexpr double longest_s = 3600;
  Session& session = viewer.session();
  session.slideshow_s = words[0] == "off" ? 0 : number_of(words[0], 0.1, longest_s);
  if (session.slideshow_s > 0 && session.walk.size() < 2) viewer.tell("there is no other file to go on to");
}

std::vector<Choice> slideshow_choices(const Viewer& /*viewer*/) {
  return {{"off", "Off"}, {"3", "3 seconds"}, {"5", "5 seconds"}, {"10", "10 seconds"}, {"30", "30 seconds"}};
}

bool has_other_files(const Viewer& viewer) { return viewer.session().walk.size() > 1; }

void open_series(Viewer& viewer, const Words& /*words*/) {
  const Item* const item = open_item(viewer.session());
  const auto pattern = item == nullptr ? std::nullopt : series_pattern_of(item->front());
  if (!pattern || open_particles(viewer) == nullptr)
    return viewer.tell("no snapshot of a numbered series is open", true);
  open_files(viewer, {pattern->string()});
}

void save_seen_as(Viewer& viewer, const Words& words) {
  const std::string &format = words[0], &path = words[1];
  if (format == "picture") return run_command(viewer, find_command("save-picture"), {path});
  frame_of(viewer);
  const Session& session = viewer.session();
  const Item* const item = open_item(session);
  const SeenToSave seen{session.opened.content, session.state, session.eye, item == nullptr ? Item() : *item};
  viewer.save(path, [seen, format, path, framing = Words(words.begin() + 2, words.end())] {
    save_as(seen, format, path, framing);
  });
}

void save_painting(Viewer& viewer, const Words& words) {
  const auto* const content = std::get_if<PaintedContent>(&viewer.session().opened.content);
  if (content == nullptr || !content->painting) throw Error(ErrorKind::wrong_usage, "there is no painting to save");
  viewer.save(
      words[0], [path = words[0], painting = content->painting] { write_painting(path, *painting); },
      [&viewer] { viewer.session().has_unsaved_work = false; });
}

void save_style(Viewer& viewer, const Words& words) {
  write_whole_file(words[0], style_to_toml(state_of(viewer).style));
  viewer.session().has_unsaved_work = false;
  viewer.tell("saved " + words[0]);
}

constexpr Command file_table[] = {
    // name, arguments, menu, text, keys
    {"open", "FILE [RIGHT]", "File", "Open…", "Ctrl+O", open_files, {.icon = "open"}},
    {"open-folder", "FOLDER", "File", "Open folder…", "",
     [](Viewer& v, const Words& w) {
       if (!is_folder(w[0])) throw Error(ErrorKind::wrong_usage, fmt::format("{}: is no folder", w[0]));
       v.open_folder(w[0]);
     }},
    {"open-example", "", "File", "Open an example", "", [](Viewer& v, const Words&) { v.open_example(); }},
    {"open-series",
     "",
     "File",
     "Open the series of this snapshot",
     "Ctrl+Shift+O",
     open_series,
     {.applies = [](const Viewer& v) { return shows_particles(v); }}},
    {"find-other-view",
     "",
     "File",
     "Find the other view of this picture",
     "O",
     [](Viewer& v, const Words&) { v.open_other_eye(); },
     {.applies = [](const Viewer& v) { return has_one_view(v.session().opened.content); }}},
    {"next-file",
     "",
     "File",
     "Next file",
     "PgDown",
     [](Viewer& v, const Words&) { v.step_file(1); },
     {.applies = has_other_files, .begins_group = true}},
    {"previous-file",
     "",
     "File",
     "Previous file",
     "PgUp",
     [](Viewer& v, const Words&) { v.step_file(-1); },
     {.applies = has_other_files}},
    {"slideshow",
     "SECONDS|off",
     "File",
     "Slideshow: seconds that each file of the folder is shown",
     "",
     set_slideshow,
     {.choices = slideshow_choices,
      .now =
          [](const Viewer& v) {
            const double shown_s = v.session().slideshow_s;
            return shown_s > 0 ? fmt::format("{}", shown_s) : std::string("off");
          },
      .applies = has_other_files}},
    {"save-picture",
     "FILE",
     "File",
     "Save picture…",
     "Ctrl+S",
     [](Viewer& v, const Words& w) {
       const auto picture = std::make_shared<const Image<Rgb8>>(frame_of(v).picture);
       v.save(w[0], [path = w[0], picture] { write_image(path, *picture); });
     },
     {.applies = [](const Viewer& v) { return shows_something(v); }, .begins_group = true}},
    {"save-as",
     "FORMAT FILE [OPTION=VALUE] [OPTION=VALUE] [OPTION=VALUE] [OPTION=VALUE]",
     "File",
     "Save as…",
     "Ctrl+E",
     save_seen_as,
     {.applies = [](const Viewer& v) { return shows_something(v); }, .icon = "save"}},
    {"save-painting",
     "FILE",
     "File",
     "Save painting…",
     "Ctrl+Shift+S",
     save_painting,
     {.applies = [](const Viewer& v) { return shows_painting(v); }}},
    {"save-style",
     "FILE",
     "File",
     "Save style…",
     "",
     save_style,
     {.applies = [](const Viewer& v) { return shows_painting(v); }}},
    {"copy-command",
     "",
     "File",
     "Copy command",
     "Ctrl+Shift+C",
     [](Viewer& v, const Words&) { v.tell(command_line_of(v.session())); },
     {.applies = [](const Viewer& v) { return shows_something(v); }}},
    {"quit",
     "",
     "File",
     "Quit",
     "Q, Ctrl+Q",
     [](Viewer& v, const Words&) { v.session().ends = true; },
     {.begins_group = true}},
};

/// Throws Error{wrong_usage} where nothing is open that goes on in time.
FilmStatus& film_of(Viewer& viewer) {
  if (!viewer.session().film) throw Error(ErrorKind::wrong_usage, "no film is open");
  return *viewer.session().film;
}

void play_or_pause(Viewer& viewer, const Words& /*words*/) {
  if (!viewer.session().film) return;
  if (film_of(viewer).plays)
    viewer.pause_film();
  else
    viewer.play_film();
}

void set_film_painting(Viewer& viewer, const Words& words) {
  film_of(viewer).paints = switch_of(words[0]);
  viewer.show_standing_frame();
}

constexpr double longest_film_s = 1e7;

constexpr Command film_table[] = {
    // name, arguments, menu, text, keys
    {"play-or-pause", "", "Film", "Play, or pause what plays", "Space", play_or_pause},
    {"play", "", "Film", "Play", "", [](Viewer& v, const Words&) { v.play_film(); }, {.is_for_scripts = true}},
    {"pause", "", "Film", "Pause", "", [](Viewer& v, const Words&) { v.pause_film(); }, {.is_for_scripts = true}},
    {"frame-step", "", "Film", "Next frame", ".", [](Viewer& v, const Words&) { v.step_film(1); }},
    {"frame-back", "", "Film", "Previous frame", ",", [](Viewer& v, const Words&) { v.step_film(-1); }},
    {"seek", "SECONDS", "Film", "Skip forward by so many seconds, or back if negative", "",
     [](Viewer& v, const Words& w) {
       v.seek_film(film_of(v).seconds + number_of(w[0], -longest_film_s, longest_film_s));
     }},
    {"seek-to", "SECONDS", "Film", "Go to a time", "",
     [](Viewer& v, const Words& w) {
       film_of(v);
       v.seek_film(number_of(w[0], 0, longest_film_s));
     }},
    {"film-painting",
     "on|off",
     "Film",
     "Paint the current frame of the film",
     "",
     set_film_painting,
     {.now = [](const Viewer& v) { return on_or_off(v.session().film && v.session().film->paints); },
      .begins_group = true}},
    {"paint-film",
     "FILE",
     "Film",
     "Paint the whole film…",
     "",
     [](Viewer& v, const Words& w) { v.paint_whole_film(w[0]); },
     {.begins_group = true}},
    {"cancel",
     "",
     "Film",
     "Stop painting the film",
     "",
     [](Viewer& v, const Words&) { v.cancel_whole_film(); },
     {.applies = [](const Viewer& v) { return v.session().whole_film.has_value(); }}},
};

}  // namespace

std::span<const Command> file_commands() { return file_table; }

std::span<const Command> film_commands() { return film_table; }

}  // namespace wheatstone::viewer
