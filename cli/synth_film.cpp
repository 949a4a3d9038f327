#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "commands.h"
#include "wheatstone/app/output_folder.h"
#include "wheatstone/motion/flow_file.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/synthetic/synthetic_film.h"

namespace wheatstone::cli {
namespace {

struct SynthFilmArguments {
  std::string folder = "film";
  PictureSize size{640, 360};
  SyntheticFilmOptions film;
};

constexpr std::array<Choice<FilmScene>, 4> scenes{{{"still-life", FilmScene::still_life},
                                                   {"beams", FilmScene::beams},
                                                   {"still", FilmScene::still},
                                                   {"crowd", FilmScene::crowd}}};
constexpr std::array<Choice<FilmMotion>, 2> motions{{{"walk", FilmMotion::walk}, {"pan", FilmMotion::pan}}};

std::string_view name_of(FilmScene scene) { return std::ranges::find(scenes, scene, &Choice<FilmScene>::value)->name; }

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

Report run_synth_film(const SynthFilmArguments& arguments, const Session& session) {
  SyntheticFilmOptions options = arguments.film;
  options.still.seed = session.seed;
  options.still.width = arguments.size.width;
  options.still.height = arguments.size.height;
  const int cut = cut_of(options);

  OutputFolder output(arguments.folder);
  for (int frame = 0; frame < options.frames; ++frame) {
    report(session.progress, "frames", static_cast<double>(frame) / options.frames);
    write(output, frame, make_synthetic_film_frame(options, frame));
  }
  output.commit();
  return {{{"folder", arguments.folder, fmt::format("written to {}", arguments.folder)},
           {"scene", name_of(options.scene)},
           {"frames", options.frames},
           {"cut", cut},
           {"width", options.still.width},
           {"height", options.still.height},
           {"seed", options.still.seed}}};
}

Rows synth_film_rows(SynthFilmArguments& a) {
  SyntheticFilmOptions& film = a.film;
  const Reason no_still_life = [&film] {
    return film.scene == FilmScene::still_life
               ? ""
               : fmt::format("on the scene '{}'; it is the motion of the still life", name_of(film.scene));
  };
  return {
      row("-o,--output", output_name(a.folder), "Folder for the results"),
      row("--size", size(a.size, {16, 32768}), "Size of each view: WIDTHxHEIGHT"),
      row("--frames", number(film.frames, {1, 100'000}), "Number of frames"),
      row("--cut", number(film.cut, {0, 100'000}),
          "First frame of the second scene; 0 for a film without a cut. By default, the film of the still life is cut "
          "in the\nmiddle, and the others are not"),
      row("--scene", choice(film.scene, scenes),
          "still-life: fruit and pottery on a table; beams: the camera passes thin bars fast, with motion "
          "blur;\nstill: nothing moves; crowd: many small figures cross in both directions"),
      row("--motion", choice(film.motion, motions),
          "Motion of the still life. walk: the camera moves and turns, and fruit bounces; pan: the camera only\nturns, "
          "slowly",
          {no_still_life}),
      row("--noise", number(film.noise, {0, 255}),
          "Standard deviation of the noise of each frame, in 0..255; 3 by default where nothing moves, otherwise 0"),
      row("--samples", number(film.still.samples_a_side, {1, 8}), "Samples along each side of a pixel")};
}

}  // namespace

Command synth_film_command() {
  return make_command(
      "film", "Ray-cast stereo film with exact flow and disparity", synth_film_rows, run_synth_film,
      R"(Frames count from 0. For each frame, the folder contains left_0000.png, left_disparity_0000.pfm and
left_occlusion_0000.png, and the same for the right eye. For the left eye it also contains the optical flow to the
next frame, flow_forward_0000.flo, and to the previous frame, flow_backward_0000.flo, with their occlusion masks.
All are exact, without the noise.

Example:
  wheatstone synth film -o film --cut 25
  wheatstone synth film -o pan --motion pan --cut 0 --noise 4
  wheatstone synth film -o beams --scene beams --frames 24 --size 320x180)");
}

}  // namespace wheatstone::cli
