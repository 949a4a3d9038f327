#include "cli/example_inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <stdexcept>

#include "cli/run_program.h"
#include "scenes/checkerboard_picture.h"
#include "scenes/rendered_frames.h"
#include "scenes/stereograph_card.h"
#include "scenes/test_photographs.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/photograph/write_views.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/synthetic/synthetic_film.h"
#include "wheatstone/video/film_writer.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

// Large enough for a checkerboard to be found.
constexpr int photograph_width = 144, photograph_height = 108;

StereoPair photographs() { return still_for_test(photograph_width, photograph_height); }

/// Large enough for the features of a rectification.
StereoPair detailed_photographs() { return still_for_test(192, 144); }

void make_with_program(const Words& words) {
  const ProgramResult result = run_program(words);
  if (result.exit_code != 0) throw std::runtime_error(fmt::format("{} {}: {}", words[0], words[1], result.errors));
}

/// Three frames of two views with their depth, as a renderer gives them.
void make_rendered(const fs::path& folder) {
  fs::create_directory(folder);
  const SyntheticFilmOptions options{
      .still = {.width = 144, .height = 108, .samples_a_side = 1}, .frames = 3, .cut = 0};
  for (int i = 0; i < options.frames; ++i) {
    const SyntheticFilmFrame frame = make_synthetic_film_frame(options, i);
    const auto depth_of = [](Image<float> disparity) {
      for (float& px : disparity.pixels()) px = 50 / std::max(px + 1, 0.1f);
      return disparity;
    };
    write_rendered_frame(folder / fmt::format("render_{:04}.exr", i + 1),
                         {{frame.pictures.left, depth_of(frame.geometry.left_disparity)},
                          {frame.pictures.right, depth_of(frame.geometry.right_disparity)}});
  }
}

/// Pairs of a board of 11×7 inner corners, 30 mm apart, by a rig that could have taken `photographs`.
void make_rig(const fs::path& folder) {
  fs::create_directory(folder);
  CheckerboardView view{.columns = 11,
                        .rows = 7,
                        .square_mm = 30,
                        .width = photograph_width,
                        .height = photograph_height,
                        .focal_px = 151.2,
                        .distance_mm = 600};
  for (std::size_t i = 0; i < checkerboard_tilts.size(); ++i) {
    view.tilt_x = checkerboard_tilts[i][0];
    view.tilt_y = checkerboard_tilts[i][1];
    for (const bool left : {true, false}) {
      view.camera_mm = left ? -30 : 30;
      write_image(folder / fmt::format("{}_{:02}.png", left ? "left" : "right", i + 1), checkerboard_picture(view));
    }
  }
}

/// Four frames for two eyes: at its beginning, and ten seconds later.
void make_film(const fs::path& path) {
  const SyntheticFilmOptions options{.still = {.width = 96, .height = 64, .samples_a_side = 1}, .frames = 4, .cut = 0};
  constexpr std::array<int, 4> seconds{0, 1, 10, 11};
  FilmWriter writer(path, {.preset = "ultrafast", .layout = StereoLayout::left_right, .frame_rate = {1, 1}});
  for (int i = 0; i < options.frames; ++i) {
    const StereoPair eyes = make_synthetic_film_frame(options, i).pictures;
    writer.write({.picture = joined(eyes.left, eyes.right, true),
                  .pts = seconds[static_cast<std::size_t>(i)],
                  .time_base = {1, 1},
                  .duration = 1});
  }
  writer.finish();
}

/// Four frames for one eye, and their depth, as networks give it.
void make_walk(const fs::path& path, bool depth) {
  const SyntheticFilmOptions options{.still = {.width = 96, .height = 64, .samples_a_side = 1}, .frames = 4, .cut = 0};
  FilmWriter writer(path, {.preset = "ultrafast"});
  for (int i = 0; i < options.frames; ++i) {
    const SyntheticFilmFrame frame = make_synthetic_film_frame(options, i);
    Image<Rgb8> picture = frame.pictures.left;
    for (std::size_t k = 0; depth && k < picture.pixels().size(); ++k) {
      const auto level =
          static_cast<std::uint8_t>(std::clamp(20 * frame.geometry.left_disparity.pixels()[k], 0.f, 255.f));
      picture.pixels()[k] = {level, level, level};
    }
    writer.write({.picture = std::move(picture), .pts = i, .time_base = {1, 24}, .duration = 1});
  }
  writer.finish();
}

void make_universe(const fs::path& path) {
  make_with_program({"synth", "universe", "--particles", "2000", "-o", path.string()});
}

