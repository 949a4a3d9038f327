#pragma once

#include <filesystem>

#include "wheatstone/files/file_lock.h"
#include "wheatstone/files/unfinished_outputs.h"

namespace wheatstone {

/// The folder beside an output that takes long to make: "out.mp4.part" of "out.mp4".
std::filesystem::path work_folder_of(const std::filesystem::path& output);

/// Such a folder, held by one run at a time (FileLock on a file in it). What is in it stays until `remove`.
class WorkFolder {
 public:
  /// Makes the folder where there is none. Throws Error{wrong_usage} where another run holds it, cannot_read_write
  /// where it cannot be made.
  explicit WorkFolder(std::filesystem::path output);
  ~WorkFolder();
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

  std::filesystem::path file(const std::filesystem::path& name) const { return folder_ / name; }

  /// Whether it stays where the program ends at once (UnfinishedOutput); it does unless this says otherwise.
  void keep(bool kept) { unfinished_.keep(kept); }

  /// Removes the folder with all that is in it.
  void remove();

 private:
  void take(const std::filesystem::path& output);

  std::filesystem::path folder_;
  FileLock lock_;
  UnfinishedOutput unfinished_;
};

}  // namespace wheatstone
