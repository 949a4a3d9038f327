#pragma once

// Numbered pictures that appear together when all are there.

#include <filesystem>

#include "wheatstone/stereo/stereo_layout.h"
#include "wheatstone/video/frame.h"
#include "wheatstone/video/frame_sequence.h"

namespace wheatstone {

/// Throws Error{wrong_usage} where pictures of such names exist already: two runs would mix.
void check_no_pictures(const std::filesystem::path& path, const FramePattern& pattern);

class SequenceFile {
 public:
  /// Until all are there they lie in the folder `hidden`, which is on the same file system and goes with this. Throws
  /// Error{cannot_read_write} where it cannot be made.
  /// The layout says how eyes lie in a picture: OpenEXR files hold each as a view.
  SequenceFile(FramePattern pattern, std::filesystem::path hidden, StereoLayout layout);
  ~SequenceFile();
  SequenceFile(const SequenceFile&) = delete;
  SequenceFile& operator=(const SequenceFile&) = delete;

  void add(const Frame& frame);
  void finish();

 private:
  FramePattern pattern_;
  FramePattern hidden_;  ///< the same in a folder of its own, until all are there
  StereoLayout layout_;
  std::int64_t count_ = 0;
};

}  // namespace wheatstone
