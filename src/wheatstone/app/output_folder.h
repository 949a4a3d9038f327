#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "wheatstone/files/unfinished_outputs.h"

namespace wheatstone {

/// A folder of results that appears only when all of them are there. Write to `file(name)`; `commit` gives the folder
/// its real name, or, where that folder exists already, moves the files into it. There they replace those of the same
/// names, and a numbered series replaces the whole series of an earlier run: view_000.png and view_001.png also remove
/// view_002.png. All other files there stay. If the object is destroyed without a commit, it leaves nothing.
class OutputFolder {
 public:
  /// `inputs` are the files that the run reads: none of them is replaced or removed. Throws Error: cannot_read_write
  /// where the folder cannot be made, wrong_usage where it is itself an input.
  explicit OutputFolder(const std::filesystem::path& folder, std::vector<std::filesystem::path> inputs = {});

  /// Where to write the result of this name. Throws Error{wrong_usage} where it would replace an input.
  std::filesystem::path file(std::string_view name) const;

  /// The folder in which the results grow, for results that lie in folders of their own.
  const std::filesystem::path& folder() const { return temporary_; }

  /// Throws Error: cannot_read_write, or wrong_usage where an input is in the way; then nothing was moved, unless the
  /// file system failed in between.
  void commit();

 private:
  void move_into_existing() const;

  std::filesystem::path final_;
  std::filesystem::path temporary_;
  std::vector<std::filesystem::path> inputs_;
  UnfinishedOutput unfinished_;
};

}  // namespace wheatstone
