#include "command_groups_internal.h"
#include "wheatstone/error.h"

namespace wheatstone::viewer {
namespace {

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
    {"play", "", "Film", "Play", "", [](Viewer& v, const Words&) { v.play_film(); }},
    {"pause", "", "Film", "Pause", "", [](Viewer& v, const Words&) { v.pause_film(); }},
    {"frame-step", "", "Film", "Next frame", ".", [](Viewer& v, const Words&) { v.step_film(1); }},
    {"frame-back", "", "Film", "Previous frame", ",", [](Viewer& v, const Words&) { v.step_film(-1); }},
    {"seek", "SECONDS", "Film", "Go so many seconds on, or back where negative", "",
     [](Viewer& v, const Words& w) {
       v.seek_film(film_of(v).seconds + number_of(w[0], -longest_film_s, longest_film_s));
     }},
    {"seek-to", "SECONDS", "Film", "Go to a time", "",
     [](Viewer& v, const Words& w) {
       film_of(v);
       v.seek_film(number_of(w[0], 0, longest_film_s));
     }},
    {"film-painting", "on|off", "Film", "Paint the frame at which the film stands", "", set_film_painting},
    {"paint-film", "FILE", "Film", "Paint the whole film…", "",
     [](Viewer& v, const Words& w) { v.paint_whole_film(w[0]); }},
    {"cancel", "", "Film", "Stop painting the film", "", [](Viewer& v, const Words&) { v.cancel_whole_film(); }},
};

}  // namespace

std::span<const Command> film_commands() { return film_table; }

}  // namespace wheatstone::viewer
