#include "arrays.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string_view>

namespace wheatstone::python {
namespace {

namespace py = pybind11;

[[noreturn]] void refuse(const py::object& given, const std::string& name, const std::string& expected) {
  std::string what = py::str(py::type::of(given).attr("__name__"));
  if (py::isinstance<py::array>(given)) {
    const auto array = py::cast<py::array>(given);
    const std::vector<py::ssize_t> shape(array.shape(), array.shape() + array.ndim());
    what = fmt::format("an array of {} and shape ({})", std::string(py::str(array.dtype())), fmt::join(shape, ", "));
  }
  throw py::value_error(fmt::format("{} is {}, expected {}", name, what, expected));
}

/// A mask would be lost, and an array without elements is no picture.
void refuse_mask_and_nothing(const py::object& given, const std::string& name, const std::string& expected) {
  if (py::isinstance(given, py::module_::import("numpy").attr("ma").attr("MaskedArray")))
    throw py::value_error(fmt::format("{} is a masked array, expected {}", name, expected));
  if (py::isinstance<py::array>(given) && py::cast<py::array>(given).size() == 0) refuse(given, name, expected);
}

/// Copies of many views take their time.
void let_signals_end() {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

/// An array that owns a picture; its numbers are those of the picture's pixels.
template <class Number, class Pixel>
py::array owning(Image<Pixel> image, const std::vector<py::ssize_t>& shape) {
  auto owned = std::make_unique<Image<Pixel>>(std::move(image));
  const auto* const data = reinterpret_cast<const Number*>(owned->pixels().data());
  const py::capsule owner(owned.get(), [](void* kept) { delete static_cast<Image<Pixel>*>(kept); });
  static_cast<void>(owned.release());
  return py::array_t<Number>(shape, data, owner);
}

}  // namespace

ImageView<const Rgb8> picture_in(const py::object& given, const std::string& name) {
  const std::string expected = "an array of uint8 and shape (height, width, 3), without gaps in memory";
  refuse_mask_and_nothing(given, name, expected);
  if (!py::isinstance<Array<std::uint8_t>>(given)) refuse(given, name, expected);
  const auto array = py::cast<Array<std::uint8_t>>(given);
  if (array.ndim() != 3 || array.shape(2) != 3) refuse(given, name, expected);
  const auto width = static_cast<int>(array.shape(1));
  return {reinterpret_cast<const Rgb8*>(array.data()), width, static_cast<int>(array.shape(0)), width};
}

template <class Number>
ImageView<const Number> plane_in(const py::object& given, const std::string& name, const std::string& numbers) {
  const std::string expected = "an array of " + numbers + " and shape (height, width), without gaps in memory";
  refuse_mask_and_nothing(given, name, expected);
  if (!py::isinstance<Array<Number>>(given)) refuse(given, name, expected);
  const auto array = py::cast<Array<Number>>(given);
  if (array.ndim() != 2 || array.size() == 0) refuse(given, name, expected);
  const auto width = static_cast<int>(array.shape(1));
  return {array.data(), width, static_cast<int>(array.shape(0)), width};
}

ImageView<const float> disparities_in(const py::object& given, const std::string& name) {
  return plane_in<float>(given, name, "float32");
}

ImageView<const std::uint8_t> levels_in(const py::object& given, const std::string& name) {
  return plane_in<std::uint8_t>(given, name, "uint8");
}

py::array real_numbers(const py::object& given, const std::string& name, const std::string& expected) {
  auto array = py::array::ensure(given);
  PyErr_Clear();
  if (!array) refuse(given, name, expected);
  refuse_mask_and_nothing(given, name, expected);
  constexpr std::string_view real_kinds = "biuf";
  if (real_kinds.find(array.dtype().kind()) == std::string_view::npos) refuse(array, name, expected);
  return array;
}

StereoPair pair_in(const py::object& left, const py::object& right) {
  return {copy_of(picture_in(left, "left")), copy_of(picture_in(right, "right"))};
}

std::vector<Image<Rgb8>> views_in(const py::object& given, const std::string& name) {
  const std::string expected = "an array of uint8 and shape (number, height, width, 3), without gaps in memory";
  refuse_mask_and_nothing(given, name, expected);
  if (!py::isinstance<Array<std::uint8_t>>(given)) refuse(given, name, expected);
  const auto array = py::cast<Array<std::uint8_t>>(given);
  if (array.ndim() != 4 || array.shape(3) != 3) refuse(given, name, expected);
  std::vector<Image<Rgb8>> views;
  for (const py::handle view : array) {
    let_signals_end();
    views.push_back(copy_of(picture_in(py::reinterpret_borrow<py::object>(view), name)));
  }
  return views;
}

std::vector<float> column_of(const py::object& given, std::size_t count, const std::string& name) {
  if (given.is_none()) return {};
  const std::string expected = fmt::format("{} numbers, one a particle", count);
  const auto array =
      py::cast<py::array_t<float, py::array::c_style | py::array::forcecast>>(real_numbers(given, name, expected));
  if (array.ndim() != 1 || static_cast<std::size_t>(array.shape(0)) != count) refuse(given, name, expected);
  std::vector<float> column(array.data(), array.data() + count);
  if (std::ranges::any_of(column, [](float number) { return std::isinf(number); }))
    throw py::value_error(name + " has numbers beyond single precision, expected them in a larger unit");
  return column;
}

py::array array_of(Image<Rgb8> picture) {
  const std::vector<py::ssize_t> shape{picture.height(), picture.width(), 3};
  return owning<std::uint8_t>(std::move(picture), shape);
}

py::array array_of(Image<float> numbers) {
  const std::vector<py::ssize_t> shape{numbers.height(), numbers.width()};
  return owning<float>(std::move(numbers), shape);
}

py::array array_of(Image<std::uint8_t> mask) {
  const std::vector<py::ssize_t> shape{mask.height(), mask.width()};
  return owning<std::uint8_t>(std::move(mask), shape);
}

py::array array_of(const std::vector<Image<Rgb8>>& views) {
  const py::ssize_t count = static_cast<py::ssize_t>(views.size());
  const py::ssize_t height = views.empty() ? 0 : views.front().height(),
                    width = views.empty() ? 0 : views.front().width();
  py::array_t<std::uint8_t> array({count, height, width, py::ssize_t{3}});
  auto* to = reinterpret_cast<Rgb8*>(array.mutable_data());
  for (const Image<Rgb8>& view : views) {
    let_signals_end();
    to = std::ranges::copy(view.pixels(), to).out;
  }
  return array;
}

}  // namespace wheatstone::python
