// How much of photographs their paintings keep, and how much paint that takes, beside what Im2Oil (Tong et al. 2022)
// made of three of them.
//
//     bench_paint_likeness [--style NAME_OR_FILE] [--only SUBJECT] [--pictures FOLDER] [--data FOLDER]
//
// A style with a budget of strokes is painted with half of it, with it and with twice as many; the budget is Im2Oil's
// number of strokes where that is known. Paintings are drawn three times as large as their photographs and reduced.
// FOLDER gets them, as SUBJECT_STYLE_STROKES.png.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "painting/subject.h"
#include "stopwatch.h"
#include "wheatstone/app/detail_map.h"
#include "wheatstone/calibration/prepare_pair.h"
#include "wheatstone/error.h"
#include "wheatstone/matching/match.h"
#include "wheatstone/measures/painting_likeness.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/painting/plan_painting.h"
#include "wheatstone/painting/present.h"
#include "wheatstone/painting/style_parameters.h"
#include "wheatstone/photograph/read_views.h"
#include "wheatstone/pictures/find_faces.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/stereo/geometry_from_disparity.h"
#include "wheatstone/stereo/picture_sizes.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::bench {
namespace {

/// What Im2Oil made of a photograph: how many strokes, in how many seconds of one processor.
struct Peer {
  std::string_view photograph;
  int strokes;
  double processor_s;
};
constexpr std::array peers{Peer{"A9", 4958, 74}, Peer{"L8", 5772, 81}, Peer{"P1", 3741, 54}};

const Peer* peer_of(std::string_view name) {
  for (const Peer& peer : peers)
    if (peer.photograph == name) return &peer;
  return nullptr;
}

struct Options {
  std::string style = "impressionist";
  std::string only;
  std::filesystem::path pictures, data = "../shared/data";
};

/// Throws Error{wrong_usage} for what it does not know.
Options options_from(int argument_count, char** arguments) {
  Options options;
  for (int i = 1; i < argument_count; i += 2) {
    const std::string_view name = arguments[i];
    const std::string value = i + 1 < argument_count ? arguments[i + 1] : "";
    if (name == "--style") {
      options.style = value;
    } else if (name == "--only") {
      options.only = value;
    } else if (name == "--pictures") {
      options.pictures = value;
    } else if (name == "--data") {
      options.data = value;
    } else {
      throw Error(ErrorKind::wrong_usage, fmt::format("{}: expected --style, --only, --pictures or --data", name));
    }
  }
  return options;
}

/// A photograph, and what its painting is planned from.
struct Photographed {
  std::string name;
  StereoPair pictures;                    ///< of one view, the right one is empty
  std::optional<Image<float>> disparity;  ///< where it is known
};

Photographed stereo_photograph(const std::filesystem::path& file) {
  ViewsFile read = read_views(file);
  PreparedPair prepared = prepare_pair({std::move(read.views[0]), std::move(read.views[1])});
  return {file.stem().string(), std::move(prepared.pictures), {}};
}

/// Portraits before a wood, reduced until their faces are 40 to 100 pixels wide in a picture of 1200: each portrait
/// several times, in rows from left to right.
Photographed small_faces(const std::filesystem::path& data) {
  const ViewsFile wood = read_views(data / "photographs" / "stereo_camera_sbs.jpg");
  Image<Rgb8> picture = reduced(wood.views.front(), {1200, 675});
  constexpr std::array face_widths_px{40.0, 52.0, 64.0, 76.0, 88.0, 100.0};
  constexpr std::array portraits{"P0", "P2", "P4"};
  int left = 0, top = 0, row_height = 0;
  for (std::size_t i = 0; i < 2 * face_widths_px.size(); ++i) {
    const Image<Rgb8> portrait =
        read_image(data / "paintings" / fmt::format("{}.jpg", portraits[i % portraits.size()]));
    const auto faces = find_faces(portrait);
    if (!faces || faces->empty()) continue;
    const double scale =
        std::min(face_widths_px[(i + i / portraits.size()) % face_widths_px.size()] / faces->front().width, 1.0);
    const PictureSize size{static_cast<int>(portrait.width() * scale), static_cast<int>(portrait.height() * scale)};
    if (left + size.width > picture.width()) {
      left = 0;
      top += row_height;
      row_height = 0;
    }
    if (top + size.height > picture.height()) continue;
    const Image<Rgb8> small = reduced(portrait, size);
    for (int y = 0; y < size.height; ++y)
      std::ranges::copy(small.row(y), picture.row(top + y).begin() + static_cast<std::ptrdiff_t>(left));
    left += size.width;
    row_height = std::max(row_height, size.height);
  }
  return {"small_faces", {std::move(picture), {}}, {}};
}

std::vector<Photographed> subjects(const Options& options) {
  std::vector<Photographed> all;
  const auto add = [&](const std::string& name, auto make) {
    if (options.only.empty() || options.only == name) all.push_back(make());
  };
  std::vector<std::filesystem::path> files;
  if (std::filesystem::exists(options.data / "paintings"))
    for (const auto& entry : std::filesystem::directory_iterator(options.data / "paintings"))
      if (entry.path().extension() == ".jpg" && !entry.path().stem().string().ends_with("-im2oil"))
        files.push_back(entry.path());
  std::ranges::sort(files);
  for (const std::filesystem::path& file : files)
    add(file.stem().string(), [&] { return Photographed{file.stem().string(), {read_image(file), {}}, {}}; });
  if (std::filesystem::exists(options.data / "photographs") && std::filesystem::exists(options.data / "paintings"))
    add("small_faces", [&] { return small_faces(options.data); });
  add("still", [] {
    SyntheticStill still = make_synthetic_still();
    return Photographed{"still", std::move(still.pictures), std::move(still.geometry.left_disparity)};
  });
  const auto add_subject = [&](const std::string& name, std::optional<float> scale) {
    const std::filesystem::path folder = options.data / "stereo" / name;
    if (!std::filesystem::exists(folder)) return;
    add(name, [&] {
      Subject subject = *read_subject(folder, scale);
      return Photographed{name, std::move(subject.photographs), std::move(subject.left_disparity)};
    });
  };
  add_subject("teddy", 4.f);
  add_subject("motorcycle", {});
  for (const char* file : {"lens_adapter.mpo", "stereo_camera_sbs.jpg"}) {
    const std::filesystem::path path = options.data / "photographs" / file;
    if (std::filesystem::exists(path)) add(path.stem().string(), [&] { return stereo_photograph(path); });
  }
  return all;
}

Painting plan(const Photographed& photograph, const Style& style, const std::optional<StereoGeometry>& geometry) {
  const Image<Rgb8>& picture = photograph.pictures.left;
  const StereoGeometry flat{.left_disparity = Image<float>(picture.width(), picture.height())};
  const Image<std::uint8_t> detail = reads_detail(style) ? detail_of_faces(picture) : Image<std::uint8_t>();
  if (!geometry) return plan_painting({picture, {}}, flat, style, {}, widest_views, detail);
  return plan_painting(photograph.pictures, *geometry, style, {}, widest_views, detail);
}

/// Of each stroke: radius, opacity, colour and disparity, and where its paint varies its number and the change of its
/// colour; of each of its points: place and disparity.
double numbers_a_stroke(const Painting& painting) {
  const auto* const of_strokes = std::get_if<StrokePainting>(&painting.marks);
  const double of_stroke = of_strokes != nullptr && of_strokes->brush != Brush{} ? 10 : 6;
  constexpr double of_point = 3;
  double numbers = 0, strokes = 0;
  for (const Layer& layer : layers_of(painting)) {
    numbers += of_stroke * static_cast<double>(layer.strokes.size());
    for (const Stroke& stroke : layer.strokes) numbers += of_point * stroke.point_count;
    strokes += static_cast<double>(count_strokes(layer));
  }
  return strokes > 0 ? numbers / strokes : 0;
}

void print_heads() {
  fmt::print("{:18} {:14} {:>8} {:>8} {:>6} {:>6} {:>6} {:>6} {:>7} {:>12} {:>7} {:>7}\n", "photograph", "painter",
             "strokes", "numbers", "gms", "detail", "lab", "grain", "streaks", "faces", "plan s", "draw s");
}

/// One line; what is not known is −.
void print_row(const Photographed& photograph, const std::string& painter, std::size_t strokes, double numbers,
               ImageView<const Rgb8> painted, const std::vector<PixelBox>& faces, double plan_s, double draw_s) {
  const PaintingLikeness m = measure_likeness(photograph.pictures.left, painted);
  const std::vector<double> of_faces = measure_faces(photograph.pictures.left, painted, faces);
  const auto or_dash = [](double value, std::string text) { return value > 0 ? std::move(text) : std::string("-"); };
  const double faces_mean = std::accumulate(of_faces.begin(), of_faces.end(), 0.0) /
                            static_cast<double>(std::max<std::size_t>(of_faces.size(), 1));
  fmt::print("{:18} {:14} {:8} {:>8} {:6.3f} {:6.3f} {:6.2f} {:6.3f} {:7.3f} {:>12} {:7.2f} {:>7}\n", photograph.name,
             painter, strokes, or_dash(numbers, fmt::format("{:.1f}", numbers)), m.gms, m.gms_detail, m.lab, m.grain,
             m.streaks, or_dash(faces_mean, fmt::format("{:.3f} ({})", faces_mean, of_faces.size())), plan_s,
             or_dash(draw_s, fmt::format("{:.2f}", draw_s)));
  std::fflush(stdout);
}

/// Paints with a style, measures, and gives the number of strokes.
std::size_t paint_and_print(const Photographed& photograph, const Style& style,
                            const std::optional<StereoGeometry>& geometry, const std::vector<PixelBox>& faces,
                            const Options& options) {
  constexpr double drawn_scale = 3;
  const double begin_s = processor_seconds();
  const Painting painting = plan(photograph, style, geometry);
  const double planned_s = processor_seconds();
  const ViewPosition view = geometry ? left_eye : central_view;
  const Presented shown = present(painting, {.views = {view}, .placement = {.scale = drawn_scale}});
  const double drawn_s = processor_seconds();
  const std::size_t strokes = count_marks(painting).count;
  print_row(photograph, style.name, strokes, numbers_a_stroke(painting), shown.views.front(), faces,
            planned_s - begin_s, drawn_s - planned_s);
  if (!options.pictures.empty())
    write_image(options.pictures / fmt::format("{}_{}_{}.png", photograph.name, style.name, strokes),
                shown.views.front());
  return strokes;
}

void measure(const Photographed& photograph, const Style& style, const Options& options) {
  const std::vector<PixelBox> faces = find_faces(photograph.pictures.left).value_or(std::vector<PixelBox>());
  const Peer* peer = peer_of(photograph.name);
  if (peer != nullptr)
    print_row(photograph, "Im2Oil", static_cast<std::size_t>(peer->strokes), 0,
              read_image(options.data / "paintings" / fmt::format("{}-im2oil.jpg", photograph.name)), faces,
              peer->processor_s, 0);
  std::optional<StereoGeometry> geometry;
  if (photograph.disparity) {
    geometry = geometry_from_left(*photograph.disparity);
  } else if (!photograph.pictures.right.empty()) {
    geometry = match(photograph.pictures).geometry;
  }
  const std::size_t painted = paint_and_print(photograph, style, geometry, faces, options);
  if (style.marks != Marks::fitted_strokes) return;
  const int whole = peer != nullptr ? peer->strokes : static_cast<int>(painted);
  for (const int strokes : {whole / 2, whole, 2 * whole}) {
    Style budgeted = style;
    budgeted.strokes = strokes;
    paint_and_print(photograph, budgeted, geometry, faces, options);
  }
}

}  // namespace
}  // namespace wheatstone::bench

int main(int argument_count, char** arguments) try {
  namespace bench = wheatstone::bench;
  const bench::Options options = bench::options_from(argument_count, arguments);
  const wheatstone::Style style = wheatstone::read_style(options.style);
  if (!options.pictures.empty()) std::filesystem::create_directories(options.pictures);
  fmt::print(
      "Likeness of photographs and their paintings, left eye, drawn at three times the size; numbers stored for a\n"
      "stroke, its points included; seconds of one processor, of Im2Oil for all.\n\n");
  bench::print_heads();
  for (const bench::Photographed& photograph : bench::subjects(options)) bench::measure(photograph, style, options);
  return 0;
} catch (const wheatstone::Error& error) {
  fmt::print(stderr, "bench_paint_likeness: {}\n", error.what());
  return static_cast<int>(error.kind());
}
