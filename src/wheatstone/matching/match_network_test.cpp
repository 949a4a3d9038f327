// Matching by a neural network: tiny ONNX networks, whose bytes are put together here.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "scenes/tiny_network.h"
#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/matching/match.h"
#include "wheatstone/matching/network_inputs_internal.h"

namespace wheatstone::match_network_test {

using tiny_network::message;
using tiny_network::model;
using tiny_network::node;
using tiny_network::value;
using tiny_network::weights;

/// Disparity = (the left picture's red + the right one's) / 8.
std::string two_inputs(int width, int height) {
  return model(message(1, node("Conv", {"left", "of_left"}, "a")) +
               message(1, node("Conv", {"right", "of_right"}, "b")) + message(1, node("Add", {"a", "b"}, "disparity")) +
               message(5, weights("of_left", {0.125f, 0, 0})) + message(5, weights("of_right", {0.125f, 0, 0})) +
               message(11, value("left", {1, 3, height, width})) + message(11, value("right", {1, 3, height, width})) +
               message(12, value("disparity", {1, 1, height, width})));
}

/// The same of both pictures in one input, with the opposite sign.
std::string one_input(int width, int height) {
  return model(message(1, node("Conv", {"pair", "of_pair"}, "flow")) +
               message(5, weights("of_pair", {-0.125f, 0, 0, -0.125f, 0, 0})) +
               message(11, value("pair", {1, 6, height, width})) + message(12, value("flow", {1, 1, height, width})));
}

/// Every pixel's red says a disparity of 10, or of 20 in the lower half, as the networks above see it.
StereoPair coded_pair() {
  StereoPair pair{Image<Rgb8>(96, 64), Image<Rgb8>(96, 64)};
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 96; ++x)
      pair.left(x, y) = pair.right(x, y) = {static_cast<std::uint8_t>(y < 32 ? 40 : 80),
                                            static_cast<std::uint8_t>(x * 53 % 251), 200};
  return pair;
}

MatchOptions with_model(const std::filesystem::path& file) {
  MatchOptions options;
  options.matcher = Matcher::onnx;
  options.model = file;
  options.range = DisparityRange{0, 40};
  return options;
}

TEST(MatchByNetwork, RunsNetworksOfOneInputAndOfTwo) {
  const TemporaryFolder folder;
  put_bytes(folder / "two.onnx", two_inputs(96, 64));
  put_bytes(folder / "one.onnx", one_input(96, 64));
  for (const char* name : {"two.onnx", "one.onnx"}) {
    const Image<float> disparity = match(coded_pair(), with_model(folder / name)).geometry.left_disparity;
    for (int x = 0; x < 96; ++x) {
      EXPECT_NEAR(disparity(x, 5), 10, 1e-3) << name << " " << x;
      EXPECT_NEAR(disparity(x, 60), 20, 1e-3) << name << " " << x;
    }
  }
}

TEST(MatchByNetwork, CountsDisparitiesInPixelsOfThePictures) {
  const TemporaryFolder folder;
  put_bytes(folder / "half.onnx", two_inputs(48, 32));
  EXPECT_NEAR(match(coded_pair(), with_model(folder / "half.onnx")).geometry.left_disparity(50, 5), 20, 1e-3);
}

TEST(MatchByNetwork, TakesValuesUpToOne) {
  const TemporaryFolder folder;
  put_bytes(folder / "two.onnx", two_inputs(96, 64));
  MatchOptions options = with_model(folder / "two.onnx");
  options.model_values = NetworkValues::to_1;
  EXPECT_NEAR(match(coded_pair(), options).geometry.left_disparity(50, 5), 10.0 / 255, 1e-4);
}

TEST(MatchByNetwork, RefusesWhatIsNoStereoNetwork) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& bytes, const std::string& why) {
    put_bytes(folder / "model.onnx", bytes);
    expect_error(ErrorKind::bad_input, "model.onnx: " + why,
                 [&] { match(coded_pair(), with_model(folder / "model.onnx")); });
  };
  const std::string whole = two_inputs(96, 64);
  refused("Dear Sir, this is a letter.\n", "is not an ONNX network");
  refused("", "is not an ONNX network");
  refused(whole.substr(0, whole.size() / 2), "is not an ONNX network");
  refused(model(message(1, node("Conv", {"a", "w"}, "b")) + message(5, weights("w", {1, 0, 0})) +
                message(11, value("a", {1, 3, 64, 96}))),
          "input 'a' is not 1x6xHEIGHTxWIDTH");
  refused(model(message(1, node("Nonsense", {"left", "right"}, "b")) + message(11, value("left", {1, 3, 64, 96})) +
                message(11, value("right", {1, 3, 64, 96})) + message(12, value("b", {1, 1, 64, 96}))),
          "OpenCV cannot run it");
  refused(model(message(1, node("Add", {"left", "right"}, "sum")) + message(11, value("left", {1, 3, 64, 96})) +
                message(11, value("right", {1, 3, 64, 96})) + message(12, value("sum", {1, 3, 64, 96}))),
          "does not return one number per pixel");
  expect_error(ErrorKind::bad_input, "missing.onnx", [&] { match(coded_pair(), with_model(folder / "missing.onnx")); });
  expect_error(ErrorKind::wrong_usage, "needs a model file", [&] { match(coded_pair(), with_model({})); });
}

TEST(NetworkInputs, SurviveEveryCutAndChange) {
  const std::string whole = two_inputs(96, 64);
  ASSERT_EQ(network_inputs(whole).size(), 2U);
  EXPECT_EQ(network_inputs(whole)[1].name, "right");
  EXPECT_EQ(network_inputs(whole)[1].sides, (std::vector<std::int64_t>{1, 3, 64, 96}));
  for (std::size_t size = 0; size < whole.size(); ++size) network_inputs(whole.substr(0, size));
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string changed = whole;
    changed[at] = static_cast<char>(0xff);
    network_inputs(changed);
  }
}

}  // namespace wheatstone::match_network_test