/// A tetrahedron. Models are told by their content: this one is an OBJ file under any name.
void make_model(const fs::path& path) {
  write_whole_file(path, "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
}

void make_multi_picture(const fs::path& path) {
  const StereoPair pair = detailed_photographs();
  write_mpo(path, std::array<ImageView<const Rgb8>, 2>{pair.left, pair.right});
}

/// Beside one of the size that others have, it need not be as large.
void make_small_multi_picture(const fs::path& path) {
  const StereoPair pair = still_for_test(photograph_width / 2, photograph_height / 2);
  write_mpo(path, std::array<ImageView<const Rgb8>, 2>{pair.left, pair.right});
}

/// The scene of `photographs`, with its exact disparity.
void make_still(const fs::path& folder) {
  make_with_program({"synth", "still", "--size", fmt::format("{}x{}", photograph_width, photograph_height), "--samples",
                     "1", "-o", folder});
}

/// The left picture of `photographs`, and its depth as networks give it: nearer is brighter.
void make_depth(const fs::path& path) {
  const Image<float> disparity =
      make_synthetic_view({.width = photograph_width, .height = photograph_height, .samples_a_side = 1}, left_eye)
          .disparity;
  write_disparity(path, disparity);
}

void make_painting(const fs::path& path) {
  const fs::path folder = path.parent_path() / "made for its painting";
  make_with_program({"paint", example_input("left.png"), example_input("right.png"), "-o", folder});
  fs::rename(folder / "painting.wst", path);
}

using Maker = std::function<void(const fs::path&)>;
const std::map<std::string, Maker>& makers() {
  const static Maker left = [](const fs::path& path) { write_image(path, photographs().left); };
  const static Maker right = [](const fs::path& path) { write_image(path, photographs().right); };
  const static Maker side_by_side = [](const fs::path& path) {
    write_image(path, joined(photographs().left, photographs().right, true));
  };
  const static std::map<std::string, Maker> all{
      {"left.png", left},
      {"left.jpg", [](const fs::path& path) { write_image(path, detailed_photographs().left); }},
      {"right.png", right},
      {"right.jpg", [](const fs::path& path) { write_image(path, detailed_photographs().right); }},
      {"photograph.mpo", make_multi_picture},
      {"card.png", [](const fs::path& path) { write_image(path, make_card(photographs(), {.width = 600}).picture); }},
      {"glasses.png",
       [](const fs::path& path) {
         make_with_program(
             {"pack", example_input("left.png"), example_input("right.png"), "--to", "colour", "-o", path});
       }},
      {"one.mpo", make_multi_picture},
      {"two.mpo", make_small_multi_picture},
      {"three.mpo", make_small_multi_picture},
      {"photograph.jpg", side_by_side},
      {"key_sbs.png", side_by_side},
      {"photo.jpg", left},
      {"depth.png", make_depth},
      {"still", make_still},
      {"photographs",
       [](const fs::path& path) {
         fs::create_directory(path);
         write_image(path / "tree_L.png", detailed_photographs().left);
         write_image(path / "tree_R.png", detailed_photographs().right);
         make_multi_picture(path / "house.mpo");
         make_multi_picture(path / "garden.mpo");
       }},
      {"painted",
       [](const fs::path& path) {
         make_with_program({"paint", example_input("left.png"), example_input("right.png"), "-o", path});
       }},
      {"painting.wst", make_painting},
      {"path.toml",
       [](const fs::path& path) { put_bytes(path, "[[key]]\nat = 0\nazimuth = 30\n[[key]]\nat = 1\nazimuth = 60\n"); }},
      {"tour.txt", [](const fs::path& path) { put_bytes(path, "wait\nmode right\nwait\n"); }},
      // A script waits for what plays, for ten seconds.
      {"stop.txt", [](const fs::path& path) { put_bytes(path, "wait 0.4\npause\nmode right\nwait 1\npause\nwait\n"); }},
      {"rig", make_rig},
      {"film.mp4", make_film},
      {"rendered", make_rendered},
      {"painted.mp4", make_film},
      {"walk.mp4", [](const fs::path& path) { make_walk(path, false); }},
      {"depth.mp4", [](const fs::path& path) { make_walk(path, true); }},
      {"matte.mp4", [](const fs::path& path) { make_walk(path, true); }},
      {"model.glb", make_model},
      {"universe.hdf5", make_universe},
      {"gas.hdf5", make_universe},
      {"snapshot.hdf5", make_universe},
      {"slices.exr",
       [](const fs::path& path) {
         make_with_program({"render", example_input("gas.hdf5"), "--size", "32x24", "--save-slices", path, "-o",
                            path.parent_path() / "views of its slices"});
       }},
      {"views",
       [](const fs::path& path) {
         make_with_program({"render", example_input("gas.hdf5"), "--views", "48", "--size", "32x24", "-o", path});
       }},
  };
  return all;
}

}  // namespace

fs::path example_input(const std::string& name) {
  static const TemporaryFolder folder;
  const auto maker = makers().find(name);
  if (maker == makers().end()) return {};
  fs::path path = folder / name;
  if (!fs::exists(path)) maker->second(path);
  return path;
}

}  // namespace wheatstone
