#include "wheatstone/matching/monocular_network.h"

#include <gtest/gtest.h>

#include "scenes/tiny_network.h"
#include "temporary_folder.h"
#include "throws_error.h"

namespace wheatstone::monocular_network_test {

using tiny_network::message;
using tiny_network::model;
using tiny_network::node;
using tiny_network::red_of_one_picture;
using tiny_network::value;

/// Red below, none above.
Image<Rgb8> picture(int width, int height) {
  Image<Rgb8> halves(width, height, {0, 90, 90});
  for (int y = height / 2; y < height; ++y) std::ranges::fill(halves.row(y), Rgb8{255, 90, 90});
  return halves;
}

TEST(MonocularNetwork, GetsThePictureAsImageNetHasIt) {
  const TemporaryFolder folder;
  put_bytes(folder / "red.onnx", red_of_one_picture(56, 28));
  const Image<float> depth = depth_by_network(picture(112, 84), folder / "red.onnx");
  // As wide as the answer, in the shape of the picture.
  ASSERT_EQ(depth.width(), 56);
  ASSERT_EQ(depth.height(), 42);
  EXPECT_NEAR(depth(9, 3), (0 - 0.485) / 0.229, 1e-3);
  EXPECT_NEAR(depth(9, 38), (1 - 0.485) / 0.229, 1e-3);
}

TEST(MonocularNetwork, OfOpenSidesGetsMultiplesOf14And32) {
  const TemporaryFolder folder;
  put_bytes(folder / "open.onnx", red_of_one_picture(0, 0));
  EXPECT_EQ(depth_by_network(picture(400, 300), folder / "open.onnx").width(), 672);
  EXPECT_EQ(depth_by_network(picture(300, 400), folder / "open.onnx").width(), 448);
}

TEST(MonocularNetwork, OfOtherShapesIsRefused) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& bytes, const std::string& part) {
    put_bytes(folder / "a.onnx", bytes);
    expect_error(ErrorKind::bad_input, part, [&] { depth_by_network(picture(64, 64), folder / "a.onnx"); });
  };
  const auto taking = [](const std::vector<int>& sides) {
    return model(message(1, node("Relu", {"image"}, "depth")) + message(11, value("image", sides)) +
                 message(12, value("depth", sides)));
  };
  refused("no network", "a.onnx: is not an ONNX network");
  refused(taking({1, 6, 64, 64}), "a.onnx: its input 'image' has another shape");
  refused(taking({3, 64, 64}), "has another shape");
  refused(taking({1, 3, 64, 100000}), "takes pictures 100000 pixels");
  refused(taking({1, 3, 64, 64}), "does not give one number a pixel");
  refused(model(message(1, node("Add", {"a", "b"}, "depth")) + message(11, value("a", {1, 3, 64, 64})) +
                message(11, value("b", {1, 3, 64, 64})) + message(12, value("depth", {1, 3, 64, 64}))),
          "has 2 inputs");
}

}  // namespace wheatstone::monocular_network_test
