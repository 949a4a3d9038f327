#include "inputs.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "command_table.h"
#include "script.h"
#include "temporary_folder.h"
#include "throws_error.h"
#include "viewer.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::viewer::inputs_test {

using testing::HasSubstr;

std::vector<std::byte> packet_of(const std::array<double, 6>& numbers) {
  std::vector<std::byte> packet;
  for (const double number : numbers)
    for (int byte = 0; byte < 8; ++byte)
      packet.push_back(static_cast<std::byte>(std::bit_cast<std::uint64_t>(number) >> (8 * byte)));
  return packet;
}

TEST(Opentrack, IsSixLittleEndianNumbers) {
  // 1 is 3ff0 0000 0000 0000, -2 is c000 0000 0000 0000.
  std::array<unsigned char, 48> bytes{};
  bytes[6] = 0xf0;
  bytes[7] = 0x3f;
  bytes[47] = 0xc0;
  const std::optional<HeadPose> pose = parse_opentrack(std::as_bytes(std::span(bytes)));
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->x_cm, 1);
  EXPECT_EQ(pose->yaw_deg, 0);
  EXPECT_EQ(pose->roll_deg, -2);
}

TEST(Opentrack, RefusesOtherSizesAndWhatIsNoNumber) {
  std::vector<std::byte> packet = packet_of({1, 2, 3, 4, 5, 6});
  EXPECT_TRUE(parse_opentrack(packet));
  EXPECT_FALSE(parse_opentrack({}));
  EXPECT_FALSE(parse_opentrack(std::span(packet).first(47)));
  packet.push_back({});
  EXPECT_FALSE(parse_opentrack(packet));
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    for (std::size_t place = 0; place < 6; ++place) {
      std::array<double, 6> numbers{1, 2, 3, 4, 5, 6};
      numbers[place] = bad;
      EXPECT_FALSE(parse_opentrack(packet_of(numbers)));
    }
}

/// The mean distance between what a filter tells and the truth, at 60 measurements a second, after half a second.
double mean_error(const HeadFilterOptions& options, double noise, double (*truth)(double), double ahead_s = 0) {
  HeadFilter filter;
  std::mt19937 random(1);
  std::normal_distribution<double> error(0, noise > 0 ? noise : 1);
  double sum = 0;
  int count = 0;
  for (int step = 0; step < 300; ++step) {
    const double time_s = step / 60.;
    const double told = filter.add(truth(time_s) + (noise > 0 ? error(random) : 0), time_s, options);
    if (step < 30) continue;
    sum += std::abs(told - truth(time_s + ahead_s));
    ++count;
  }
  return sum / count;
}

TEST(HeadFilter, SteadiesAHeadThatRests) {
  const auto resting = [](double) { return 0.3; };
  const double raw = mean_error({.smoothing_s = 0}, 0.02, resting);
  EXPECT_NEAR(raw, 0.016, 0.003);
  EXPECT_LT(mean_error({.smoothing_s = 0.3}, 0.02, resting), raw / 1.8);
}

TEST(HeadFilter, FollowsAHeadThatMovesFasterThanAPlainMeanDoes) {
  const auto walking = [](double time_s) { return 3 * std::sin(time_s * 2); };
  // A plain mean of that time constant lags behind by the mean speed times it: 3.8 · 0.3.
  EXPECT_LT(mean_error({.smoothing_s = 0.3}, 0, walking), 0.35);
}

TEST(HeadFilter, TellsWhereAHeadWillBe) {
  const auto walking = [](double time_s) { return 2 * time_s; };
  EXPECT_NEAR(mean_error({.smoothing_s = 0}, 0, walking, 0.1), 0.2, 1e-6);
  EXPECT_LT(mean_error({.smoothing_s = 0, .prediction_s = 0.1}, 0, walking, 0.1), 0.01);
}

