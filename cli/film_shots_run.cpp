#include "film_shots_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "film_mask_argument.h"
#include "wheatstone/app/film_preview.h"
#include "wheatstone/app/film_scenes.h"
#include "wheatstone/app/list_shots.h"
#include "wheatstone/app/place_shots.h"
#include "wheatstone/error.h"

namespace wheatstone::cli {

namespace {

/// "about 50 s", "about 12 min", "about 3.5 h".
std::string duration_text(double seconds) {
  if (seconds < 100) return fmt::format("about {:.0f} s", std::max(seconds, 1.));
  if (seconds < 6000) return fmt::format("about {:.0f} min", seconds / 60);
  return fmt::format("about {:.1f} h", seconds / 3600);
}

}  // namespace

Rows shots_rows(ShotsArguments& arguments, const Reasons& unless, const Reasons& no_preview) {
  return under("Shots",
               {row("--list-shots", of_type("FILE", text(arguments.list)),
                    "Only find the cuts, and write the shots to this file (.toml), to be edited, with a small picture "
                    "of each beside it"),
                row("--shots", of_type("FILE", text(arguments.file)),
                    "Paint the shots of this file (.toml), each in its own style and depth; no other cuts are looked "
                    "for",
                    unless),
                row("--preview", of_type("FILE", text(arguments.preview)),
                    "Only show how the film will look: five frames of each shot, a third as wide, on one sheet (.png, "
                    ".jpg); and tell about how long it takes to paint the film, and how large it becomes",
                    no_preview, {}, {"--plan", "--resume", "--save-marks", "--truth"})});
}

Rows refused_on_list(Rows rows, const ShotsArguments& arguments) {
  constexpr std::array<std::string_view, 5> of_lists{"FILM", "RIGHT", "--list-shots", "--layout", "--rate"};
  for (Row& one : rows)
    if (std::ranges::find(of_lists, name_of(one)) == of_lists.end())
      one.unless.push_back(when([&arguments] { return !arguments.list.empty(); },
                                "with --list-shots, which lists the whole film and paints nothing"));
  return rows;
}

std::vector<FilmShot> shots_from(const ShotsArguments& arguments, const FilmFiles& film,
                                 const RotoscopeFilmOptions& options, LimitedFilm limited, const Session& session) {
  std::string no_budget, no_plane;
  if (limited.of_marks) no_budget = no_plane = "on marks (.wst); they have the depth of the film";
  if (limited.of_one_eye) no_budget = no_plane = "on a film of one eye";
  if (options.mask) no_budget = no_plane = keeps_depth_in_masks;
  if (options.frames.display) no_budget = "with --display; --span sets how deep it looks";
  std::vector<UnusedKey> unused;
  if (limited.of_one_eye || options.known)
    unused.push_back({"disparity", limited.of_one_eye ? "on a film of one eye" : "on a film whose depth is known"});
  if (!no_budget.empty()) unused.push_back({"depth-budget", no_budget});
  if (!no_plane.empty()) unused.push_back({"zero-parallax", no_plane});
  if (limited.of_marks) unused.push_back({"dissolve", "on marks (.wst); they are not drawn"});
  if (options.frames.display)
    unused.push_back({"zero-parallax", "in a key with --display; a shot is planned for one screen plane", true});
  return place_shots(read_shots(arguments.file, options.frames, unused), film, options.reading, session.progress);
}

std::vector<FilmShot> shots_found(const FilmFiles& film, const RotoscopeFilmOptions& options, const Session& session) {
  StereoFilmReader looked_at = open_film(film, options.reading);
  const RotoscopeOptions& all = options.frames;
  std::vector<FilmShot> shots;
  for (const std::int64_t begin : find_scenes(looked_at, session.ranks, session.progress).begins)
    shots.push_back({begin, all.style, all.depth_budget, all.zero_parallax_px});
  return shots;
}

Report run_list(const ShotsArguments& arguments, const FilmFiles& film, const FilmReaderOptions& reading,
                const Session& session) {
  if (!session.ranks.alone())
    throw Error(ErrorKind::wrong_usage, "--list-shots works in one process, not under mpirun");
  const std::vector<FoundShot> shots = list_shots(film, reading, arguments.list, session.progress);
  Json listed = Json::array();
  for (const FoundShot& shot : shots)
    listed.push_back({{"begin", shot.begin + 1},
                      {"frames", shot.frames},
                      {"begin_s", shot.begin_s},
                      {"length_s", shot.length_s},
                      {"thumbnail", shot.thumbnail},
                      {"mixed_before", shot.mixed_before}});
  return {{{"output", arguments.list},
           {"shots", listed, fmt::format("shots            {}", shots.size())},
           only_text(fmt::format("written to       {}, with a picture of each shot beside it", arguments.list))}};
}

Report run_preview(const ShotsArguments& arguments, const FilmFiles& film, const std::string& output,
                   const RotoscopeFilmOptions& options, const Session& session) {
  if (!session.ranks.alone()) throw Error(ErrorKind::wrong_usage, "--preview works in one process, not under mpirun");
  const FilmPreview preview = preview_film(film, output, arguments.preview, options, session.progress);
  const double megabytes = preview.bytes / 1e6;
  return {{{"output", arguments.preview},
           {"shots", preview.shots, fmt::format("shots            {}, {} frames", preview.shots, preview.frames)},
           {"frames", preview.frames},
           {"expected_seconds", preview.seconds,
            fmt::format("time             {}, {:.2f} s a frame", duration_text(preview.seconds),
                        preview.seconds / static_cast<double>(preview.frames))},
           {"expected_megabytes", megabytes,
            fmt::format("size             about {:.{}f} MB, without sound", megabytes, megabytes < 10 ? 1 : 0)},
           only_text(fmt::format("written to       {}; the film is not painted", arguments.preview))}};
}

}  // namespace wheatstone::cli
