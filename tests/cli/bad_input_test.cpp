// Bad input gets one clear line and exit code 3, and leaves no output. A command that reads pictures adds its lines to
// `readers`.

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <thread>

#include "cli/run_program.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::bad_input_test {

/// The lines that make a command read this file; "good.png" is a picture without fault.
std::vector<std::vector<std::string>> readers(const std::string& file) {
  return {{"info", file},
          {"match", file, "good.png", "-o", "results"},
          {"match", "good.png", file, "-o", "results"},
          {"rectify", file, "good.png", "-o", "results"},
          {"rectify", "good.png", file, "-o", "results"},
          {"match", file, "-o", "results"},
          {"paint", file, "-o", "results"},
          {"paint", file, "good.png", "-o", "results"},
          {"paint", "good.png", file, "-o", "results"},
          {"paint", "good.png", "good.png", "--disparity", file, "-o", "results"}};
}

Image<Rgb8> ramp() {
  Image<Rgb8> image(64, 48);
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) image(x, y) = {static_cast<std::uint8_t>(4 * x), static_cast<std::uint8_t>(5 * y), 9};
  }
  return image;
}

void expect_every_reader_refuses(const TemporaryFolder& folder, const std::string& file) {
  write_image(folder / "good.png", ramp());
  for (const std::vector<std::string>& line : readers(file)) expect_refused(folder, line, 3, file + ": ");
}

TEST(BadInput, MissingFileIsRefused) { expect_every_reader_refuses(TemporaryFolder(), "missing.png"); }

TEST(BadInput, TruncatedPictureIsRefused) {
  const TemporaryFolder folder;
  for (const std::string name : {"cut.png", "cut.jpg"}) {
    write_image(folder / name, ramp());
    const std::string bytes = bytes_of(folder / name);
    put_bytes(folder / name, bytes.substr(0, bytes.size() * 2 / 3));
    expect_every_reader_refuses(folder, name);
  }
}

TEST(BadInput, WhatIsNoPictureIsRefused) {
  const TemporaryFolder folder;
  put_bytes(folder / "letter.png", "Dear Sir, this is a letter.\n");
  put_bytes(folder / "empty.png", "");
  std::filesystem::create_directory(folder / "folder.png");
  for (const std::string name : {"letter.png", "empty.png", "folder.png"}) expect_every_reader_refuses(folder, name);
}

TEST(BadInput, EyesOfDifferentSizesAreRefused) {
  const TemporaryFolder folder;
  write_image(folder / "good.png", ramp());
  write_image(folder / "small.png", Image<Rgb8>(32, 24));
  for (const std::string command : {"match", "paint", "rectify"}) {
    expect_refused(folder, {command, "good.png", "small.png", "-o", "results"}, 3, "small.png");
  }
}

TEST(BadInput, TinyPicturesAreRefused) {
  const TemporaryFolder folder;
  write_image(folder / "1x1.png", Image<Rgb8>(1, 1));
  write_image(folder / "3x2.png", Image<Rgb8>(3, 2));
  for (const std::string command : {"match", "paint", "rectify"}) {
    for (const std::string name : {"1x1.png", "3x2.png"}) {
      expect_refused(folder, {command, name, name, "-o", "results", "--quiet"}, 3, name.substr(0, 3));
    }
  }
}

TEST(BadInput, WhatHasNoEndIsNotRead) {
  const TemporaryFolder folder;
  write_image(folder / "good.png", ramp());
  std::vector<std::vector<std::string>> lines = readers("/dev/zero");
  for (const std::vector<std::string>& line : std::vector<std::vector<std::string>>{
           {"render", "/dev/zero", "-o", "results"},
           {"share", "/dev/zero", "-o", "page.html"},
           {"pack", "good.png", "/dev/zero", "-o", "packed"},
           {"rotoscope", "/dev/zero", "-o", "film.mp4"},
           {"calibrate", "--left", "/dev/zero", "--right", "good.png", "-o", "rig.yml"},
           {"paint", "good.png", "good.png", "--style", "/dev/zero", "-o", "results"},
           {"paint", "good.png", "--depth", "/dev/zero", "-o", "results"},
           {"measure", "views", "/dev/zero", "--against", "good.png"}})
    lines.push_back(line);
  for (const std::vector<std::string>& line : lines) expect_refused(folder, line, 3, "/dev/zero: is a device");
  expect_refused(folder, {"--config", "/dev/zero", "info", "good.png"}, 3, "/dev/zero: is a device");
}

TEST(BadInput, OfAPipeWithoutAPictureIsRefused) {
  const TemporaryFolder folder;
  write_image(folder / "good.png", ramp());
  ASSERT_EQ(::mkfifo((folder / "pipe.png").c_str(), 0600), 0);
  std::thread writer([&] { std::ofstream(folder / "pipe.png") << "Dear Sir"; });
  expect_refused(folder, {"match", "good.png", "pipe.png", "-o", "results"}, 3, "pipe.png: ");
  writer.join();
}

TEST(BadInput, OfANameThatBreaksLinesIsToldInOne) {
  const TemporaryFolder folder;
  expect_refused(folder, {"info", "a\nb\x1b[2J\r\xff.png"}, 3, "a b [2J \xff.png: no such file");
}

TEST(BadInput, DamagedPaintingIsRefused) {
  const TemporaryFolder folder;
  put_bytes(folder / "letter.wst", "Dear Sir, this is a letter, not a painting.\n");
  put_bytes(folder / "empty.wst", "");
  for (const std::string name : {"letter.wst", "empty.wst", "missing.wst"}) {
    expect_refused(folder, {"info", name}, 3, name + ": ");
  }
}

}  // namespace wheatstone::bad_input_test
