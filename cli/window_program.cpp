#include "window_program.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <utility>

#include "interrupt.h"
#include "wheatstone/error.h"
#include "wheatstone/files/child_process.h"

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

Rows view_rows(ViewArguments& a) {
  return {
      row("FILE", texts(a.files),
          "Paintings (.wst), stereo photographs, films, pictures with depth, quilts, slices (.exr), particles, "
          "models of triangles, a series of snapshots ('snap_%03d.hdf5'), or a folder of photographs; two pictures of "
          "one scene are its left and right view"),
      row("--mode", text(a.mode), "Output mode, as --to of 'wheatstone pack'; the left eye's picture by default"),
      row("--style", text(a.style), "Style of painted photographs: a preset or a style file"),
      row("--display", text(a.display), "Display, which sets the views of a quilt and the comfortable depth"),
      row("--camera", text(a.camera), "Camera path to play, as in 'wheatstone render'"),
      row("--quantity", text(a.quantity),
          "Quantity of particles that is shown, as in 'wheatstone render': column-density, mean:temperature"),
      row("--where", text(a.where), "Condition for the particles that are shown, as in 'wheatstone render'"),
      row("--focus", text(a.focus),
          "Point X,Y of particles or slices around which there is more depth: shares of a view's width and height"),
      row("--focus-radius", number(a.focus_radius, {-no_bound, no_bound}),
          "Radius of the area around that point, as a share of the width", {}, "--focus"),
      row("--focus-gain", number(a.focus_gain, {-no_bound, no_bound}), "Factor on the depth at that point", {},
          "--focus"),
      row("--size", text(a.size), "Size of the window: WIDTHxHEIGHT"),
      row("--full-screen", flag(a.full_screen), "Begin in full screen"),
      row("--opengl", flag(a.opengl), "Show pictures by OpenGL even if the processor emulates it, which is slower"),
      row("--no-opengl", flag(a.no_opengl), "Show pictures without OpenGL", {}, {}, {"--opengl"}),
      row("--stereo", flag(a.stereo),
          "Let the graphics card show both eyes in turn, for --mode page-flip and shutter glasses", {}, {},
          {"--no-opengl"}),
      row("--script", text(a.script), "Run the commands in this file, one per line, and exit"),
      row("--control", text(a.control),
          "Create a Unix socket on which other programs send commands, one per line; each command gets one line as "
          "answer"),
      row("--bridge-calibration", text(a.bridge_calibration),
          "Write the calibration of the attached Looking Glass, as reported by Looking Glass Bridge, to this .json "
          "file, and exit"),
      row("--commands", flag(a.commands), "List all commands with their keys, and exit")};
}

namespace {

namespace fs = std::filesystem;

constexpr auto window_program = "wheatstone-view";
constexpr std::chrono::milliseconds patience{900};  ///< for the window to end, which ends itself sooner

/// The window's program beside this one; else it is looked for where the shell looks.
std::string window_program_path() {
  std::error_code error;
  const fs::path beside = fs::read_symlink("/proc/self/exe", error).parent_path() / window_program;
  return !error && fs::exists(beside, error) ? beside.string() : std::string(window_program);
}

std::unique_ptr<const ChildProcess> start(std::vector<std::string> words) {
  try {
    return std::make_unique<const ChildProcess>(std::move(words));
  } catch (const Error& error) {
    throw Error(error.kind(),
                fmt::format("{}; it is built and installed with the window (WHEATSTONE_VIEWER)", error.what()));
  }
}

}  // namespace

Report run_window_program(std::vector<std::string> words, const Session& session) {
  session.output.flush();
  words.insert(words.begin(), window_program_path());
  throw_if_interrupted();
  const std::unique_ptr<const ChildProcess> window = start(std::move(words));
  on_signal([&window] { window->signal(SIGTERM); }, patience);
  const int status = window->wait();
  on_signal({});
  // The window's program leaves it to this one to say so.
  if (WIFEXITED(status) && WEXITSTATUS(status) == static_cast<int>(ErrorKind::interrupted)) throw_interrupted();
  if (WIFEXITED(status)) return {.facts = {}, .exit_code = WEXITSTATUS(status)};
  throw_if_interrupted();
  const std::string end = fmt::format("{}: ended by signal {}", window_program, WTERMSIG(status));
  constexpr std::array ending_signals{SIGINT, SIGTERM, SIGHUP, SIGKILL};
  if (std::ranges::find(ending_signals, WTERMSIG(status)) == ending_signals.end()) throw std::runtime_error(end);
  throw Error(ErrorKind::interrupted, end);
}

}  // namespace wheatstone::cli
