#include "study_run_arguments.h"

#include <fmt/format.h>

#include "output_option.h"
#include "typed_options.h"

namespace wheatstone::cli {
namespace {

constexpr double card_width_mm = 85.60;  // ISO/IEC 7810 ID-1

}  // namespace

void add_study_run_options(CLI::App& command, StudyRunArguments& arguments) {
  command.add_option("design", arguments.design, "Design, as for study design")
      ->required()
      ->type_name("NAME|FILE.toml");
  add_output_option(command, arguments.folder, "Folder of the data");
  add_number(command, "--subject", arguments.subject, {1, 100'000}, "Number of the subject, from 1 on");
  command.add_option("--mode", arguments.mode, "Output mode, as --to of 'wheatstone pack'")->capture_default_str();
  auto* const width = command.add_option_function<std::string>(
      "--screen-width",
      [&arguments](const std::string& text) {
        arguments.screen_width_mm = parse_length_mm("--screen-width", text, {50, 10'000});
      },
      "Width of the screen's picture; as the screen tells if not given");
  width->type_name("LENGTH");
  command
      .add_option_function<double>(
          "--card", [&arguments](double pixels) { arguments.card_px = pixels; },
          "Width of a bank card (85.6 mm) held to the screen, in pixels, instead of --screen-width")
      ->check(CLI::Range(10.0, 10'000.0))
      ->excludes(width)
      ->type_name("PIXELS");
  add_length(command, "--distance", arguments.distance_mm, {100, 10'000}, "Viewing distance");
  add_length(command, "--eye-separation", arguments.eye_separation_mm, {40, 90}, "Separation of the eyes");
  add_number(command, "--tracker", arguments.tracker_port, {-1, 65'535},
             "UDP port of a head tracker that speaks OpenTrack's protocol; -1: none");
  command.add_flag("--pointer", arguments.pointer, "The pointer stands for the head; the arrow keys always do");
  command.add_option("--size", arguments.size, "A window of WIDTHxHEIGHT instead of the full screen, to try a study");
  auto* const opengl =
      command.add_flag("--opengl", arguments.opengl, "Show by OpenGL also where the processor computes it");
  command.add_flag("--no-opengl", arguments.no_opengl, "Show without OpenGL; times are then of painting, not of swaps")
      ->excludes(opengl);
  command.footer(
      "Y and N answer yes and no, digits rate, space goes on, Escape breaks off. A session that was broken off goes "
      "on\n"
      "where it stopped when it is run again.\n\n"
      "Example:\n  wheatstone study run path-searching-1 --subject 1 --screen-width 52cm --distance 70cm -o study");
}

std::vector<std::string> study_run_words(const StudyRunArguments& arguments) {
  std::vector<std::string> words{arguments.design,
                                 "--output",
                                 arguments.folder,
                                 "--subject",
                                 fmt::format("{}", arguments.subject),
                                 "--mode",
                                 arguments.mode,
                                 "--distance",
                                 fmt::format("{}", arguments.distance_mm),
                                 "--eye-separation",
                                 fmt::format("{}", arguments.eye_separation_mm),
                                 "--tracker",
                                 fmt::format("{}", arguments.tracker_port)};
  const auto add = [&words](bool given, std::string_view option, const std::string& value) {
    if (given) words.insert(words.end(), {std::string(option), value});
  };
  add(arguments.screen_width_mm > 0, "--screen-width", fmt::format("{}", arguments.screen_width_mm));
  add(arguments.card_px > 0, "--card", fmt::format("{}", arguments.card_px));
  add(!arguments.size.empty(), "--size", arguments.size);
  if (arguments.pointer) words.emplace_back("--pointer");
  if (arguments.opengl) words.emplace_back("--opengl");
  if (arguments.no_opengl) words.emplace_back("--no-opengl");
  return words;
}

double screen_width_mm(const StudyRunArguments& arguments, int width_px) {
  if (arguments.card_px > 0) return card_width_mm / arguments.card_px * width_px;
  return arguments.screen_width_mm;
}

}  // namespace wheatstone::cli
