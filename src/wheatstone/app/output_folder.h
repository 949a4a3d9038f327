#pragma once

#include <filesystem>
#include <string_view>

namespace wheatstone {

/// A folder of results that appears only when all of them are there. Write to `file(name)`; `commit` gives the folder
/// its real name, or, where that folder exists already, moves the files into it and replaces those of the same names.
/// Destroyed without commit, nothing is left.
class OutputFolder {
 public:
  /// Throws Error{cannot_read_write} where the folder cannot be made.
  explicit OutputFolder(std::filesystem::path folder);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  std::filesystem::path file(std::string_view name) const { return temporary_ / name; }
  void commit();

 private:
  std::filesystem::path final_;
  std::filesystem::path temporary_;
};

}  // namespace wheatstone
