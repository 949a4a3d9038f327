#pragma once

#include <filesystem>
#include <system_error>

namespace wheatstone {

/// A file that one run holds at a time (flock; the system lets go when the run ends, however it ends).
class FileLock {
 public:
  FileLock() = default;
  ~FileLock() { release(); }
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

  /// Opens the file for reading and writing, makes it where there is none, and holds it. Where another run holds it,
  /// waits for that run, or fails with `std::errc::resource_unavailable_try_again`.
  std::error_code hold(const std::filesystem::path& file, bool waits = false);
  void release();

  /// The file, open while it is held; else -1.
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_ = -1;
};

}  // namespace wheatstone
