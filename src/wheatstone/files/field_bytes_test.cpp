#include "wheatstone/files/field_bytes.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdint>

#include "throws_error.h"
#include "wheatstone/image/image.h"

namespace wheatstone::field_bytes_test {

struct Part {
  float x = 0;
  bool is_seen = false;
  std::optional<std::int64_t> number;
  friend bool operator==(const Part&, const Part&) = default;
};

struct Whole {
  std::string name;
  std::vector<std::vector<Part>> parts;
  std::array<double, 2> ends{};
  Image<Rgb8> picture;
  Part last;
  friend bool operator==(const Whole&, const Whole&) = default;
};

Whole example() {
  Whole whole{"a name", {{{1.5f, true, 7}, {}}, {}}, {0.1, -3}, Image<Rgb8>(3, 2, {1, 2, 3}), {-0.f, false, -1}};
  whole.picture(2, 1) = {9, 8, 7};
  return whole;
}

std::string bytes_of_fields(const auto& value) {
  FieldWriter writer;
  writer(value);
  return writer.bytes;
}

template <class Value>
Value read_fields(std::string_view bytes) {
  FieldReader reader(bytes, "damaged");
  Value value{};
  reader(value);
  reader.expect_end();
  return value;
}

TEST(FieldBytes, WhatWasWrittenIsReadBack) {
  EXPECT_EQ(read_fields<Whole>(bytes_of_fields(example())), example());
  EXPECT_EQ(read_fields<Whole>(bytes_of_fields(Whole())), Whole());
  EXPECT_TRUE(std::isnan(read_fields<float>(bytes_of_fields(std::nanf("")))));
  EXPECT_TRUE(std::signbit(read_fields<Whole>(bytes_of_fields(example())).last.x));
}

TEST(FieldBytes, ReadIntoWhatHeldSomethingNothingOfThatIsLeft) {
  Whole whole = example();
  const std::string bytes = bytes_of_fields(Whole());
  FieldReader reader(bytes, "damaged");
  reader(whole);
  EXPECT_EQ(whole, Whole());
}

TEST(FieldBytes, CutOrLongerTheyAreRefused) {
  const std::string bytes = bytes_of_fields(example());
  for (std::size_t size = 0; size < bytes.size(); ++size)
    expect_error(ErrorKind::bad_input, "damaged", [&] { read_fields<Whole>(bytes.substr(0, size)); });
  expect_error(ErrorKind::bad_input, "damaged", [&] { read_fields<Whole>(bytes + "x"); });
}

TEST(FieldBytes, CountsAreNotBelievedBeforeTheyAreChecked) {
  const std::string huge(8, '\x7f');
  expect_error(ErrorKind::bad_input, "damaged", [&] { read_fields<std::vector<float>>(huge); });
  expect_error(ErrorKind::bad_input, "damaged", [&] { read_fields<std::vector<Part>>(huge); });
  expect_error(ErrorKind::bad_input, "damaged", [&] { read_fields<Image<Rgb8>>(huge); });
  expect_error(ErrorKind::bad_input, "damaged", [&] { read_fields<bool>("\x02"); });
}

TEST(FieldBytes, LayoutsDifferInTheKindNumberAndOrderOfMembers) {
  struct One {
    float a;
    std::int32_t b;
  };
  struct Swapped {
    std::int32_t b;
    float a;
  };
  struct Unsigned {
    float a;
    std::uint32_t b;
  };
  struct Longer {
    float a;
    std::int32_t b, c;
  };
  EXPECT_NE(layout_of<One>(), layout_of<Swapped>());
  EXPECT_NE(layout_of<One>(), layout_of<Unsigned>());
  EXPECT_NE(layout_of<One>(), layout_of<Longer>());
  EXPECT_NE(layout_of<std::vector<One>>(), layout_of<One>());
  EXPECT_NE(layout_of<std::vector<One>>(), layout_of<std::optional<One>>());
}

}  // namespace wheatstone::field_bytes_test
