#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "commands.h"
#include "film_argument.h"
#include "wheatstone/app/film_presentation.h"
#include "wheatstone/app/report.h"
#include "wheatstone/error.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/matching/match.h"
#include "wheatstone/measures/film_measures.h"
#include "wheatstone/measures/wrong_spots.h"
#include "wheatstone/motion/flow_file.h"
#include "wheatstone/painting/two_eyes.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/strokes/strokes_between_frames.h"
#include "wheatstone/video/film_files.h"
#include "wheatstone/video/frame_sequence.h"

namespace wheatstone::cli {
namespace {

namespace fs = std::filesystem;

struct MeasureFilmArguments {
  std::vector<std::string> films;
  std::string source;
  std::optional<StereoLayout> layout;
  std::string truth;
  std::string marks;
  int fade_frames = 2;
  int frames = 0;  ///< 0: all
  int stereo_step = 1;
};

/// A film that is being measured, frame by frame.
struct MeasuredFilm {
  std::string name;
  StereoFilmReader reader;
  StereoFrame now{}, before{};
  bool ended = false;
  TemporalError temporal{};
  Json pairs = Json::array();
  std::vector<Json> stereo{};       ///< a frame each
  std::vector<WrongSpots> wrong{};  ///< against the source, a frame each, of both eyes where there are two
};

/// The mean of like objects of numbers, number by number.
Json mean_of(const std::vector<Json>& objects) {
  if (!objects.front().is_object()) {
    double sum = 0;
    for (const Json& number : objects) sum += number.get<double>();
    return sum / static_cast<double>(objects.size());
  }
  Json mean;
  for (const auto& item : objects.front().items()) {
    std::vector<Json> values;
    for (const Json& object : objects) values.push_back(object.at(item.key()));
    mean[item.key()] = mean_of(values);
  }
  return mean;
}

/// Reads the next frame of the source and of every film. False where one of them ends.
bool read_frames(std::vector<MeasuredFilm>& films) {
  const MeasuredFilm& source = films.front();
  for (MeasuredFilm& film : films) {
    std::swap(film.before, film.now);
    film.ended = !film.reader.read(film.now);
  }
  if (std::ranges::any_of(films, &MeasuredFilm::ended)) return false;
  for (const MeasuredFilm& film : films) {
    if (!same_size(film.now.left, source.now.left))
      throw Error(ErrorKind::bad_input,
                  fmt::format("{}: is {}x{} pixels, expected {}x{} as {}", film.name, film.now.left.width(),
                              film.now.left.height(), source.now.left.width(), source.now.left.height(), source.name));
  }
  return true;
}

/// Which films end before the others; empty where all have as many frames as were compared.
std::vector<std::string> names_of_shorter(const std::vector<MeasuredFilm>& films) {
  std::vector<std::string> names;
  for (const MeasuredFilm& film : films)
    if (film.ended) names.push_back(film.name);
  if (names.size() == films.size()) names.clear();
  return names;
}

fs::path truth_file(const MeasureFilmArguments& arguments, const char* name, int frame, const char* extension) {
  return fs::path(arguments.truth) / fmt::format("{}_{:04}{}", name, frame, extension);
}

template <class Picture>
void expect_size(const Picture& truth, const fs::path& file, const MeasuredFilm& source) {
  const Image<Rgb8>& picture = source.now.left;
  if (!same_size(truth, picture))
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: is {}x{} pixels, expected {}x{} as {}", file.string(), truth.width(), truth.height(),
                            picture.width(), picture.height(), source.name));
}

/// How the frame before and this one belong together, in the source.
FramePair pair_of(const MeasureFilmArguments& arguments, const MeasuredFilm& source, int frame) {
  if (arguments.truth.empty()) return relate_frames(source.before.left, source.now.left);
  const fs::path forward_file = truth_file(arguments, "flow_forward", frame - 1, ".flo");
  const fs::path backward_file = truth_file(arguments, "flow_backward", frame, ".flo");
  FlowPair truth{read_flow(forward_file), read_flow(backward_file)};
  expect_size(truth.forward.x, forward_file, source);
  expect_size(truth.backward.x, backward_file, source);
  return relate_frames(std::move(truth));
}

