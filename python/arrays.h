#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <algorithm>
#include <string>
#include <vector>

#include "wheatstone/image/shared_image.h"
#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone::python {

/// An array as it must lie in memory to be read in place.
template <class Value>
using Array = pybind11::array_t<Value, pybind11::array::c_style>;

/// A picture of height × width × 3 bytes, read in place: the array must live as long. Throws ValueError that names the
/// argument and the shape that was expected.
ImageView<const Rgb8> picture_in(const pybind11::object& given, const std::string& name);

/// The same for disparities, height × width numbers of single precision.
ImageView<const float> disparities_in(const pybind11::object& given, const std::string& name);

/// And for levels, height × width bytes.
ImageView<const std::uint8_t> levels_in(const pybind11::object& given, const std::string& name);

/// Two pictures, copied.
StereoPair pair_in(const pybind11::object& left, const pybind11::object& right);

/// Pictures of one size, from left to right, copied: an array of number × height × width × 3 bytes.
std::vector<Image<Rgb8>> views_in(const pybind11::object& given, const std::string& name);

/// What has real numbers as an array. Throws ValueError that names the argument.
pybind11::array real_numbers(const pybind11::object& given, const std::string& name, const std::string& expected);

/// One number a particle; empty for None. Throws ValueError where there are not `count`.
std::vector<float> column_of(const pybind11::object& given, std::size_t count, const std::string& name);

/// What was made, without copying: the array owns it.
pybind11::array array_of(Image<Rgb8> picture);
pybind11::array array_of(Image<float> numbers);
pybind11::array array_of(Image<std::uint8_t> mask);
/// Views of one size as number × height × width × 3.
pybind11::array array_of(const std::vector<Image<Rgb8>>& views);

}  // namespace wheatstone::python
