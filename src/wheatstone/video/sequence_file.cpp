#include "wheatstone/video/sequence_file_internal.h"

#include <fmt/format.h>

#include <array>
#include <system_error>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/pictures/multiview_exr.h"
#include "wheatstone/pictures/picture_file.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/stereo/packed_pair.h"

namespace wheatstone {

namespace fs = std::filesystem;

void check_no_pictures(const fs::path& path, const FramePattern& pattern) {
  const auto existing = numbers_of(pattern);
  if (existing.empty()) return;
  throw Error(ErrorKind::wrong_usage,
              fmt::format("{}: {} exists already, expected no such file, because frames of two runs would be mixed",
                          path.string(), pattern.file(existing.front()).filename().string()));
}

SequenceFile::SequenceFile(FramePattern pattern, fs::path hidden, StereoLayout layout)
    : pattern_(std::move(pattern)), hidden_(pattern_), layout_(layout) {
  hidden_.folder = std::move(hidden);
  std::error_code error;
  fs::create_directory(hidden_.folder, error);
  if (error) {
    throw Error(ErrorKind::cannot_read_write,
                fmt::format("{}: cannot write: {}", hidden_.folder.string(), error.message()));
  }
}

SequenceFile::~SequenceFile() {
  std::error_code ignored;
  fs::remove_all(hidden_.folder, ignored);
}

void SequenceFile::add(const Frame& frame) {
  const fs::path file = hidden_.file(++count_);
  if (ending_of(file) != ".exr") {
    if (frame.deep.empty() || !takes_sixteen_bits(file)) return write_image(file, frame.picture);
    return write_image(file, frame.deep);
  }
  const auto write_exr = [&](const auto& picture) {
    if (!is_packed(layout_)) return write_picture_exr(file, picture);
    auto [left, right] = cut_apart(picture, layout_, file.string());
    write_multiview_exr(file, std::array{std::move(left), std::move(right)});
  };
  if (frame.deep.empty())
    write_exr(frame.picture);
  else
    write_exr(frame.deep);
}

void SequenceFile::finish() {
  for (std::int64_t number = 1; number <= count_; ++number) {
    std::error_code error;
    fs::rename(hidden_.file(number), pattern_.file(number), error);
    if (!error) continue;
    throw Error(ErrorKind::cannot_read_write,
                fmt::format("{}: cannot write: {}", pattern_.file(number).string(), error.message()));
  }
}

}  // namespace wheatstone
