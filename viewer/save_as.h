#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "content.h"
#include "session.h"

namespace wheatstone::viewer {

/// A format in which what is seen is saved: one of `wheatstone pack --to`, or "picture", the picture of the window.
struct SaveFormat {
  std::string_view name;
  std::string text;         ///< for people
  std::string_view ending;  ///< that is proposed
};

/// Those that a dialog lists. A command takes all of `pack` that need no more than the views.
std::span<const SaveFormat> save_formats();

/// A name for a file of that format: that of what is open, with what the format's readers look for in it, and never
/// that of an open file.
std::string proposed_name_as(const Session& session, std::string_view format);

/// What is to be saved, as it is seen when the command is given.
struct SeenToSave {
  Content content;
  ViewState state;
  PictureSize eye;  ///< size of views of what has none of its own
  Item files;       ///< that are open, and are not written over
};

/// Its views from left to right, of the content's own size: `count` of them, with what lies on the screen plane in the
/// same place in all. Of a mode with a display's views, these. Throws Error{wrong_usage} where there is one view only.
std::vector<Image<Rgb8>> views_to_save(const SeenToSave& seen, int count, bool of_display);

/// Writes them as `wheatstone pack --to FORMAT` does and returns the name of what was written. `framing`: how they are
/// cropped and framed, as that takes it: "crop=4:3", "border=3%,black", "caption={title}", "floating-window=auto".
/// Throws as that, and as views_to_save.
std::string save_as(const SeenToSave& given, const std::string& format, const std::filesystem::path& path,
                    std::span<const std::string> framing = {});

}  // namespace wheatstone::viewer
