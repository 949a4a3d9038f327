#include "head_tracker.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "wheatstone/error.h"

namespace wheatstone::viewer {
namespace {

constexpr double silent_after_s = 1;
constexpr double eye_separation_cm = 6.5;
constexpr double farthest = 100;  ///< as of the command `head`

}  // namespace

HeadTracker::HeadTracker(std::uint16_t port)
    : descriptor_(socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_ANY);
  socklen_t size = sizeof address;
  if (bind(descriptor_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      getsockname(descriptor_, reinterpret_cast<sockaddr*>(&address), &size) != 0) {
    const int why = errno;
    close(descriptor_);
    throw Error(ErrorKind::cannot_read_write, fmt::format("UDP port {}: {}", port, std::strerror(why)));
  }
  port_ = ntohs(address.sin_port);
}

HeadTracker::~HeadTracker() { close(descriptor_); }

std::optional<float> HeadTracker::newest(double now_s, const HeadFilterOptions& options) {
  constexpr int most_packets = 1000;  // at once: a sender may be faster than they are read
  std::array<std::byte, 256> packet{};
  std::optional<HeadPose> last;
  for (int count = 0; count < most_packets; ++count) {
    const ssize_t size = recv(descriptor_, packet.data(), packet.size(), 0);
    if (size < 0) break;
    if (const std::optional<HeadPose> pose = parse_opentrack(std::span(packet).first(static_cast<std::size_t>(size))))
      last = pose;
  }
  if (!last) return {};
  if (is_silent(now_s)) filter_.forget();
  heard_at_s_ = now_s;
  farther_cm_ = last->z_cm;
  const double place = filter_.add(last->x_cm / eye_separation_cm, now_s, options);
  return static_cast<float>(std::clamp(place, -farthest, farthest));
}

bool HeadTracker::is_silent(double now_s) const { return !heard_at_s_ || now_s - *heard_at_s_ > silent_after_s; }

}  // namespace wheatstone::viewer