void measure_stereo(const MeasureFilmArguments& arguments, std::vector<MeasuredFilm>& films, int frame) {
  const MeasuredFilm& source = films.front();
  if (std::ranges::none_of(films, [](const MeasuredFilm& film) { return !film.now.right.empty(); })) return;
  Image<float> disparity;
  if (!arguments.truth.empty()) {
    const fs::path file = truth_file(arguments, "left_disparity", frame, ".pfm");
    disparity = read_disparity(file);
    expect_size(disparity, file, source);
  } else if (!source.now.right.empty()) {
    disparity = match({source.now.left, source.now.right}).geometry.left_disparity;
  } else {
    return;
  }
  for (MeasuredFilm& film : films) {
    if (film.now.right.empty()) continue;
    Json facts = Json::parse(pair_measures_json(measure_pair({film.now.left, film.now.right}, disparity)));
    film.stereo.push_back(std::move(facts));
  }
}

/// How much of a frame has colours that the source's frame has nowhere near.
void measure_wrong(std::vector<MeasuredFilm>& films) {
  const StereoFrame& source = films.front().now;
  for (std::size_t i = 1; i < films.size(); ++i) {
    const StereoFrame& now = films[i].now;
    const bool two_eyes = !now.right.empty() && !source.right.empty();
    films[i].wrong.push_back(
        two_eyes ? measure_wrong_spots(StereoPairView{now.left, now.right}, StereoPairView{source.left, source.right})
                 : measure_wrong_spots(now.left, source.left));
  }
}

double mean_wrong_share(const MeasuredFilm& film) {
  double sum = 0;
  for (const WrongSpots& spots : film.wrong) sum += spots.share;
  return sum / static_cast<double>(film.wrong.size());
}

/// The frame, from 0, that has most wrong pixels.
std::size_t worst_frame(const MeasuredFilm& film) {
  return static_cast<std::size_t>(std::ranges::max_element(film.wrong, {}, &WrongSpots::share) - film.wrong.begin());
}

Json wrong_to_json(const MeasuredFilm& film) {
  Json frames = Json::array();
  double spots_sum = 0;
  for (const WrongSpots& spots : film.wrong) {
    frames.push_back({{"share", spots.share}, {"spots_per_100000_px", spots.spots_per_100000_px}});
    spots_sum += spots.spots_per_100000_px;
  }
  const std::size_t worst = worst_frame(film);
  return {{"mean_share", mean_wrong_share(film)},
          {"worst_share", film.wrong[worst].share},
          {"worst_frame", worst},
          {"mean_spots_per_100000_px", spots_sum / static_cast<double>(film.wrong.size())},
          {"frame", frames}};
}

void measure_temporal(std::vector<MeasuredFilm>& films, const FramePair& pair, int frame) {
  for (MeasuredFilm& film : films) {
    const std::optional<WarpError> error = film.temporal.add(film.before.left, film.now.left, pair);
    Json facts{{"frame", frame - 1}, {"cut", pair.cut}};
    if (error) facts.update(Json{{"temporal_error", error->error}, {"compared_share", error->compared_share}});
    film.pairs.push_back(std::move(facts));
  }
}

Json to_json(const MeasuredFilm& film) {
  Json facts{{"film", film.name}, {"pairs", film.temporal.pairs()}};
  if (film.temporal.pairs() > 0) {
    facts["temporal_error"] = film.temporal.mean();
    facts["compared_share"] = film.temporal.compared_share();
  }
  if (!film.wrong.empty()) facts["wrong"] = wrong_to_json(film);
  if (!film.stereo.empty()) {
    facts["stereo_frames"] = film.stereo.size();
    facts["stereo"] = mean_of(film.stereo);
    facts["stereo_a_frame"] = film.stereo;
  }
  facts["pair"] = film.pairs;
  return facts;
}

/// Which films were not drawn for the eyes of their source: a sentence each.
std::vector<std::string> notes_of_moved_eyes(const std::vector<MeasuredFilm>& films) {
  std::vector<std::string> notes;
  for (const MeasuredFilm& film : films)
    if (tells_moved_eyes(film.reader.facts().comment))
      notes.push_back(fmt::format(
          "{}: {}; its eyes do not fit the source's disparities, so paint it with --depth-budget full to measure it",
          film.name, film.reader.facts().comment));
  return notes;
}

