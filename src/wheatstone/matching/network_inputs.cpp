#include <algorithm>
#include <opencv2/dnn.hpp>
#include <optional>
#include <set>

#include "wheatstone/matching/network_inputs_internal.h"

// ONNX files are protocol buffers (onnx.proto3): fields of a number and a wire type, one behind the other, messages
// within messages. Only what names the graph's inputs is read.

namespace wheatstone {
namespace {

/// A field as it stands: `number` of it, and its bytes or its value.
struct Field {
  std::uint64_t number = 0;
  std::uint64_t value = 0;
  std::string_view bytes;
};

std::optional<std::uint64_t> take_varint(std::string_view& rest) {
  std::uint64_t value = 0;
  for (int shift = 0; shift < 64; shift += 7) {
    if (rest.empty()) return {};
    const auto byte = static_cast<std::uint8_t>(rest.front());
    rest.remove_prefix(1);
    value |= static_cast<std::uint64_t>(byte & 0x7f) << shift;
    if (byte < 0x80) return value;
  }
  return {};
}

std::optional<Field> take_field(std::string_view& rest) {
  const auto key = take_varint(rest);
  if (!key || *key >> 3 == 0) return {};
  Field field{*key >> 3};
  const auto take_bytes = [&](std::uint64_t count) {
    if (count > rest.size()) return false;
    field.bytes = rest.substr(0, count);
    rest.remove_prefix(count);
    return true;
  };
  enum WireType : std::uint64_t { varint = 0, eight_bytes = 1, length_delimited = 2, four_bytes = 5 };
  switch (*key & 7) {
    case varint:
      if (const auto value = take_varint(rest)) return Field{field.number, *value};
      return {};
    case eight_bytes:
      return take_bytes(8) ? std::optional(field) : std::nullopt;
    case four_bytes:
      return take_bytes(4) ? std::optional(field) : std::nullopt;
    case length_delimited:
      if (const auto count = take_varint(rest); count && take_bytes(*count)) return field;
      return {};
    default:
      return {};
  }
}

/// All fields of a message; none where one of them is damaged.
std::optional<std::vector<Field>> fields_of(std::string_view message) {
  std::vector<Field> fields;
  while (!message.empty()) {
    const auto field = take_field(message);
    if (!field) return {};
    fields.push_back(*field);
  }
  return fields;
}

/// The bytes of the fields of this number, of a message that may be damaged.
std::vector<std::string_view> parts(std::string_view message, std::uint64_t number) {
  std::vector<std::string_view> found;
  for (const Field& field : fields_of(message).value_or(std::vector<Field>{}))
    if (field.number == number) found.push_back(field.bytes);
  return found;
}

/// ValueInfoProto: name = 1, type = 2; TypeProto: tensor_type = 1; its shape = 2; dim = 1; dim_value = 1.
NetworkInput input_from(std::string_view message) {
  NetworkInput input;
  for (const std::string_view name : parts(message, 1)) input.name = name;
  for (const std::string_view type : parts(message, 2))
    for (const std::string_view tensor : parts(type, 1))
      for (const std::string_view shape : parts(tensor, 2))
        for (const std::string_view side : parts(shape, 1)) {
          input.sides.push_back(0);
          for (const Field& field : fields_of(side).value_or(std::vector<Field>{}))
            if (field.number == 1) input.sides.back() = static_cast<std::int64_t>(field.value);
        }
  return input;
}

}  // namespace

std::vector<NetworkInput> network_inputs(std::string_view bytes) {
  // ModelProto: graph = 7; GraphProto: node = 1, initializer = 5 (TensorProto: name = 8), input = 11.
  const auto model = fields_of(bytes);
  if (!model) return {};
  std::vector<NetworkInput> inputs;
  for (const Field& field : *model) {
    if (field.number != 7 || parts(field.bytes, 1).empty()) continue;
    std::set<std::string_view> weights;
    for (const std::string_view tensor : parts(field.bytes, 5))
      for (const std::string_view name : parts(tensor, 8)) weights.insert(name);
    for (const std::string_view message : parts(field.bytes, 11)) {
      NetworkInput input = input_from(message);
      if (!weights.contains(input.name)) inputs.push_back(std::move(input));
    }
  }
  return inputs;
}

cv::Mat network_picture(const cv::Mat& picture, NetworkValues values) {
  cv::Mat numbers;
  picture.convertTo(numbers, CV_32FC3, values == NetworkValues::to_255 ? 1 : 1 / 255.0);
  if (values == NetworkValues::imagenet) {
    cv::subtract(numbers, cv::Scalar(0.485, 0.456, 0.406), numbers);
    cv::divide(numbers, cv::Scalar(0.229, 0.224, 0.225), numbers);
  }
  return cv::dnn::blobFromImage(numbers);
}

}  // namespace wheatstone
