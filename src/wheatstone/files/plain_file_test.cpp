#include "wheatstone/files/whole_file.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>

#include "temporary_folder.h"
#include "throws_error.h"

namespace wheatstone::plain_file_test {

namespace fs = std::filesystem;

TEST(PlainFile, IsWhatIsReadHoweverItIsNamed) {
  const TemporaryFolder folder;
  put_bytes(folder / "file", "x");
  fs::create_symlink("file", folder / "link");
  EXPECT_NO_THROW(check_plain_file(folder / "file", "a film"));
  EXPECT_NO_THROW(check_plain_file(folder / "link", "a film"));
}

TEST(PlainFile, IsNothingElse) {
  const TemporaryFolder folder;
  const auto refused = [&](const fs::path& path, const std::string& why) {
    expect_error(ErrorKind::bad_input, path.filename().string() + ": " + why + ", expected a film",
                 [&] { check_plain_file(path, "a film"); });
  };
  refused(folder / "missing", "no such file");
  refused("/dev/zero", "is a device");
  put_bytes(folder / "empty", "");
  refused(folder / "empty", "is empty");
  fs::create_directory(folder / "below");
  refused(folder / "below", "is a folder");
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  refused(folder / "pipe", "is a pipe");
  EXPECT_NO_THROW(check_plain_file(folder / "pipe", "a film", Pipes::accepted));
  const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, (folder / "socket").c_str(), sizeof(address.sun_path) - 1);
  ASSERT_EQ(::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  refused(folder / "socket", "is a socket");
  ::close(socket);
  fs::create_symlink("loop", folder / "loop");
  expect_error(ErrorKind::cannot_read_write, "loop: cannot read: Too many levels",
               [&] { check_plain_file(folder / "loop", "a film"); });
}

}  // namespace wheatstone::plain_file_test
