#include <fmt/format.h>

#include <system_error>

#include "wheatstone/app/marks_sequence_internal.h"
#include "wheatstone/error.h"
#include "wheatstone/marks/painting_file.h"

namespace wheatstone {

namespace fs = std::filesystem;

namespace {

/// The same pattern in the work folder.
FramePattern hidden(FramePattern pattern, const fs::path& path) {
  pattern.folder = work_folder_of(path);
  return pattern;
}

}  // namespace

fs::path unfinished_marks(const fs::path& path, std::int64_t frame) {
  return hidden(frame_pattern(path).value(), path).file(frame);
}

MarksSequence::MarksSequence(const fs::path& path, std::int64_t kept)
    : pattern_(frame_pattern(path).value()), hidden_(hidden(pattern_, path)), held_(path) {
  held_.keep(kept > 0);
  std::error_code ignored;
  for (const std::int64_t number : numbers_of(hidden_))
    if (number > kept) fs::remove(hidden_.file(number), ignored);
}

void MarksSequence::write(std::int64_t frame, const Painting& marks) { write_painting(hidden_.file(frame), marks); }

void MarksSequence::check(std::int64_t frames) const {
  std::error_code ignored;
  for (std::int64_t frame = 1; frame <= frames; ++frame)
    if (!fs::exists(hidden_.file(frame), ignored))
      throw Error(ErrorKind::bad_input,
                  fmt::format("{}: is missing; delete both folders to start again", hidden_.file(frame).string()));
}

void MarksSequence::give_names(std::int64_t frames) {
  for (std::int64_t frame = 1; frame <= frames; ++frame) {
    std::error_code error;
    fs::rename(hidden_.file(frame), pattern_.file(frame), error);
    if (error)
      throw Error(ErrorKind::cannot_read_write,
                  fmt::format("{}: cannot write: {}", pattern_.file(frame).string(), error.message()));
  }
  held_.remove();
}

}  // namespace wheatstone
