#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "wheatstone/files/file_lock.h"

namespace wheatstone {

/// A table that grows by whole lines, each of which is on the disk when `append` returns, and that one session holds at
/// a time (FileLock). What a machine that died left half-written at its end is cut off when the table is opened again.
/// Beside the table lies a reserve of disk, so that a line that the disk has no room for is not lost: it is kept there,
/// and joins the table when that is opened again.
class TrialLog {
 public:
  /// Opens the table, or begins it with this header. Throws Error: wrong_usage where another session holds it,
  /// bad_input where it has another header, and then it is left as it is, cannot_read_write.
  TrialLog(std::filesystem::path path, std::string_view header);
  TrialLog(const TrialLog&) = delete;
  TrialLog& operator=(const TrialLog&) = delete;

  /// Appends one line, which ends with '\n'. Throws Error{cannot_read_write} that says where the line is kept.
  void append(std::string_view line);
  /// The reserve is no longer needed.
  void finish();

 private:
  /// Adds bytes at the end. Throws Error{cannot_read_write}.
  void add(std::string_view bytes);
  void take_over_reserve();
  void make_reserve() const;

  std::filesystem::path path_, reserve_;
  FileLock lock_;
  std::size_t size_ = 0;
};

/// Reads what a table has, with a line that is kept in its reserve.
std::string read_trial_log(const std::filesystem::path& path);

}  // namespace wheatstone
