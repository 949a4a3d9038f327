#include "control.h"

#include <fmt/format.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <utility>

#include "command_table.h"
#include "wheatstone/error.h"

namespace wheatstone::viewer {
namespace {

constexpr std::size_t longest_line = 16384;
constexpr std::size_t most_lines = 4096;                    ///< of a client that waits; further ones stay unread
constexpr std::size_t most_answers = std::size_t{1} << 20;  ///< bytes that a client may leave unread
constexpr std::size_t most_clients = 64;

[[noreturn]] void fail(const std::filesystem::path& path, std::string_view why) {
  throw Error(ErrorKind::cannot_read_write, fmt::format("--control {}: {}", path.string(), why));
}

sockaddr_un address_of(const std::filesystem::path& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.string().size() >= sizeof address.sun_path)
    fail(path, fmt::format("the path of a socket has at most {} bytes", sizeof address.sun_path - 1));
  std::ranges::copy(path.string(), address.sun_path);
  return address;
}

const sockaddr* plain(const sockaddr_un& address) { return reinterpret_cast<const sockaddr*>(&address); }

/// A program listens there.
bool is_answered(const sockaddr_un& address) {
  const int descriptor = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const bool answered = connect(descriptor, plain(address), sizeof address) == 0;
  close(descriptor);
  return answered;
}

void remove_socket_that_was_left(const std::filesystem::path& path, const sockaddr_un& address) {
  std::error_code error;
  const auto status = std::filesystem::symlink_status(path, error);
  if (!std::filesystem::exists(status)) return;
  if (!std::filesystem::is_socket(status)) fail(path, "is a file, expected the name of a socket to be made");
  if (is_answered(address)) fail(path, "another program listens there");
  std::filesystem::remove(path, error);
}

/// What may be told in one line.
std::string one_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
}

}  // namespace

Control::Control(std::filesystem::path path, ScriptHost host) : path_(std::move(path)), host_(std::move(host)) {
  const sockaddr_un address = address_of(path_);
  remove_socket_that_was_left(path_, address);
  listener_ = socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  // The socket's own mode becomes the file's: of the user alone, from the first moment on.
  fchmod(listener_, S_IRUSR | S_IWUSR);
  if (bind(listener_, plain(address), sizeof address) != 0) {
    const int why = errno;
    close(listener_);
    fail(path_, std::strerror(why));
  }
  listen(listener_, SOMAXCONN);
  events_ = epoll_create1(EPOLL_CLOEXEC);
  epoll_event event{.events = EPOLLIN, .data = {.fd = listener_}};
  epoll_ctl(events_, EPOLL_CTL_ADD, listener_, &event);
}

Control::~Control() {
  for (Client& client : clients_) {
    send_to(client);
    close(client.descriptor);
  }
  close(events_);
  close(listener_);
  std::error_code error;
  std::filesystem::remove(path_, error);
}

void Control::accept_clients() {
  while (clients_.size() < most_clients) {
    const int descriptor = accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (descriptor < 0) return;
    ScriptHost host = host_;
    Client& client = clients_.emplace_back();
    client.descriptor = descriptor;
    std::string& printed = client.printed;
    host.print = [&printed](const std::string& line) { printed = line; };
    client.runner = LineRunner(std::move(host));
    epoll_event event{.events = EPOLLIN, .data = {.fd = descriptor}};
    epoll_ctl(events_, EPOLL_CTL_ADD, descriptor, &event);
  }
}

void Control::read_from(Client& client) {
  std::array<char, 4096> piece{};
  while (!client.at_end && client.lines.size() < most_lines) {
    const ssize_t count = recv(client.descriptor, piece.data(), piece.size(), 0);
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) return;
    if (count <= 0) {
      // What was sent before is still done, and nobody is to be woken for the end again and again.
      client.at_end = true;
      epoll_ctl(events_, EPOLL_CTL_DEL, client.descriptor, nullptr);
      return;
    }
    for (const char letter : std::string_view(piece.data(), static_cast<std::size_t>(count))) {
      if (letter == '\n') {
        client.lines.push_back(std::exchange(client.is_long, false) ? std::nullopt : std::optional(client.received));
        client.received.clear();
      } else if (client.received.size() < longest_line) {
        client.received += letter;
      } else {
        client.is_long = true;
      }
    }
  }
}

void Control::do_lines(Client& client, Viewer& viewer) {
  while (true) {
    try {
      if (client.is_doing) {
        if (!client.runner.is_done(viewer)) return;
        client.is_doing = false;
        client.answers += (client.printed.empty() ? "ok" : std::exchange(client.printed, {})) + '\n';
      }
      if (client.lines.empty() || viewer.session().ends) return;
      const std::optional<std::string> line = std::move(client.lines.front());
      client.lines.pop_front();
      if (!line) throw Error(ErrorKind::wrong_usage, fmt::format("the line has more than {} bytes", longest_line));
      if (words_of(*line).empty()) continue;
      client.runner.begin(viewer, *line);
      client.is_doing = true;
      viewer.collect();
    } catch (const Error& error) {
      client.is_doing = false;
      client.answers += "error: " + one_line(error.what()) + '\n';
    }
  }
}

bool Control::send_to(Client& client) {
  while (!client.answers.empty()) {
    const ssize_t count =
        send(client.descriptor, client.answers.data(), client.answers.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno == EAGAIN && client.answers.size() < most_answers;
    client.answers.erase(0, static_cast<std::size_t>(count));
  }
  return !client.at_end || client.is_doing || !client.lines.empty();
}

void Control::go_on(Viewer& viewer) {
  accept_clients();
  for (auto client = clients_.begin(); client != clients_.end();) {
    read_from(*client);
    do_lines(*client, viewer);
    if (send_to(*client)) {
      ++client;
    } else {
      close(client->descriptor);
      client = clients_.erase(client);
    }
  }
}

bool Control::is_waiting() const {
  return std::ranges::any_of(clients_, [](const Client& client) { return client.is_doing || !client.answers.empty(); });
}

}  // namespace wheatstone::viewer
