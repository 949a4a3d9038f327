#include "study_run_arguments.h"

namespace wheatstone::cli {

Rows study_run_rows(StudyRunArguments& a) {
  return {row("design", required(of_type("NAME|FILE.toml", text(a.design))), "Design, as for study design"),
          row("-o,--output", output_name(a.folder), "Folder of the data"),
          row("--subject", number(a.subject, {1, 100'000}), "Number of the subject, from 1 on"),
          row("--mode", text(a.mode), "Output mode, as --to of 'wheatstone pack'"),
          row("--screen-width", without_default(length(a.screen_width_mm, {50, 10'000})),
              "Width of the screen's picture; as the screen tells if not given"),
          row("--card", of_type("PIXELS", without_default(number(a.card_px, {10, 10'000}))),
              "Width of a bank card (85.6 mm) held to the screen, in pixels, instead of --screen-width", {}, {},
              {"--screen-width"}),
          row("--distance", length(a.distance_mm, {100, 10'000}), "Viewing distance"),
          row("--eye-separation", length(a.eye_separation_mm, {40, 90}), "Separation of the eyes"),
          row("--tracker", number(a.tracker_port, {-1, 65'535}),
              "UDP port of a head tracker that speaks OpenTrack's protocol; -1: none"),
          row("--pointer", flag(a.pointer), "The pointer stands for the head; the arrow keys always do"),
          row("--size", text(a.size), "A window of WIDTHxHEIGHT instead of the full screen, to try a study"),
          row("--opengl", flag(a.opengl), "Show by OpenGL also where the processor computes it"),
          row("--no-opengl", flag(a.no_opengl), "Show without OpenGL; times are then of painting, not of swaps", {}, {},
              {"--opengl"})};
}

double screen_width_mm(const StudyRunArguments& arguments, int width_px) {
  constexpr double card_width_mm = 85.60;  // ISO/IEC 7810 ID-1
  if (arguments.card_px > 0) return card_width_mm / arguments.card_px * width_px;
  return arguments.screen_width_mm;
}

}  // namespace wheatstone::cli
