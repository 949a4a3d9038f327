// Optical flow by a neural network: tiny ONNX networks, whose bytes are put together here.

#include <gtest/gtest.h>

#include <vector>

#include "scenes/tiny_network.h"
#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/motion/flow.h"

namespace wheatstone::flow_network_test {

using tiny_network::message;
using tiny_network::model;
using tiny_network::node;
using tiny_network::red_of_one_picture;
using tiny_network::value;
using tiny_network::weights;

/// Across, the first frame's red less the second's; down, a quarter of the first one's green: the flow of no real film,
/// but another for each order of the frames.
std::string of_two_inputs(int width, int height) {
  return model(
      message(1, node("Conv", {"first", "of_first"}, "a")) + message(1, node("Conv", {"second", "of_second"}, "b")) +
      message(1, node("Add", {"a", "b"}, "flow")) + message(5, weights("of_first", {1, 0, 0, 0, 0.25f, 0}, 2)) +
      message(5, weights("of_second", {-1, 0, 0, 0, 0, 0}, 2)) + message(11, value("first", {1, 3, height, width})) +
      message(11, value("second", {1, 3, height, width})) + message(12, value("flow", {1, 2, height, width})));
}

/// The same of both frames in one input.
std::string of_one_input(int width, int height) {
  return model(message(1, node("Conv", {"frames", "of_frames"}, "flow")) +
               message(5, weights("of_frames", {1, 0, 0, -1, 0, 0, 0, 0.25f, 0, 0, 0, 0}, 2)) +
               message(11, value("frames", {1, 6, height, width})) + message(12, value("flow", {1, 2, height, width})));
}

const Image<Rgb8> first(96, 64, {30, 40, 7}), second(96, 64, {22, 80, 7});

FlowPair flow_of(const std::filesystem::path& file, double size = 1) {
  return estimate_flow(first, second, {.method = FlowMethod::onnx, .size = size, .model = file});
}

TEST(FlowByNetwork, IsFoundBothWaysByNetworksOfOneInputAndOfTwo) {
  const TemporaryFolder folder;
  put_bytes(folder / "two.onnx", of_two_inputs(96, 64));
  put_bytes(folder / "one.onnx", of_one_input(96, 64));
  put_bytes(folder / "open.onnx", of_two_inputs(0, 0));
  for (const char* name : {"two.onnx", "one.onnx", "open.onnx"}) {
    const FlowPair flow = flow_of(folder / name);
    ASSERT_TRUE(same_size(flow.forward.x, first) && same_size(flow.backward.y, first)) << name;
    EXPECT_NEAR(flow.forward.x(50, 20), 8, 1e-3) << name;
    EXPECT_NEAR(flow.forward.y(50, 20), 10, 1e-3) << name;
    EXPECT_NEAR(flow.backward.x(50, 20), -8, 1e-3) << name;
    EXPECT_NEAR(flow.backward.y(50, 20), 20, 1e-3) << name;
  }
}

TEST(FlowByNetwork, IsInPixelsOfTheFrames) {
  const TemporaryFolder folder;
  put_bytes(folder / "half.onnx", of_two_inputs(48, 16));
  const FlowPair fixed = flow_of(folder / "half.onnx");
  EXPECT_NEAR(fixed.forward.x(50, 20), 2 * 8, 1e-3);
  EXPECT_NEAR(fixed.forward.y(50, 20), 4 * 10, 1e-3);
  // Of copies of a third of the width, 32 x 21 pixels, go in 32 x 32.
  put_bytes(folder / "open.onnx", of_two_inputs(0, 0));
  const FlowPair open = flow_of(folder / "open.onnx", 1.0 / 3);
  EXPECT_NEAR(open.forward.x(50, 20), 3 * 8, 1e-3);
  EXPECT_NEAR(open.forward.y(50, 20), 2 * 10, 1e-3);
}

TEST(FlowByNetwork, WhatIsNoSuchNetworkIsRefused) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& bytes, const std::string& why) {
    put_bytes(folder / "a.onnx", bytes);
    expect_error(ErrorKind::bad_input, "a.onnx: " + why, [&] { flow_of(folder / "a.onnx"); });
  };
  refused("no network",
          "is not an ONNX network, expected an ONNX network that takes two pictures and gives an optical");
  refused(red_of_one_picture(96, 64), "input 'image' is not 1x6xHEIGHTxWIDTH");
  refused(model(message(1, node("Add", {"a", "b"}, "sum")) + message(11, value("a", {1, 3, 64, 96})) +
                message(11, value("b", {1, 3, 64, 96})) + message(12, value("sum", {1, 3, 64, 96}))),
          "does not return 1x2xHEIGHTxWIDTH");
  refused(model(message(1, node("Add", {"a", "b"}, "sum")) + message(11, value("a", {1, 3, 64, 96})) +
                message(11, value("b", {1, 3, 32, 96})) + message(12, value("sum", {1, 3, 64, 96}))),
          "its two inputs differ in size");
  expect_error(ErrorKind::bad_input, "missing.onnx", [&] { flow_of(folder / "missing.onnx"); });
}

}  // namespace wheatstone::flow_network_test
