#pragma once

// Tiny ONNX networks for tests, whose bytes are put together here (onnx.proto3).

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace wheatstone::tiny_network {

inline std::string varint(std::uint64_t value) {
  std::string bytes;
  for (; value >= 0x80; value >>= 7) bytes += static_cast<char>(value | 0x80);
  return bytes + static_cast<char>(value);
}

inline std::string number(int field, std::uint64_t value) {
  return varint(static_cast<std::uint64_t>(field) << 3) + varint(value);
}

inline std::string message(int field, const std::string& bytes) {
  return varint(static_cast<std::uint64_t>(field) << 3 | 2) + varint(bytes.size()) + bytes;
}

/// A ValueInfoProto: 32-bit floats of these sides.
inline std::string value(const std::string& name, const std::vector<int>& sides) {
  std::string shape;
  for (const int side : sides) shape += message(1, number(1, static_cast<std::uint64_t>(side)));
  return message(1, name) + message(2, message(1, number(1, 1) + message(2, shape)));
}

/// A TensorProto: the weights of a convolution of one pixel, to one channel or several, channel after channel.
inline std::string weights(const std::string& name, const std::vector<float>& values, std::size_t channels = 1) {
  std::string bytes =
      number(1, channels) + number(1, values.size() / channels) + number(1, 1) + number(1, 1) + number(2, 1);
  std::string raw(values.size() * sizeof(float), '\0');
  std::memcpy(raw.data(), values.data(), raw.size());
  return bytes + message(8, name) + message(9, raw);
}

/// An AttributeProto: a kernel of one pixel.
inline std::string one_pixel_kernel() {
  return message(5, message(1, "kernel_shape") + number(8, 1) + number(8, 1) + number(20, 7));
}

inline std::string node(const std::string& operation, const std::vector<std::string>& inputs,
                        const std::string& output) {
  std::string bytes;
  for (const std::string& input : inputs) bytes += message(1, input);
  bytes += message(2, output) + message(3, output) + message(4, operation);
  return operation == "Conv" ? bytes + one_pixel_kernel() : bytes;
}

inline std::string model(const std::string& graph) {
  return number(1, 7) + message(7, graph + message(2, "tiny")) + message(8, number(2, 11));
}

/// Answers with the red of one picture, as it goes in.
inline std::string red_of_one_picture(int width, int height) {
  return model(message(1, node("Conv", {"image", "of_image"}, "depth")) + message(5, weights("of_image", {1, 0, 0})) +
               message(11, value("image", {1, 3, height, width})) + message(12, value("depth", {1, 1, height, width})));
}

/// Answers with a flow of 0 between two pictures.
inline std::string no_flow_of_two_pictures(int width, int height) {
  const std::vector<float> nothing(6, 0.f);
  return model(message(1, node("Conv", {"first", "of_first"}, "a")) +
               message(1, node("Conv", {"second", "of_second"}, "b")) + message(1, node("Add", {"a", "b"}, "flow")) +
               message(5, weights("of_first", nothing, 2)) + message(5, weights("of_second", nothing, 2)) +
               message(11, value("first", {1, 3, height, width})) +
               message(11, value("second", {1, 3, height, width})) + message(12, value("flow", {1, 2, height, width})));
}

}  // namespace wheatstone::tiny_network
