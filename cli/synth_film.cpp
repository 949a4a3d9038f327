#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "command.h"
#include "number_arguments.h"
#include "option_use.h"
#include "output_option.h"
#include "print_facts.h"
#include "synth_kinds.h"
#include "typed_options.h"
#include "wheatstone/app/output_folder.h"
#include "wheatstone/motion/flow_file.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/synthetic/synthetic_film.h"

namespace wheatstone::cli {
namespace {

struct SynthFilmArguments {
  std::string folder = "film";
  std::string size = "640x360";
  SyntheticFilmOptions film;
};

constexpr std::array scenes{std::pair{std::string_view("still-life"), FilmScene::still_life},
                            std::pair{std::string_view("beams"), FilmScene::beams},
                            std::pair{std::string_view("still"), FilmScene::still},
                            std::pair{std::string_view("crowd"), FilmScene::crowd}};

std::string_view name_of(FilmScene scene) {
  return std::ranges::find(scenes, scene, &decltype(scenes)::value_type::second)->first;
}

void write(const OutputFolder& output, int number, const SyntheticFilmFrame& frame) {
  const auto file = [&](const char* name, const char* ending) {
    return output.file(fmt::format("{}_{:04}{}", name, number, ending));
  };
  write_image(file("left", ".png"), frame.pictures.left);
  write_image(file("right", ".png"), frame.pictures.right);
  write_disparity(file("left_disparity", ".pfm"), frame.geometry.left_disparity);
  write_disparity(file("right_disparity", ".pfm"), frame.geometry.right_disparity);
  write_image(file("left_occlusion", ".png"), frame.geometry.left_occlusion);
  write_image(file("right_occlusion", ".png"), frame.geometry.right_occlusion);
  write_flow(file("flow_forward", ".flo"), frame.to_next);
  write_flow(file("flow_backward", ".flo"), frame.to_previous);
  write_image(file("flow_forward_occlusion", ".png"), frame.next_occlusion);
  write_image(file("flow_backward_occlusion", ".png"), frame.previous_occlusion);
}

void run_synth_film(const CLI::App& command, const SynthFilmArguments& arguments, const Session& session) {
  SyntheticFilmOptions options = arguments.film;
  options.still.seed = session.seed;
  const Size size = parse_size("--size", arguments.size, {16, 32768});
  options.still.width = size.width;
  options.still.height = size.height;
  if (options.scene != FilmScene::still_life)
    refuse_options(command, {"--motion"}, fmt::format("on the scene '{}'", name_of(options.scene)),
                   "it is the motion of the still life");
  const int cut = cut_of(options);

  OutputFolder output(arguments.folder);
  for (int frame = 0; frame < options.frames; ++frame) {
    report(session.progress, "frames", static_cast<double>(frame) / options.frames);
    write(output, frame, make_synthetic_film_frame(options, frame));
  }
  output.commit();
  if (session.json) {
    const nlohmann::ordered_json facts{
        {"folder", arguments.folder},   {"scene", name_of(options.scene)}, {"frames", options.frames},  {"cut", cut},
        {"width", options.still.width}, {"height", options.still.height},  {"seed", options.still.seed}};
    print_facts(facts, session);
  } else {
    fmt::print(session.output, "written to {}\n", arguments.folder);
  }
}

}  // namespace

void add_synth_film(CLI::App& synth, const Session& session) {
  auto arguments = std::make_shared<SynthFilmArguments>();
  SyntheticFilmOptions& film = arguments->film;
  CLI::App& command = *synth.add_subcommand("film", "Ray-cast stereo film with exact flow and disparity");
  command.fallthrough();
  add_output_option(command, arguments->folder, "Folder for the results");
  command.add_option("--size", arguments->size, "Size of each view: WIDTHxHEIGHT")->capture_default_str();
  add_number(command, "--frames", film.frames, {1, 100'000}, "Number of frames");
  add_number(
      command, "--cut", film.cut, {0, 100'000},
      "First frame of the second scene; 0 for a film without a cut. By default, the film of the still life is cut "
      "in the\nmiddle, and the others are not");
  add_choice<FilmScene>(
      command, "--scene", film.scene, scenes,
      "still-life: fruit and pottery on a table; beams: the camera passes thin bars fast, with motion "
      "blur;\nstill: nothing moves; crowd: many small figures cross in both directions");
  static constexpr std::array motions{std::pair{std::string_view("walk"), FilmMotion::walk},
                                      std::pair{std::string_view("pan"), FilmMotion::pan}};
  add_choice<FilmMotion>(
      command, "--motion", film.motion, motions,
      "Motion of the still life. walk: the camera moves and turns, and fruit bounces; pan: the camera "
      "only\nturns, slowly");
  add_number(command, "--noise", film.noise, {0, 255},
             "Standard deviation of the noise of each frame, in 0..255; 3 by default where nothing moves, otherwise 0");
  add_number(command, "--samples", film.still.samples_a_side, {1, 8}, "Samples along each side of a pixel");
  command.footer(
      "Frames count from 0. For each frame, the folder contains left_0000.png, left_disparity_0000.pfm and\n"
      "left_occlusion_0000.png, and the same for the right eye. For the left eye it also contains the optical flow to "
      "the\n"
      "next frame, flow_forward_0000.flo, and to the previous frame, flow_backward_0000.flo, with their occlusion "
      "masks.\n"
      "All are exact, without the noise.\n\n"
      "Example:\n  wheatstone synth film -o film --cut 25\n"
      "  wheatstone synth film -o pan --motion pan --cut 0 --noise 4\n"
      "  wheatstone synth film -o beams --scene beams --frames 24 --size 320x180");
  command.callback([&command, arguments, &session] { run_synth_film(command, *arguments, session); });
}

}  // namespace wheatstone::cli
