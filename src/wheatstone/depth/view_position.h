#pragma once

#include <compare>

namespace wheatstone {

/// Where a view is taken from, on the line through both eyes: in eye separations to the right of the point between
/// them. A type of its own, so that it is not mixed up with a disparity, a parallax or a distance between views. The
/// difference of two positions is a plain number, in eye separations.
class ViewPosition {
 public:
  constexpr ViewPosition() = default;  ///< the central view
  constexpr explicit ViewPosition(float eye_separations) : eye_separations_(eye_separations) {}
  constexpr explicit ViewPosition(double eye_separations) : eye_separations_(static_cast<float>(eye_separations)) {}

  /// To the right of the central view; negative to its left.
  constexpr float eye_separations() const { return eye_separations_; }

  friend constexpr float operator-(ViewPosition to, ViewPosition from) {
    return to.eye_separations_ - from.eye_separations_;
  }
  // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 sees a null pointer in what the compiler makes of this
  friend constexpr auto operator<=>(ViewPosition, ViewPosition) = default;

 private:
  float eye_separations_ = 0;
};

inline constexpr ViewPosition left_eye{-0.5f};
inline constexpr ViewPosition central_view{0.f};  ///< the cyclopean view, between the eyes
inline constexpr ViewPosition right_eye{0.5f};

/// View positions, both ends included; those of the eyes and between them unless told.
struct ViewRange {
  ViewPosition first = left_eye;
  ViewPosition last = right_eye;
  constexpr bool contains(ViewPosition view) const { return view >= first && view <= last; }
  friend bool operator==(const ViewRange&, const ViewRange&) = default;
};

/// From any view: what hides a mark that may be drawn everywhere are the surfaces before it.
inline constexpr ViewRange all_views{ViewPosition(-1e6f), ViewPosition(1e6f)};

}  // namespace wheatstone