std::string table_of(const std::vector<MeasuredFilm>& films) {
  std::size_t width = 16;
  for (const MeasuredFilm& film : films) width = std::max(width, film.name.size());
  constexpr auto line = "{:<{}}{:>14}{:>12}{:>11}{:>14}{:>14}{:>10}{:>10}";
  std::vector<std::string> all{fmt::format(line, "", width, "E_warp x 1000", "of source", "compared", "left - right",
                                           "depth found", "wrong", "at worst")};
  const double source_error = films.front().temporal.mean();
  for (const MeasuredFilm& film : films) {
    const TemporalError& error = film.temporal;
    const bool stereo = !film.stereo.empty(), temporal = error.pairs() > 0;
    const Json mean = stereo ? mean_of(film.stereo) : Json();
    all.push_back(
        fmt::format(line, film.name, width, temporal ? fmt::format("{:.4f}", 1000 * error.mean()) : "",
                    source_error > 0 ? fmt::format("{:.2f}", error.mean() / source_error) : "",
                    temporal ? fmt::format("{:.1f} %", 100 * error.compared_share()) : "",
                    stereo ? fmt::format("{:.2f}", mean.at("left_right_mean_absolute").get<double>()) : "",
                    stereo ? fmt::format("{:.1f} %", 100 * mean.at("survival_density").get<double>()) : "",
                    film.wrong.empty() ? "" : fmt::format("{:.2f} %", 100 * mean_wrong_share(film)),
                    film.wrong.empty() ? "" : fmt::format("{:.2f} %", 100 * film.wrong[worst_frame(film)].share)));
  }
  return lines({}, all);
}

/// What became of the strokes of a painted film whose frames' marks were kept.
struct MarksOfFilm {
  StrokeChanges changes;  ///< summed over the frames
  double worst_bare_share = 0;
  Json frames = Json::array();
};

/// How much of either eye, or of the one there is, no mark covers.
double bare_share_of(const Painting& marks, bool two_eyes) {
  return present(marks, two_eyes ? for_two_eyes() : Presentation{.views = {central_view}}).worst_bare_share;
}

MarksOfFilm measure_marks(const MeasureFilmArguments& arguments, bool two_eyes, int frames,
                          const std::vector<int>& cuts, const Session& session) {
  const std::optional<FramePattern> pattern = frame_pattern(arguments.marks);
  if (!pattern)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("--marks: is '{}', expected a place for the number, as marks_%04d.wst", arguments.marks));
  MarksOfFilm marks;
  Painting before;
  for (int frame = 0; frame < frames; ++frame) {
    report(session.progress, "marks", static_cast<double>(frame) / frames);
    Painting now = read_painting(pattern->file(frame + 1));
    const double bare = bare_share_of(now, two_eyes);
    marks.worst_bare_share = std::max(marks.worst_bare_share, bare);
    Json facts{{"frame", frame}, {"bare_share", bare}};
    if (frame > 0 && std::ranges::find(cuts, frame) == cuts.end()) {
      const StrokeChanges changes = compare_strokes(layers_of(before), layers_of(now), 1.0 / arguments.fade_frames);
      marks.changes.whole += changes.whole;
      marks.changes.survived += changes.survived;
      marks.changes.popped += changes.popped;
      facts.update(Json{{"strokes", changes.whole}, {"survived", changes.survived}, {"popped", changes.popped}});
    }
    marks.frames.push_back(std::move(facts));
    before = std::move(now);
  }
  return marks;
}

double survival_of(const StrokeChanges& changes) {
  return changes.whole > 0 ? static_cast<double>(changes.survived) / static_cast<double>(changes.whole) : 0;
}

Json to_json(const MarksOfFilm& marks) {
  return {{"survival", survival_of(marks.changes)},
          {"popped", marks.changes.popped},
          {"worst_bare_share", marks.worst_bare_share},
          {"frame", marks.frames}};
}

