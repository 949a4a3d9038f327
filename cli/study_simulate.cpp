#include <fmt/format.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "commands.h"
#include "wheatstone/app/output_folder.h"
#include "wheatstone/error.h"
#include "wheatstone/study/published.h"
#include "wheatstone/study/simulate.h"
#include "wheatstone/study/study_folder.h"

namespace wheatstone::cli {
namespace {

struct StudySimulateArguments {
  std::string design;
  std::optional<int> subjects;
  int studies = 0;
  std::vector<std::string> effects;
  bool published = false;
  SimulatedObservers observers;
  std::string folder = "simulated";
};

/// "depth_cm=10:-1.24" or "depth_cm=10:-1.24:0.04".
SimulatedEffect parse_effect(const std::string& text) {
  const std::size_t equals = text.find('='), colon = text.find(':', equals);
  if (equals == std::string::npos || colon == std::string::npos)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("--effect: is '{}', expected FACTOR=LEVEL:SECONDS or FACTOR=LEVEL:SECONDS:SHARE", text));
  const std::size_t second = text.find(':', colon + 1);
  SimulatedEffect effect{text.substr(0, equals), text.substr(equals + 1, colon - equals - 1)};
  effect.seconds = parse_number(
      "--effect", text.substr(colon + 1, second == std::string::npos ? second : second - colon - 1), {-1000, 1000});
  if (second != std::string::npos) effect.share = parse_number("--effect", text.substr(second + 1), {-10, 10});
  return effect;
}

/// How often that many studies find each effect; nothing is written.
Report report_power(const StudyDesign& design, const StudySimulateArguments& arguments, int subjects,
                    const Session& session) {
  const std::vector<SimulatedPower> power = simulated_power(
      design, arguments.observers, {.subjects = subjects, .studies = arguments.studies, .seed = session.seed});
  Json effects = Json::array();
  std::vector<std::string> texts;
  for (const SimulatedPower& one : power) {
    effects.push_back({{"measure", one.measure}, {"effect", one.effect}, {"share", one.share}});
    texts.push_back(fmt::format("{} on {}: {:.3f}", one.effect, one.measure, one.share));
  }
  return {{{"simulated", true},
           {"subjects", subjects},
           {"studies", arguments.studies,
            fmt::format("{} simulated studies of {} subjects; share that finds an effect at the 5 % level:",
                        arguments.studies, subjects)},
           {"found", effects, lines("  ", texts)}}};
}

/// How observers answer, in words: what is the same of data that may lie in one folder.
std::string simulation_text(const StudySimulateArguments& arguments, int subjects, std::uint64_t seed) {
  const SimulatedObservers& observers = arguments.observers;
  std::string text = fmt::format("{} subjects, seed {}, time {}, noise {}, between {}, correct {}, lapses {}", subjects,
                                 seed, observers.response_time_s, observers.noise_s, observers.between_subjects_s,
                                 observers.correct, observers.lapses);
  for (const std::string& effect : arguments.effects) text += fmt::format(", effect {}", effect);
  if (arguments.published) text += ", as published";
  return text;
}

Report write_data(const StudyDesign& design, const StudySimulateArguments& arguments, int subjects,
                  const Session& session) {
  const std::string simulation = simulation_text(arguments, subjects, session.seed);
  check_study_folder(arguments.folder, design, true, simulation);
  OutputFolder output(arguments.folder);
  const StudyFolder folder(output.folder(), design, true, simulation);
  for (int subject = 0; subject < subjects; ++subject) {
    report(session.progress, "simulating", static_cast<double>(subject) / subjects);
    write_subject(folder, simulate_subject(design, arguments.observers, subject, session.seed));
  }
  output.commit();
  return {{{"simulated", true},
           {"folder", arguments.folder, fmt::format("{} simulated subjects written to {}", subjects, arguments.folder)},
           {"subjects", subjects},
           {"seed", session.seed}}};
}

Report run_study_simulate(const StudySimulateArguments& given, const Session& session) {
  StudySimulateArguments arguments = given;
  const StudyDesign design = load_study_design(arguments.design);
  for (const std::string& effect : arguments.effects) arguments.observers.effects.push_back(parse_effect(effect));
  check_effects(design, arguments.observers);
  if (arguments.published) arguments.observers = observers_as_published(design, arguments.observers);
  const int subjects = arguments.subjects.value_or(design.subjects);
  return arguments.studies > 0 ? report_power(design, arguments, subjects, session)
                               : write_data(design, arguments, subjects, session);
}

Rows simulate_rows(StudySimulateArguments& a) {
  SimulatedObservers& observers = a.observers;
  return {
      row("design", required(of_type("NAME|FILE.toml", text(a.design))), "Design, as for study design"),
      row("-o,--output", output_name(a.folder), "Folder of the data, marked as simulated"),
      row("--subjects", number(a.subjects, {1, 10'000}), "Number of subjects; the design's if not given"),
      row("--studies", number(a.studies, {0, 1'000'000}),
          "Simulate that many studies, write none of them, and tell how often each effect is found", {}, {},
          {"--output"}),
      row("--effect", of_type("EFFECT", texts(a.effects)),
          "FACTOR=LEVEL:SECONDS[:SHARE]: what a level adds to response times, and to the probability of a right answer "
          "or to ratings; may be given several times"),
      row("--published", flag(a.published),
          "Observers whose answers have the means that were published of this design, and its deviations of ratings",
          {}, {}, {"--effect", "--time", "--correct", "--lapses"}),
      row("--time", number(observers.response_time_s, {0.5, 1000}), "Mean response time in seconds"),
      row("--noise", number(observers.noise_s, {0, 1000}), "Standard deviation of a subject's response times"),
      row("--between", number(observers.between_subjects_s, {0, 1000}), "Standard deviation of subjects' mean times"),
      row("--correct", number(observers.correct, {0, 1}), "Probability of a right answer"),
      row("--lapses", number(observers.lapses, {0, 1}), "Share of trials answered by chance")};
}

}  // namespace

Command study_simulate_command() {
  return make_command("simulate", "Let simulated observers answer: to try an analysis, or how many subjects are needed",
                      simulate_rows, run_study_simulate,
                      R"(Examples:
  wheatstone study simulate path-searching-1 --effect depth_cm=10:-1.24:0.04 -o data
  wheatstone study simulate painting-comfort --published -o rehearsal
  wheatstone study simulate path-searching-2 --subjects 15 --effect views_per_10cm=8:-3 --studies 200)");
}

}  // namespace wheatstone::cli
