// What planning a painting again costs after one touch by hand, by the size of the brush, against planning it anew.

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "stopwatch.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/stereo/geometry_from_disparity.h"
#include "wheatstone/stereo/retouch.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::bench {
namespace {

/// A still life in a style, which is touched at a few places, one after the other.
class Touches {
 public:
  Touches(int width, int height)
      : still_(make_synthetic_still({.width = width, .height = height, .samples_a_side = 1})),
        geometry_(geometry_from_left(still_.geometry.left_disparity)),
        detail_(width, height, even_detail) {
    plan();
  }

  Painting anew() const { return plan_painting(still_.pictures, geometry_, style_, {}, widest_views, detail_); }
  Painting plan(ViewRange views = widest_views) {
    return plan_again(still_.pictures, geometry_, style_, fits_, {}, views, detail_);
  }

  void touch(Retouch kind, float radius_px) {
    const std::array<float, 2> places{std::fmod(0.618f * static_cast<float>(++count_), 1.f),
                                      std::fmod(0.755f * static_cast<float>(count_), 1.f)};
    const Touch touch{.kind = kind,
                      .x = places[0] * static_cast<float>(detail_.width()),
                      .y = places[1] * static_cast<float>(detail_.height()),
                      .radius_px = radius_px,
                      .amount = kind == Retouch::detail ? 60.f : 4.f};
    if (kind == Retouch::detail) {
      retouch_detail({&touch, 1}, detail_);
      return;
    }
    Image<float> disparity = geometry_.left_disparity;
    retouch_disparity({&touch, 1}, still_.pictures.left, disparity);
    geometry_ = geometry_from_left(std::move(disparity));
  }

 private:
  SyntheticStill still_;
  StereoGeometry geometry_;
  Image<std::uint8_t> detail_;
  Style style_ = style_by_name("oil");
  StrokeFits fits_;
  int count_ = 0;
};

struct Times {
  std::vector<double> wall_s, processor_s;

  template <class Call>
  void add(Call call) {
    const double before = processor_seconds();
    wall_s.push_back(seconds_of(call));
    processor_s.push_back(processor_seconds() - before);
  }
};

void print_rows(int width, int height) {
  Touches touches(width, height);
  const double anew_s = least_processor_seconds([&] { touches.anew(); });
  const double anew_wall_s = median_seconds([&] { touches.anew(); });
  fmt::print("oil, {}x{} an eye; planned anew for all views {:.2f} s ({:.2f} CPU s)\n", width, height, anew_wall_s,
             anew_s);
  fmt::print("                           for the eyes               then for all views\n");
  fmt::print("touch of    radius  area        s   CPU s   of anew       s   CPU s   of anew (CPU)\n");
  for (const auto& [kind, name] : {std::pair{Retouch::shift, "disparity"}, {Retouch::detail, "detail"}}) {
    for (const float radius_px : {8.f, 20.f, 50.f, 120.f, 300.f}) {
      Times of_eyes, of_all;
      for (int i = 0; i < 7; ++i) {
        touches.touch(kind, radius_px);
        of_eyes.add([&] { touches.plan(ViewRange{}); });
        of_all.add([&] { touches.plan(); });
      }
      constexpr float pi = 3.14159265f;
      const float area = pi * radius_px * radius_px / static_cast<float>(width * height);
      const double eyes_s = median(of_eyes.processor_s), all_s = median(of_all.processor_s);
      fmt::print("{:<10} {:4.0f} px  {:5.2f} %  {:5.3f}   {:5.3f}   {:.2f}      {:5.3f}   {:5.3f}   {:.2f}\n", name,
                 radius_px, 100 * area, median(of_eyes.wall_s), eyes_s, eyes_s / anew_s, median(of_all.wall_s), all_s,
                 all_s / anew_s);
    }
  }
}

}  // namespace
}  // namespace wheatstone::bench

int main() { wheatstone::bench::print_rows(1920, 1080); }
