#pragma once

// For tests: the views that the command line makes which a viewer tells.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <string>

#include "cli/run.h"
#include "command_line.h"
#include "command_table.h"
#include "temporary_folder.h"
#include "viewer.h"
#include "wheatstone/pictures/read_image.h"

namespace wheatstone::viewer {

/// Runs "wheatstone render … -o views", with the views in a folder. Returns what it prints.
inline std::string run_told(const TemporaryFolder& folder, Words words) {
  words.erase(words.begin());
  for (std::string& word : words)
    if (word == "views") word = folder / "views";
  std::ostringstream output, errors;
  EXPECT_EQ(cli::run_command_line(words, output, errors), 0) << errors.str();
  return output.str();
}

/// Both eyes as the command that a viewer tells makes them.
inline std::array<Image<Rgb8>, 2> views_of_told(const Viewer& viewer, const TemporaryFolder& folder) {
  std::string told = command_line_of(viewer.session());
  std::ranges::replace(told, '\'', '"');  // as a shell quotes, and as a script does
  run_told(folder, words_of(told));
  return {read_image(folder / "views/view_000.png"), read_image(folder / "views/view_001.png")};
}

/// One eye of a frame in the mode left-right.
inline Image<Rgb8> shown_to(const Viewer& viewer, int eye) {
  const Image<Rgb8>& picture = viewer.frame()->picture;
  Image<Rgb8> shown(picture.width() / 2, picture.height());
  for (int y = 0; y < shown.height(); ++y)
    std::ranges::copy(
        picture.row(y).subspan(static_cast<std::size_t>(eye * shown.width()), static_cast<std::size_t>(shown.width())),
        shown.row(y).begin());
  return shown;
}

}  // namespace wheatstone::viewer
