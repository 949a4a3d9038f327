#pragma once

#include <cstdint>
#include <filesystem>

#include "wheatstone/marks/painting.h"
#include "wheatstone/video/frame_sequence.h"
#include "wheatstone/video/work_folder.h"

namespace wheatstone {

/// The temporary file of a frame's marks, until the marks of all frames get their names. `path` is the pattern of the
/// names.
std::filesystem::path unfinished_marks(const std::filesystem::path& path, std::int64_t frame);

/// The marks of a film's frames, in numbered files from 1 on, which get their names together when all are there. Until
/// then they lie in a work folder beside them, "marks_%04d.wst.part", where they stay when a run ends before.
class MarksSequence {
 public:
  /// `path` is a pattern. Marks of an earlier run after the first `kept` are removed. Throws as WorkFolder.
  MarksSequence(const std::filesystem::path& path, std::int64_t kept);

  void write(std::int64_t frame, const Painting& marks);

  /// A program that ends at once leaves them: the frames of another output are kept, too.
  void keep() { held_.keep(true); }

  /// Throws Error{bad_input} where the marks of one of the first `frames` frames are missing.
  void check(std::int64_t frames) const;

  /// Gives them their names and removes the folder. Throws Error{cannot_read_write}.
  void give_names(std::int64_t frames);

  /// Removes everything.
  void discard() { held_.remove(); }

 private:
  FramePattern pattern_;
  FramePattern hidden_;  ///< the same in the work folder
  WorkFolder held_;
};

}  // namespace wheatstone
