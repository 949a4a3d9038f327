#include "control.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/files/whole_file.h"

namespace wheatstone::viewer::control_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

/// A program that speaks to a control socket.
class Client {
 public:
  explicit Client(const std::filesystem::path& path) : descriptor_(socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::ranges::copy(path.string(), address.sun_path);
    connected_ = connect(descriptor_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }
  ~Client() { close(descriptor_); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  bool connected() const { return connected_; }
  void say(const std::string& text) const {
    EXPECT_EQ(send(descriptor_, text.data(), text.size(), MSG_NOSIGNAL), static_cast<ssize_t>(text.size()));
  }
  void say_no_more() const { shutdown(descriptor_, SHUT_WR); }
  /// The lines that have come so far.
  const std::vector<std::string>& heard() {
    std::string piece(65536, '\0');
    for (ssize_t count = 0; (count = recv(descriptor_, piece.data(), piece.size(), 0)) > 0;)
      received_ += piece.substr(0, static_cast<std::size_t>(count));
    lines_.clear();
    std::istringstream text(received_);
    for (std::string line; std::getline(text, line);) lines_.push_back(line);
    return lines_;
  }

 private:
  int descriptor_;
  bool connected_ = false;
  std::string received_;
  std::vector<std::string> lines_;
};

class ControlSocket : public testing::Test {
 protected:
  ControlSocket() { viewer.set_viewport({40, 30}); }
  /// Goes on until the client has heard so many lines, or for long.
  void go_on(Client& client, std::size_t lines) {
    for (int step = 0; step < 2000 && client.heard().size() < lines; ++step) {
      control->go_on(viewer);
      viewer.collect();
      usleep(1000);
    }
  }

  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "control";
  Viewer viewer;
  std::unique_ptr<Control> control = std::make_unique<Control>(path, ScriptHost{});
};

TEST_F(ControlSocket, AnswersEachLineInOrder) {
  Client client(path);
  client.say("mode left-right\n\n# nothing\nfly\nwait\nprint\nhead 0.5\n");
  go_on(client, 5);
  EXPECT_THAT(client.heard(), ElementsAre("ok", StartsWith("error: 'fly' is no command"), "ok",
                                          HasSubstr(R"("mode":"left-right")"), "ok"));
  EXPECT_FLOAT_EQ(viewer.session().state.head, 0.5F);
}

TEST_F(ControlSocket, LetsOneClientGoOnWhileAnotherWaits) {
  Client patient(path), other(path);
  patient.say("wait 0.2\nhead 1\n");
  other.say("head 2\nprint\n");
  go_on(other, 2);
  EXPECT_THAT(patient.heard(), ElementsAre());
  EXPECT_THAT(other.heard(), ElementsAre("ok", HasSubstr(R"("head":2.0)")));
  EXPECT_TRUE(control->is_waiting());
  go_on(patient, 2);
  EXPECT_THAT(patient.heard(), ElementsAre("ok", "ok"));
  EXPECT_FLOAT_EQ(viewer.session().state.head, 1);
}

TEST_F(ControlSocket, RefusesALineThatIsTooLongAndGoesOn) {
  Client client(path);
  client.say("head 1\n");
  client.say(std::string(20000, 'x'));
  control->go_on(viewer);
  client.say(std::string(20000, 'x') + "\nhead 3\n");
  go_on(client, 3);
  EXPECT_THAT(client.heard(), ElementsAre("ok", "error: the line has more than 16384 bytes", "ok"));
}

TEST_F(ControlSocket, DoesWhatAClientSaidBeforeItLeft) {
  {
    Client client(path);
    client.say("wait 0.05\nhead 4\n");
    client.say_no_more();
    go_on(client, 2);
    EXPECT_THAT(client.heard(), ElementsAre("ok", "ok"));
  }
  {
    const Client gone(path);
    gone.say("head 5\nprint\n");
  }
  for (int step = 0; step < 100; ++step) control->go_on(viewer);
  EXPECT_FLOAT_EQ(viewer.session().state.head, 5);
  EXPECT_FALSE(control->is_waiting());
}

TEST_F(ControlSocket, TellsWhatFailedToWhoWaitsForIt) {
  write_whole_file(folder / "damaged.wst", "no painting");
  Client client(path);
  client.say(fmt::format("open \"{}\"\nwait\nwait\n", (folder / "damaged.wst").string()));
  go_on(client, 3);
  EXPECT_THAT(client.heard(), ElementsAre("ok", HasSubstr("damaged.wst"), "ok"));
}

TEST_F(ControlSocket, IsForItsUserAloneAndIsRemovedAtTheEnd) {
  struct stat found {};
  ASSERT_EQ(stat(path.c_str(), &found), 0);
  EXPECT_EQ(found.st_mode & 0777U, 0600U);
  control.reset();
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST_F(ControlSocket, TakesThePlaceOfOneThatWasLeftButOfNothingElse) {
  expect_error(ErrorKind::cannot_read_write, "another program listens", [&] { const Control second(path, {}); });
  const std::filesystem::path left = folder / "left";
  {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::ranges::copy(left.string(), address.sun_path);
    const int descriptor = socket(AF_UNIX, SOCK_STREAM, 0);
    ASSERT_EQ(bind(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    close(descriptor);
  }
  { const Control control_in_its_place(left, {}); }
  write_whole_file(folder / "file", "dear");
  expect_error(ErrorKind::cannot_read_write, "is a file", [&] { const Control second(folder / "file", {}); });
  EXPECT_EQ(read_whole_file(folder / "file", 100), "dear");
  expect_error(ErrorKind::cannot_read_write, "at most 107 bytes",
               [&] { const Control second(folder / std::string(120, 'a'), {}); });
}

}  // namespace wheatstone::viewer::control_test
