#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "wheatstone/app/rotoscope.h"
#include "wheatstone/files/unfinished_outputs.h"
#include "wheatstone/video/frame.h"

namespace wheatstone {

/// A painted frame, as the rank that painted it passes it to the first.
struct PassedFrame {
  Frame frame;             ///< both eyes in one picture; no picture where only marks are written
  RotoscopeTotals totals;  ///< of its scene up to it
  std::string rows_note;   ///< as RotoscopedFrame
};

/// Painted frames on their way from the ranks that paint them to the one that writes the film. They wait in files in
/// the film's work folder, which all ranks see: memory does not grow with the length of scenes, and nobody waits.
/// Frames are counted from 1.
class PassedFrames {
 public:
  /// The folder of an output that another rank holds, or this one.
  PassedFrames(std::filesystem::path work_folder, bool held_here);
  ~PassedFrames() = default;
  PassedFrames(const PassedFrames&) = delete;
  PassedFrames& operator=(const PassedFrames&) = delete;

  /// Throws Error{cannot_read_write}.
  void put(std::int64_t number, const PassedFrame& passed) const;
  /// The frame, once it was put, and removes its file.
  std::optional<PassedFrame> take(std::int64_t number) const;

  /// The file in which the state after a frame waits. It must be written before the frame is put.
  std::filesystem::path state_file(std::int64_t number) const;

 private:
  std::filesystem::path frame_file(std::int64_t number) const;

  std::filesystem::path folder_;
  UnfinishedOutput of_another_;  ///< no file in it is a result of this process
};

/// Removes the frames that were passed and not taken. All ranks must have stopped.
void remove_passed_frames(const std::filesystem::path& work_folder);

}  // namespace wheatstone
