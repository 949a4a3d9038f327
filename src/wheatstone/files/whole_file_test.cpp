#include "wheatstone/files/whole_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <fstream>
#include <thread>

#include "temporary_folder.h"
#include "throws_error.h"

namespace wheatstone::whole_file_test {

namespace fs = std::filesystem;

TEST(WholeFile, ReadsBackWhatWasWritten) {
  const TemporaryFolder folder;
  const std::string bytes("a\0b\r\n\xff", 6);
  write_whole_file(folder / "file.bin", bytes);
  EXPECT_EQ(read_whole_file(folder / "file.bin", 6), bytes);
}

TEST(WholeFile, RefusesToReadWhatIsTooLongMissingOrAFolder) {
  const TemporaryFolder folder;
  put_bytes(folder / "file.bin", "1234567");
  expect_error(ErrorKind::bad_input, "7 bytes", [&] { read_whole_file(folder / "file.bin", 6); });
  expect_error(ErrorKind::bad_input, "missing.bin", [&] { read_whole_file(folder / "missing.bin", 6); });
  expect_error(ErrorKind::bad_input, "folder", [&] { read_whole_file(folder / "", 6); });
}

TEST(WholeFile, IsReadFromAPipeWithAnEndAndFromNoDevice) {
  const TemporaryFolder folder;
  const fs::path pipe = folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const std::string bytes(200'000, 'x');
  std::thread writer([&] { std::ofstream(pipe) << bytes; });
  EXPECT_EQ(read_whole_file(pipe, bytes.size()), bytes);
  writer.join();
  expect_error(ErrorKind::bad_input, "only once", [&] { read_whole_file(pipe, bytes.size()); });
  ::signal(SIGPIPE, SIG_IGN);
  const fs::path other = folder / "other";
  ASSERT_EQ(::mkfifo(other.c_str(), 0600), 0);
  std::thread endless([&] {
    std::ofstream file(other);
    while (file << bytes) continue;
  });
  expect_error(ErrorKind::bad_input, "other: is a pipe of more than 200000 bytes",
               [&] { read_whole_file(other, bytes.size()); });
  endless.join();
  expect_error(ErrorKind::bad_input, "/dev/zero: is a device", [&] { read_whole_file("/dev/zero", 6); });
}

TEST(WholeFile, SaysThatTheDiskIsFull) {
  const TemporaryFolder folder;
  fs::create_symlink("/dev/full", folder / "file.bin");
  expect_error(ErrorKind::cannot_read_write, "No space left",
               [&] { write_whole_file(folder / "file.bin", std::string(100000, 'x')); });
  expect_error(ErrorKind::cannot_read_write, "No space left", [&] { write_whole_file(folder / "file.bin", "x"); });
}

TEST(WholeFile, SaysThatThePipeIsClosed) {
  ::signal(SIGPIPE, SIG_IGN);
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe(ends.data()), 0);
  ::close(ends[0]);
  expect_error(ErrorKind::cannot_read_write, "Broken pipe",
               [&] { write_whole_file("/proc/self/fd/" + std::to_string(ends[1]), "x"); });
  ::close(ends[1]);
}

}  // namespace wheatstone::whole_file_test
