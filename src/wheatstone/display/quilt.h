#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// How the views of a light-field display lie in one picture: rows upwards from the bottom left, the leftmost view
/// first.
struct QuiltLayout {
  int columns = 8;
  int rows = 6;
};

/// Throws Error{wrong_usage} where there are not as many views as places, or they are of different sizes.
Image<Rgb8> make_quilt(std::span<const Image<Rgb8>> views, const QuiltLayout& layout);

/// Puts one view, counted from the leftmost, 0, into a quilt whose other places stay as they are. Throws
/// Error{wrong_usage} where it has no place there.
void put_into_quilt(ImageView<const Rgb8> view, int number, const QuiltLayout& layout, ImageView<Rgb8> quilt);

/// The views of a quilt, leftmost first. Throws Error{wrong_usage} where its size is no multiple of the layout's.
std::vector<Image<Rgb8>> views_of_quilt(ImageView<const Rgb8> quilt, const QuiltLayout& layout);

/// The name by which the display's own software knows the layout: "gas_qs8x6a0.75.png" for the stem "gas", of an aspect
/// (width over height of a view) of 0.75.
std::string quilt_name(const std::string& stem, const QuiltLayout& layout, double aspect);

/// What a quilt's name says of it.
struct NamedQuilt {
  QuiltLayout layout;
  double aspect = 0;
};

/// Of a file name that ends as quilt_name makes it, whatever its ending; nothing of any other.
std::optional<NamedQuilt> quilt_of_name(const std::string& file_name);

}  // namespace wheatstone