/// Sends packets to a port of this machine.
class Sender {
 public:
  explicit Sender(int port) : descriptor_(socket(AF_INET, SOCK_DGRAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(connect(descriptor_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  }
  ~Sender() { close(descriptor_); }
  Sender(const Sender&) = delete;
  Sender& operator=(const Sender&) = delete;
  void send_packet(const std::vector<std::byte>& packet) const {
    EXPECT_EQ(send(descriptor_, packet.data(), packet.size(), 0), static_cast<ssize_t>(packet.size()));
  }

 private:
  int descriptor_;
};

TEST(HeadTracker, TellsTheNewestPlaceInEyeSeparationsAndWhetherItIsSilent) {
  HeadTracker tracker(0);
  EXPECT_TRUE(tracker.is_silent(0));
  EXPECT_FALSE(tracker.newest(0, {}));
  const Sender sender(tracker.port());
  sender.send_packet(packet_of({1, 0, 0, 0, 0, 0}));
  sender.send_packet(packet_of({13, 0, 0, 0, 0, 0}));
  sender.send_packet(std::vector<std::byte>(5));
  EXPECT_FLOAT_EQ(tracker.newest(10, {}).value_or(-1), 2);
  EXPECT_FALSE(tracker.is_silent(10.9));
  EXPECT_TRUE(tracker.is_silent(11.1));
  sender.send_packet(std::vector<std::byte>(48, std::byte{0xff}));
  EXPECT_FALSE(tracker.newest(12, {})) << "no number is no place";
  sender.send_packet(packet_of({-1e300, 0, 0, 0, 0, 0}));
  EXPECT_FLOAT_EQ(tracker.newest(20, {}).value_or(0), -100);
}

TEST(HeadTracker, MovesTheViewersHead) {
  Viewer viewer;
  viewer.set_viewport({40, 30});
  run_line(viewer, "head-tracker 0");
  run_line(viewer, "head-smoothing 0");
  ASSERT_TRUE(viewer.session().tracked_head);
  EXPECT_TRUE(viewer.session().tracked_head->is_silent);
  EXPECT_TRUE(viewer.next_step_s());
  const Sender sender(viewer.session().tracked_head->port);
  sender.send_packet(packet_of({3.25, 0, 0, 0, 0, 0}));
  viewer.wait();
  EXPECT_FLOAT_EQ(viewer.session().state.head, 0.5);
  EXPECT_THAT(state_json(viewer), HasSubstr(R"("is_silent":false)"));
  run_line(viewer, "head-tracker off");
  EXPECT_FALSE(viewer.session().tracked_head);
  EXPECT_FALSE(viewer.next_step_s());
}

TEST(HeadTracker, KeepsItsPortWhereAnotherIsTaken) {
  const HeadTracker other(0);
  Viewer viewer;
  run_line(viewer, "head-tracker 0");
  const int port = viewer.session().tracked_head->port;
  expect_error(ErrorKind::cannot_read_write, fmt::format("UDP port {}", other.port()),
               [&] { run_line(viewer, fmt::format("head-tracker {}", other.port())); });
  EXPECT_EQ(viewer.session().tracked_head->port, port);
  expect_error(ErrorKind::wrong_usage, "head-tracker: ", [&] { run_line(viewer, "head-tracker 4242.5"); });
  expect_error(ErrorKind::wrong_usage, "head-tracker: ", [&] { run_line(viewer, "head-tracker 70000"); });
}

const Painting& painting() {
  static const SyntheticStill still = make_synthetic_still({.width = 240, .height = 160, .samples_a_side = 1});
  static const Painting planned = plan_painting(still.pictures, still.geometry, {});
  return planned;
}

class Gaze : public testing::Test {
 protected:
  Gaze() {
    write_painting(folder / "still.wst", painting());
    viewer.session().items.push_back({folder / "still.wst"});
    viewer.set_viewport({240, 160});
    viewer.open(0);
    viewer.wait();
    run_line(viewer, "mode left");
    viewer.wait();
  }
  float zero_parallax() const { return viewer.session().state.adjustment.zero_parallax_px; }
  float disparity_at_pixel(double x, double y) {
    run_line(viewer, fmt::format("zero-parallax-at {} {}", x, y));
    viewer.wait();
    return zero_parallax();
  }
  void look(double x, double y) {
    run_line(viewer, fmt::format("gaze {} {}", x, y));
    viewer.wait();
  }

  const TemporaryFolder folder;
  Viewer viewer;
};

TEST_F(Gaze, BringsWhatIsLookedAtOntoTheScreenAndTakesTime) {
  const float expected = disparity_at_pixel(120, 80);
  run_line(viewer, "zero-parallax 0");
  viewer.wait();
  run_line(viewer, "gaze 120 80");
  viewer.collect();
  EXPECT_LT(zero_parallax(), expected) << "it moves there, and does not jump";
  viewer.wait();
  EXPECT_NEAR(zero_parallax(), expected, 1);
}

TEST_F(Gaze, DoesNotFollowWhatTrembles) {
  look(120, 80);
  run_line(viewer, "zero-parallax 1");
  viewer.wait();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> noise(-16, 16);
  for (int sample = 0; sample < 50; ++sample) look(120 + noise(random), 80 + noise(random));
  EXPECT_EQ(zero_parallax(), 1);
  run_line(viewer, "gaze 20 150");
  EXPECT_TRUE(viewer.session().zero_parallax_target_px) << "another place is followed";
}

/// How far a painting's reference view has what lies around a column from a disparity, at most.
float deepest_around(const Content& content, int column, float disparity_px) {
  const KnownRuns& seen = std::get<PaintedContent>(content).painting->surfaces.seen.front().disparity;
  float deepest_px = 0;
  for (int y = 60; y < 100; ++y)
    for (int x = column - 10; x < column + 10; ++x)
      if (!std::isnan(seen(x, y))) deepest_px = std::max(deepest_px, std::abs(seen(x, y) - disparity_px));
  return deepest_px;
}

TEST_F(Gaze, GetsMoreDepthThereAndLessElsewhereWithoutAJump) {
  run_line(viewer, "mode right");
  viewer.wait();
  const float zero_parallax_before = zero_parallax();
  const Image<Rgb8> before = viewer.frame()->picture;
  const SeenPlace place = *seen_at(viewer, 60, 80);
  run_line(viewer, "gaze-depth 1.5 0.5");
  run_line(viewer, "gaze 60 80");
  viewer.collect();
  const std::optional<DepthAround>& around = viewer.session().state.depth_around;
  ASSERT_TRUE(around);
  EXPECT_LT(around->gain_there, 1.5f) << "it becomes deeper, and does not jump";
  viewer.wait();
  EXPECT_EQ(around->gain_there, 1.5f);
  EXPECT_NEAR(around->disparity_px, place.disparity_px, 1);
  const Content &shown = viewer.frame()->shown, &placed = viewer.frame()->placed;
  const int there = static_cast<int>(place.x), elsewhere = 220;
  EXPECT_GT(deepest_around(shown, there, around->disparity_px),
            1.3f * deepest_around(placed, there, around->disparity_px));
  EXPECT_LT(deepest_around(shown, elsewhere, around->disparity_px),
            0.6f * deepest_around(placed, elsewhere, around->disparity_px));
  EXPECT_NEAR(disparity_at(shown, {left_eye, around->x, around->y}).value_or(-1), around->disparity_px, 0.2)
      << "what one looks at stays where it is";

  EXPECT_THAT(state_json(viewer), HasSubstr(R"("there":1.5)"));
  run_line(viewer, "gaze-depth 1 1");
  viewer.wait();
  EXPECT_FALSE(around);
  run_line(viewer, "zero-parallax " + std::to_string(zero_parallax_before));
  viewer.wait();
  EXPECT_EQ(viewer.frame()->picture, before);
}

TEST_F(Gaze, IsNotUndoneAndNotFollowedBesideThePicture) {
  run_line(viewer, "swap");
  look(120, 80);
  const float before = zero_parallax();
  look(-50, 400);
  EXPECT_EQ(zero_parallax(), before);
  run_line(viewer, "undo");
  EXPECT_FALSE(viewer.session().state.swap) << "the last thing that was set is undone";
  expect_error(ErrorKind::wrong_usage, "cannot be followed", [&] { run_line(viewer, "gaze-follows moon"); });
}

}  // namespace wheatstone::viewer::inputs_test
