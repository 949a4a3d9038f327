#include "film_plan_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include "wheatstone/app/eyes_in_film.h"
#include "wheatstone/app/film_plan.h"
#include "wheatstone/error.h"
#include "wheatstone/files/output_paths.h"

namespace wheatstone::cli {
namespace {

namespace fs = std::filesystem;

/// The frames of --frame-range: "1-48", or "2/4" for the second of four parts of about as many segments each.
FrameRange part_of(const FilmPlan& plan, const std::string& words) {
  const auto frames = static_cast<std::int64_t>(plan.frames.size());
  if (words.empty()) return {1, frames};
  if (const std::size_t dash = words.find('-'); dash != std::string::npos) {
    const auto number = [](const std::string& word) { return parse_integer("--frame-range", word, {1, 1e9}); };
    return {number(words.substr(0, dash)), number(words.substr(dash + 1))};
  }
  if (words.find('/') == std::string::npos)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("--frame-range: is '{}', expected frames as 1-48, or a part as 2/4", words));
  const Part part = parse_part("--frame-range", words);
  return frames_of_part(plan, part.number, part.of);
}

Report run_draw(const std::string& folder, const std::string& words, const Session& session) {
  const FilmPlan plan = read_film_plan(folder, WHEATSTONE_VERSION);
  const FrameRange range = part_of(plan, words);
  const bool is_any = range.first <= range.last;  // more parts than segments leave some without
  const DrawnPart part = is_any ? draw_film_part(folder, plan, range, session.progress) : DrawnPart();
  const auto drawn = static_cast<double>(std::max<std::int64_t>(part.frames, 1));
  std::string frames = fmt::format("drawn            {} frames", part.frames);
  if (part.drawn_before > 0) frames += fmt::format(", {} were drawn before", part.drawn_before);
  return {{{"plan", folder},
           {"frames", part.frames, frames},
           {"frames_drawn_before", part.drawn_before},
           {"seconds_a_frame", part.seconds / drawn,
            fmt::format("time             {:.2f} s a frame, {:.2f} core-seconds", part.seconds / drawn,
                        part.core_seconds / drawn)},
           {"core_seconds_a_frame", part.core_seconds / drawn},
           {"worst_bare_share", part.worst_bare_share,
            fmt::format("unpainted        at most {:.3f} %", 100 * part.worst_bare_share)}}};
}

/// `output`: empty for the film that the plan names.
Report run_join(const std::string& folder, const std::string& output, const Session& session) {
  FilmPlan plan = read_film_plan(folder, WHEATSTONE_VERSION);
  if (!output.empty()) {
    const bool two_films = !plan.right_film.empty();
    plan.film = two_films ? film_of_eye(output, left_eye) : fs::path(output);
    if (two_films) plan.right_film = film_of_eye(output, right_eye);
  }
  for (const fs::path& film : {plan.film, plan.right_film})
    if (!film.empty()) check_not_an_input(film, std::array{plan.writing.side_streams_from});
  const std::vector<std::string> notes = join_film_parts(folder, plan, session.progress);
  const std::string right = plan.right_film.string();
  Report report{{{"output", plan.film.string()},
                 {"frames", plan.frames.size(), fmt::format("joined           {} frames", plan.frames.size())},
                 {"notes", notes, lines("note             ", notes)}}};
  if (!right.empty()) report.facts.push_back({"right_output", right});
  report.facts.push_back(
      only_text(fmt::format("written to       {}{}{}", plan.film.string(), right.empty() ? "" : " and ", right)));
  return report;
}

}  // namespace

Rows plan_rows(PlanArguments& arguments, const Row& plan_row) {
  return under(
      "Many machines",
      {plan_row,
       row("--draw", flag(arguments.draw),
           "Draw and encode frames of FILM, which is a plan; any number of runs at a time", {}, {}, {"--join"}),
       row("--frame-range", text(arguments.part),
           "What to draw: frames, as 1-48, or a part, as 2/4; all by default. Frames between two "
           "checkpoints are drawn by the range that has the first of them",
           {}, "--draw"),
       row("--join", flag(arguments.join), "Join what was drawn of FILM, which is a plan, to the film")});
}

Rows refused_on_plans(Rows rows, const PlanArguments& arguments) {
  constexpr std::array<std::string_view, 5> of_plans{"FILM", "--plan", "--draw", "--join", "--frame-range"};
  for (Row& one : rows) {
    const std::string option = name_of(one);
    if (std::ranges::find(of_plans, option) != of_plans.end()) continue;
    one.unless.push_back(when([&arguments] { return arguments.draw; }, "with --draw; the plan says it"));
    if (option != "--output")
      one.unless.push_back(when([&arguments] { return arguments.join; }, "with --join; the plan says it"));
  }
  return rows;
}

Report run_plan(const PlanArguments& arguments, const std::string& plan, const std::string& output, const Given& given,
                const Session& session) {
  if (arguments.draw) return run_draw(plan, arguments.part, session);
  return run_join(plan, given("--output") ? output : std::string(), session);
}

}  // namespace wheatstone::cli
