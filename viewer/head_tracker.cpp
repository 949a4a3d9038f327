#include "head_tracker.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>

#include "wheatstone/error.h"

namespace wheatstone::viewer {
namespace {

/// The share of a new value in a mean that forgets with a time constant.
double share_of_new(double passed_s, double constant_s) {
  return constant_s > 0 ? passed_s / (passed_s + constant_s) : 1;
}

constexpr double silent_after_s = 1;
constexpr double eye_separation_cm = 6.5;
constexpr double farthest_place = 100;  ///< as of the command `head`

}  // namespace

double HeadFilter::add(double position, double time_s, const HeadFilterOptions& options) {
  constexpr double speed_constant_s = 0.05;
  // Cut-off in hertz that an eye separation a second adds.
  constexpr double beta = 2;
  if (!before_ || time_s <= before_->time_s) {
    if (!before_) before_ = Measured{time_s, position, position, 0};
    return before_->steadied;
  }
  Measured now{time_s, position, 0, 0};
  const double passed_s = time_s - before_->time_s;
  const double speed = (position - before_->position) / passed_s;
  now.speed = std::lerp(before_->speed, speed, share_of_new(passed_s, speed_constant_s));
  double constant_s = options.smoothing_s;
  if (constant_s > 0) {
    const double cut_off_hz = 1 / (2 * std::numbers::pi * constant_s) + beta * std::abs(now.speed);
    constant_s = 1 / (2 * std::numbers::pi * cut_off_hz);
  }
  now.steadied = std::lerp(before_->steadied, position, share_of_new(passed_s, constant_s));
  before_ = now;
  return now.steadied + now.speed * options.prediction_s;
}

std::optional<HeadPose> parse_opentrack(std::span<const std::byte> packet) {
  std::array<double, 6> numbers{};
  if (packet.size() != sizeof numbers) return {};
  for (std::size_t n = 0; n < numbers.size(); ++n) {
    std::uint64_t bits = 0;
    for (std::size_t byte = 0; byte < sizeof bits; ++byte)
      bits |= std::to_integer<std::uint64_t>(packet[n * sizeof bits + byte]) << (8 * byte);
    numbers[n] = std::bit_cast<double>(bits);
  }
  if (!std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); })) return {};
  return HeadPose{numbers[0], numbers[1], numbers[2], numbers[3], numbers[4], numbers[5]};
}

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
  return static_cast<float>(std::clamp(place, -farthest_place, farthest_place));
}

bool HeadTracker::is_silent(double now_s) const { return !heard_at_s_ || now_s - *heard_at_s_ > silent_after_s; }

}  // namespace wheatstone::viewer