Report run_measure_film(const MeasureFilmArguments& arguments, const Session& session) {
  const std::optional<StereoLayout>& layout = arguments.layout;
  std::vector<MeasuredFilm> films;
  films.push_back({arguments.source, open_film(find_film(arguments.source, layout))});
  for (const std::string& name : arguments.films) films.push_back({name, open_film(find_film(name, layout))});

  const std::int64_t known = films.front().reader.facts().frame_count.value_or(0);
  const double expected = static_cast<double>(arguments.frames > 0 ? arguments.frames : known);
  std::vector<int> cuts;
  int frame = 0;
  bool two_eyes = false;
  for (; (arguments.frames == 0 || frame < arguments.frames) && read_frames(films); ++frame) {
    two_eyes = !films[1].now.right.empty();
    report(session.progress, "frames", expected > 0 ? std::min(frame / expected, 1.0) : 0);
    if (frame % arguments.stereo_step == 0) measure_stereo(arguments, films, frame);
    measure_wrong(films);
    if (frame == 0) continue;
    const FramePair pair = pair_of(arguments, films.front(), frame);
    if (pair.cut) cuts.push_back(frame);
    measure_temporal(films, pair, frame);
  }
  const std::vector<std::string> shorter = names_of_shorter(films);
  if (frame == 0 && !shorter.empty())
    throw Error(ErrorKind::bad_input, fmt::format("{}: has no frame to compare", shorter.front()));
  const std::vector<std::string> moved = notes_of_moved_eyes(films);
  Json others = Json::array();
  for (std::size_t i = 1; i < films.size(); ++i) others.push_back(to_json(films[i]));
  Report report{{{"frames", frame},
                 {"flow", arguments.truth.empty() ? "estimated" : "true"},
                 {"source", to_json(films.front()), table_of(films)},
                 {"films", others},
                 {"cuts", cuts, cuts.empty() ? "" : fmt::format("cuts before frame {}", fmt::join(cuts, ", "))}}};
  if (!moved.empty()) report.facts.push_back({"notes", moved, lines({}, moved)});
  if (!shorter.empty())
    report.facts.push_back({"shorter", shorter,
                            fmt::format("only the first {} frames are compared: {} {} there", frame,
                                        fmt::join(shorter, ", "), shorter.size() == 1 ? "ends" : "end")});
  if (arguments.marks.empty()) return report;
  const MarksOfFilm marks = measure_marks(arguments, two_eyes, frame, cuts, session);
  report.facts.push_back(
      {"marks", to_json(marks),
       fmt::format("strokes: {:.1f} % carried from frame to frame, {} popped; unpainted at most {:.3f} % of an eye",
                   100 * survival_of(marks.changes), marks.changes.popped, 100 * marks.worst_bare_share)});
  return report;
}

Rows measure_film_rows(MeasureFilmArguments& a) {
  return {row("FILMS", required(texts(a.films)),
              "Films, numbered pictures (left_%04d.png), folders of them, or one film per eye: LEFT,RIGHT"),
          row("--against", required(text(a.source)), "Source from which the films were made, in the same forms"),
          row("--truth", text(a.truth),
              "Folder from 'synth film' with the exact flow and disparities of the source, whose frames count from 0;\n"
              "by default they are estimated from the source"),
          row("--marks", text(a.marks), "Marks of the first film, from rotoscope --save-marks: marks_%04d.wst"),
          row("--fade", number(a.fade_frames, {1, 1000}),
              "Number of frames of the shorter fade; strokes that change faster count as popped", {}, "--marks"),
          row("--layout", film_layout(a.layout), "Stereo layout of films that do not specify one"),
          row("--frames", number(a.frames, {0, 1'000'000}), "Number of frames to measure, from the first; 0 for all"),
          row("--stereo-frame-step", number(a.stereo_step, {1, 1'000'000}), "Compare the eyes of every Nth frame")};
}

}  // namespace

Command measure_film_command() {
  return make_command(
      "film", "Measure flicker and stereo consistency of films", measure_film_rows, run_measure_film,
      R"(E_warp is the mean squared difference (values 0..1) between each frame of the left eye and the next frame, warped
back along the optical flow of the source. Pixels whose flow is not confirmed by the backward flow are left out,
and so are cuts. Blurring a film reduces E_warp: compare the gradient energy in --json, too. A pixel is wrong
if its colour is nowhere near that place in the source; the shares are those of the mean and of the worst frame. With
--marks, the shares of strokes that are kept and that pop are printed.

Example:
  wheatstone synth film -o film
  wheatstone rotoscope film --truth film --depth-budget full -o painted.mkv
  wheatstone measure film painted.mkv --against film --truth film)");
}

}  // namespace wheatstone::cli
