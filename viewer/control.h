#pragma once

#include <deque>
#include <filesystem>
#include <list>
#include <optional>
#include <string>

#include "script.h"

namespace wheatstone::viewer {

/// Lines from other programs: a Unix socket on which several clients may speak at once. Each line is done as
/// LineRunner does it, each client's in order, and answered by one line: `ok`, `error: …`, or what it prints. Lines of
/// more than 16384 bytes are refused. Only the user who runs the program may connect. For one thread; none of the
/// functions blocks.
class Control {
 public:
  /// Throws Error{cannot_read_write} where no socket can be made at the path: where there is another file, or a program
  /// listens already. A socket that an ended program has left is replaced.
  Control(std::filesystem::path path, ScriptHost host);
  /// Closes all connections and removes the socket.
  ~Control();
  Control(const Control&) = delete;
  Control& operator=(const Control&) = delete;

  /// Readable when go_on has something to do.
  int descriptor() const { return events_; }
  /// Reads, does what can be done without waiting, and answers.
  void go_on(Viewer& viewer);
  /// A line waits for something else than its client: go_on is to be called again soon.
  bool is_waiting() const;

 private:
  struct Client {
    int descriptor = -1;
    std::string received;                          ///< of a line that has not ended
    bool is_long = false;                          ///< it is too long: the rest is left out
    std::deque<std::optional<std::string>> lines;  ///< not begun yet; none: was too long
    bool is_doing = false;                         ///< a line
    std::string printed;                           ///< by it
    bool at_end = false;                           ///< nothing more will come
    std::string answers;                           ///< not sent yet
    LineRunner runner;
  };

  void accept_clients();
  void read_from(Client& client);
  void do_lines(Client& client, Viewer& viewer);
  /// False where the client is gone.
  bool send_to(Client& client);

  std::filesystem::path path_;
  ScriptHost host_;
  int listener_ = -1, events_ = -1;
  std::list<Client> clients_;  ///< do not move: their runners know them
};

}  // namespace wheatstone::viewer
