#pragma once

// Small films with two cuts for tests.

#include <cstdint>
#include <filesystem>

#include "scenes/moving_picture.h"
#include "wheatstone/stereo/packed_pair.h"
#include "wheatstone/synthetic/synthetic_film.h"

namespace wheatstone {

/// The frames from `first` to before `end`, which are another scene: cuts are found before both.
struct OtherScene {
  int first = 0, end = 0;
  bool has(int frame) const { return frame >= first && frame < end; }
};

inline void show_other_scene(Image<Rgb8>& picture) {
  for (Rgb8& pixel : picture.pixels())
    pixel = {static_cast<std::uint8_t>(255 - pixel.b), pixel.r, static_cast<std::uint8_t>(255 - pixel.g)};
}

/// A frame of a synthetic film of 96×64 pixels an eye.
inline StereoPair eyes_of_scenes(int frame, OtherScene other) {
  SyntheticFilmOptions options{.still = {.width = 96, .height = 64, .samples_a_side = 1}, .frames = 12};
  options.cut = 0;
  StereoPair eyes = make_synthetic_film_frame(options, frame).pictures;
  if (!other.has(frame)) return eyes;
  show_other_scene(eyes.left);
  show_other_scene(eyes.right);
  return eyes;
}

/// These frames at 25 a second, side by side.
inline void make_film_of_scenes(const std::filesystem::path& path, int frames, OtherScene other) {
  FilmWriter writer(path, {.preset = "ultrafast", .layout = StereoLayout::left_right});
  for (int i = 0; i < frames; ++i) {
    const StereoPair eyes = eyes_of_scenes(i, other);
    writer.write({put_together(eyes.left, eyes.right, StereoLayout::left_right), i, {1, 25}, 1});
  }
  writer.finish();
}

/// A film of one eye, of moving_picture.
inline void make_mono_film_of_scenes(const std::filesystem::path& path, int frames, OtherScene other) {
  FilmWriter writer(path, {.preset = "ultrafast"});
  for (int i = 0; i < frames; ++i) {
    Frame frame = moving_frame(64, 48, i);
    if (other.has(i)) show_other_scene(frame.picture);
    writer.write(frame);
  }
  writer.finish();
}

}  // namespace wheatstone
