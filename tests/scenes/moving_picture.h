#pragma once

// Films for tests: made by formula, written by our own writer; and the ffmpeg program, where it is installed.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "temporary_folder.h"
#include "wheatstone/video/film_reader.h"
#include "wheatstone/video/film_writer.h"

namespace wheatstone {

/// Coloured hills that wander with the frames; moderate detail, every frame differs from every other.
inline Image<Rgb8> moving_picture(int width, int height, int frame, double shift = 0) {
  Image<Rgb8> picture(width, height);
  const auto level = [](double value) { return static_cast<std::uint8_t>(128.5 + 100 * value); };
  // By the sines of sums, only columns and rows need sines.
  struct Wave {
    explicit Wave(double angle) : sine(std::sin(angle)), cosine(std::cos(angle)) {}
    double sine, cosine;
  };
  struct Column {
    double red;
    Wave green, blue;
  };
  std::vector<Column> columns;
  for (int x = 0; x < width; ++x) {
    const double u = x + shift + 1.7 * frame;
    columns.push_back({std::sin(u * 0.11), Wave(u * 0.05), Wave(frame * 0.2 - u * 0.03)});
  }
  for (int y = 0; y < height; ++y) {
    const double v = y + 0.6 * frame, red = std::cos(v * 0.07);
    const Wave green(v * 0.09), blue(v * 0.13);
    for (int x = 0; x < width; ++x) {
      const Column& column = columns[static_cast<std::size_t>(x)];
      picture(x, y) = {level(column.red * red),
                       level(column.green.sine * green.cosine + column.green.cosine * green.sine),
                       level(column.blue.cosine * blue.cosine - column.blue.sine * blue.sine)};
    }
  }
  return picture;
}

inline Frame moving_frame(int width, int height, int number, Rational time_base = {1, 25}) {
  return {moving_picture(width, height, number), number, time_base, 1};
}

/// Writes `count` frames of moving_picture at 25 a second.
inline void make_film(const std::filesystem::path& path, int count, const FilmWriterOptions& options = {},
                      int width = 64, int height = 48) {
  FilmWriter writer(path, options);
  for (int i = 0; i < count; ++i) writer.write(moving_frame(width, height, i));
  writer.finish();
}

inline std::vector<Frame> frames_of(FilmReader reader) {
  std::vector<Frame> frames;
  for (Frame frame; reader.read(frame);) frames.push_back(frame);
  return frames;
}

inline std::vector<Frame> frames_of(const std::filesystem::path& path, const FilmReaderOptions& options = {}) {
  return frames_of(open_film(path, options));
}

inline std::vector<std::int64_t> pts_of(const std::vector<Frame>& frames) {
  std::vector<std::int64_t> pts;
  for (const Frame& frame : frames) pts.push_back(frame.pts);
  return pts;
}

inline bool has_program(const std::string& name) {
  return std::system(("command -v " + name + " >/dev/null").c_str()) == 0;  // NOLINT(bugprone-command-processor)
}

/// Runs the ffmpeg program quietly; `arguments` as in a shell.
inline void ffmpeg(const std::string& arguments) {
  const std::string command = "ffmpeg -nostdin -v error -y " + arguments;
  ASSERT_EQ(std::system(command.c_str()), 0) << command;  // NOLINT(bugprone-command-processor)
}

/// Makes a second of MPEG-TS whose tables declare AAC but whose sound is empty: no one can say its rate and channels.
inline void make_film_with_undescribed_sound(const std::filesystem::path& path) {
  ffmpeg("-f lavfi -i testsrc=d=1:s=64x48 -f lavfi -i sine=d=1 -c:v libx264 -preset ultrafast -c:a aac -f mpegts " +
         path.string());
  std::string bytes = bytes_of(path);
  constexpr std::size_t packet_bytes = 188, sound_id = 257;
  const auto at = [&](std::size_t place) { return static_cast<std::size_t>(static_cast<unsigned char>(bytes[place])); };
  for (std::size_t packet = 0; packet + packet_bytes <= bytes.size(); packet += packet_bytes) {
    if (((at(packet + 1) & 31) << 8 | at(packet + 2)) != sound_id) continue;
    std::size_t begin = packet + 4;
    if ((at(packet + 3) & 0x20) != 0) begin += 1 + at(begin);
    if ((at(packet + 1) & 0x40) != 0) begin += 9 + at(begin + 8);
    for (std::size_t i = begin; i < packet + packet_bytes; ++i) bytes[i] = 0;
  }
  put_bytes(path, bytes);
}

/// What ffprobe prints.
inline std::string ffprobe(const std::string& arguments, const TemporaryFolder& folder) {
  const std::string command = "ffprobe -v error " + arguments + " >" + (folder / "probe.txt").string();
  EXPECT_EQ(std::system(command.c_str()), 0) << command;  // NOLINT(bugprone-command-processor)
  return bytes_of(folder / "probe.txt");
}

}  // namespace wheatstone
