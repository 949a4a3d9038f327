#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

namespace wheatstone {

/// The folders that lead to one, and itself, made where they do not exist. Those in which nothing lies by then are
/// removed at the end of its life, or when the process must end at once.
class MissingFolders {
 public:
  /// Throws Error{cannot_read_write} where a folder cannot be made.
  explicit MissingFolders(const std::filesystem::path& folder);
  ~MissingFolders();
  MissingFolders(const MissingFolders&) = delete;
  MissingFolders& operator=(const MissingFolders&) = delete;

 private:
  std::vector<std::filesystem::path> made_;  ///< from the outermost on
};

/// A file or folder under a temporary name, removed with all that is in it unless it gets its real name. Those of the
/// whole process are known, so that a program that must end at once can leave none behind.
class UnfinishedOutput {
 public:
  /// Nothing yet.
  UnfinishedOutput() = default;
  ~UnfinishedOutput();
  UnfinishedOutput(const UnfinishedOutput&) = delete;
  UnfinishedOutput& operator=(const UnfinishedOutput&) = delete;

  /// Makes the folders above as MissingFolders, and calls `make`, which creates what has this temporary name. What
  /// `make` throws is passed on; then nothing is begun.
  void begin(std::filesystem::path temporary, const std::function<void()>& make);

  /// Whether it stays under its temporary name when it is not finished, because another run goes on with it. What is
  /// finished inside it is no result yet. Nothing to do where nothing was begun.
  void keep(bool kept);

  /// Calls `rename`, which gives the output its real name, and is done with it. What `rename` throws is passed on; then
  /// the output remains unfinished. Nothing to do where nothing was begun.
  void finish(const std::function<void()>& rename);

 private:
  std::filesystem::path temporary_;  ///< empty where nothing is unfinished
  std::unique_ptr<MissingFolders> above_;
  bool kept_ = false;
};

/// While this lives, outputs of this thread are finished only where `wanted` holds, which is asked under the lock of
/// hold_outputs; else finish throws Error{interrupted}. For work that goes on when nobody waits for it any more.
class OutputsOnlyWhile {
 public:
  explicit OutputsOnlyWhile(std::function<bool()> wanted);
  ~OutputsOnlyWhile();
  OutputsOnlyWhile(const OutputsOnlyWhile&) = delete;
  OutputsOnlyWhile& operator=(const OutputsOnlyWhile&) = delete;
};

/// While this is held, other threads neither begin nor finish an output: several outputs can be finished as one.
[[nodiscard]] std::unique_lock<std::recursive_mutex> hold_outputs();

/// Whether outputs were finished and none is unfinished: what remains of a run is to say so.
bool outputs_are_finished();

/// Removes all unfinished outputs of this process but those that are kept.
void remove_unfinished_outputs();

}  // namespace wheatstone
