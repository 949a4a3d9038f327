#pragma once

#include <filesystem>

#include "wheatstone/files/unfinished_outputs.h"

namespace wheatstone {

/// A file that appears only when it is whole: write to `path()`, then `commit()` renames it to its real name.
/// Destroyed without commit it is removed. The temporary name lies in the same folder and keeps the extension.
/// What exists and is no plain file (a pipe, a device) is written to directly: there `path()` is the real name.
class TemporaryFile {
 public:
  /// Creates the temporary file, empty. A folder of `final_path` that does not exist is made, and removed again if the
  /// file is not finished. Throws Error{cannot_read_write} where the folder cannot be made or written, or where
  /// `final_path` is itself a folder.
  explicit TemporaryFile(std::filesystem::path final_path);

  const std::filesystem::path& path() const { return temporary_path_; }
  /// As it was given: the name for messages.
  const std::filesystem::path& name() const { return name_; }

  /// Gives the file its real name, in place of what had it. Throws Error{cannot_read_write}.
  void commit();

 private:
  std::filesystem::path name_;
  std::filesystem::path final_path_;
  std::filesystem::path temporary_path_;
  UnfinishedOutput unfinished_;
};

}  // namespace wheatstone
