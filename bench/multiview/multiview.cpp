// Particles to N views: the figures and tables of Hassaine 2010, ch. 5, again, and ours beside them. "Exact" is the
// exact renderer, which draws each view on its own; its time is compared with a copy of memory and with a naive loop.
//
//   bench_multiview [THREADS]

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <optional>

#include "stopwatch.h"
#include "wheatstone/measures/view_measures.h"
#include "wheatstone/multiview/naive_view.h"
#include "wheatstone/multiview/render.h"
#include "wheatstone/multiview/renderers_internal.h"
#include "wheatstone/synthetic/synthetic_universe.h"

namespace wheatstone::bench {
namespace {

constexpr int planes_of_display = 36;

/// Every so many of a cloud's particles.
Cloud thinned(const Cloud& cloud, std::size_t count) {
  Cloud some;
  some.box_size = cloud.box_size;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t from = i * cloud.size() / count;
    some.x.push_back(cloud.x[from]);
    some.y.push_back(cloud.y[from]);
    some.z.push_back(cloud.z[from]);
    some.density.push_back(cloud.density[from]);
    some.temperature.push_back(cloud.temperature[from]);
  }
  return some;
}

/// A cloud on the nine-view display of the thesis: views of 640×360, ±10 cm in 36 planes.
struct Stage {
  Cloud cloud;
  CloudStatistics statistics;
  Scene scene;
  Rig rig;
  float exposure = 1;

  Stage(Cloud particles, int views, float smallest, float largest) : cloud(std::move(particles)) {
    statistics.add(cloud);
    rig = evenly_spaced(640, 360, views);
    scene.camera = camera_around(statistics.centre(), statistics.radius(), rig.width, rig.height, {.zoom = 1.25f});
    float depth = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      depth += (statistics.centre()[axis] - scene.camera.position[axis]) * scene.camera.forward[axis];
    scene.mapping.points = {{depth - statistics.radius(), -20.f}, {depth + statistics.radius(), 15.f}};
    scene.splat_style =
        make_splat_style({.look = Look::thesis, .smallest_px = smallest, .largest_px = largest}, statistics);
    scene.splat_style.size_depth = depth;
    exposure = automatic_exposure(cloud, scene, rig);
  }
};

/// Seconds of the ways to render a stage.
struct Times {
  double one_exact = 0, exact = 0, incremental = 0, stage_1 = 0, layered = 0;
};

struct Canvases {
  std::vector<Image<Rgb8>> images;
  std::vector<ImageView<Rgb8>> views;
  explicit Canvases(const Rig& rig)
      : images(rig.positions.size(), Image<Rgb8>(rig.width, rig.height)), views(images.begin(), images.end()) {}
};

ToneMap tone_of(const Stage& stage) { return ToneMap(ToneSettings{.exposure = stage.exposure}); }

Times measure(const Stage& stage, SliceFilter filter, int planes = planes_of_display, bool incremental = true) {
  const ToneMap tone = tone_of(stage);
  const Chunks chunks = chunks_of(stage.cloud);
  const RenderJob job{chunks, stage.scene, stage.rig, stage.statistics, tone};
  const DepthPlanes depth_planes = planes_of(stage.scene.mapping, planes);
  Canvases canvases(stage.rig);
  Times times;
  // In turn, so that a slower moment of the machine falls on all alike.
  std::vector<double> all[4];
  for (int round = 0; round < 5; ++round) {
    const auto time = [&](int which, const std::function<void()>& call) {
      const auto start = std::chrono::steady_clock::now();
      call();
      all[which].push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    };
    time(0, [&] { render_exact(job, stage.rig.positions, canvases.views); });
    if (incremental) time(1, [&] { render_incremental(job, canvases.views); });
    time(2, [&] { render_layered(job, depth_planes, filter, {}); });
    time(3, [&] { render_layered(job, depth_planes, filter, canvases.views); });
  }
  const auto median = [](std::vector<double>& values) {
    if (values.empty()) return 0.;
    std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
    return values[values.size() / 2];
  };
  times.exact = median(all[0]);
  times.one_exact = times.exact / static_cast<double>(stage.rig.positions.size());
  times.incremental = median(all[1]);
  times.stage_1 = median(all[2]);
  times.layered = median(all[3]);
  return times;
}

/// Seconds of one view and of stage 1 on the thesis's graphics card.
struct Published {
  std::size_t particles;
  double one_exact, stage_1;
};
constexpr Published table_5_1[] = {{33182, 0.0028, 0.0064},  {66364, 0.0054, 0.0095},  {132728, 0.0104, 0.0161},
                                   {265456, 0.0203, 0.029},  {530912, 0.0401, 0.0548}, {1327281, 0.0997, 0.1312},
                                   {2654562, 0.1985, 0.2569}};
constexpr Published table_5_3[] = {{33182, 0.0038, 0.01038}, {66364, 0.0078, 0.0244},  {132728, 0.0163, 0.0551},
                                   {265456, 0.0337, 0.1239}, {530912, 0.0693, 0.2688}, {1327281, 0.1787, 0.6949},
                                   {2654562, 0.3647, 1.3931}};
constexpr double published_stage_2 = 0.018;  // nine views of 36 slices

void print_figure(const char* title, const Cloud& universe, std::span<const Published> published, float smallest,
                  float largest) {
  fmt::print("\n{}\n{:>9} | {:>9} {:>11} {:>8} {:>8} {:>8} | {:>8} {:>8} {:>7} | thesis: layered stage 1\n", title,
             "particles", "exact x9", "incremental", "stage 1", "stage 2", "layered", "exact/", "exact/", "stage 1/");
  fmt::print("{:>9} | {:>9} {:>11} {:>8} {:>8} {:>8} | {:>8} {:>8} {:>7} |\n", "", "ms", "ms", "ms", "ms", "ms",
             "increm.", "layered", "1 view");
  for (const Published& row : published) {
    const Stage stage(thinned(universe, row.particles), 9, smallest, largest);
    const Times t = measure(stage, SliceFilter::linear);
    fmt::print(
        "{:>9} | {:>9.1f} {:>11.1f} {:>8.1f} {:>8.1f} {:>8.1f} | {:>8.2f} {:>8.2f} {:>7.2f} | {:>15.2f} {:>7.2f}\n",
        row.particles, 1e3 * t.exact, 1e3 * t.incremental, 1e3 * t.stage_1, 1e3 * (t.layered - t.stage_1),
        1e3 * t.layered, t.exact / t.incremental, t.exact / t.layered, t.stage_1 / t.one_exact,
        9 * row.one_exact / (row.stage_1 + published_stage_2), row.stage_1 / row.one_exact);
  }
}

void print_table_5_2(const Cloud& universe) {
  constexpr std::pair<int, double> published[] = {{4, 0.0007},  {16, 0.0012},  {36, 0.002},
                                                  {64, 0.0034}, {100, 0.0053}, {144, 0.0076}};
  const Stage stage(thinned(universe, 265456), 9, 2, 6);
  fmt::print("\nTable 5.2: compositing one view, by slices\n{:>6} | {:>9} {:>14} | thesis: ms\n", "slices", "ms",
             "us a slice");
  for (const auto& [planes, seconds] : published) {
    const Times t = measure(stage, SliceFilter::linear, planes, false);
    const double a_view = (t.layered - t.stage_1) / 9;
    fmt::print("{:>6} | {:>9.3f} {:>14.2f} | {:.1f}\n", planes, 1e3 * a_view, 1e6 * a_view / planes, 1e3 * seconds);
  }
}

void print_table_5_4(const Stage& stage) {
  constexpr int published[][2] = {{438, 2984},    {25962, 8442},  {27844, 9676},  {25057, 11268}, {30786, 13342},
                                  {26279, 15763}, {29253, 18236}, {29261, 20640}, {19193, 21744}};
  const auto views_with = [&](Method method, SliceFilter filter) {
    return render(stage.cloud, stage.scene, stage.rig,
                  {.method = method, .filter = filter, .planes = planes_of_display, .exposure = stage.exposure})
        .views;
  };
  const auto exact = views_with(Method::exact, SliceFilter::linear);
  const std::vector<Image<Rgb8>> others[] = {
      views_with(Method::layered, SliceFilter::nearest), views_with(Method::layered, SliceFilter::linear),
      views_with(Method::layered, SliceFilter::centroid), views_with(Method::incremental, SliceFilter::linear)};
  fmt::print("\nTable 5.4: against exact; PSNR in dB, pixels that differ by more than 4 of 255\n");
  fmt::print("view | {:>16} | {:>16} | {:>16} | {:>16} | thesis: nearest, linear\n", "nearest", "linear", "centroid",
             "incremental");
  for (std::size_t v = 0; v < exact.size(); ++v) {
    fmt::print("{:>4} |", v);
    for (const auto& views : others) {
      const ViewMeasures measures = measure_view(views[v], exact[v]);
      fmt::print(" {:>8.1f} {:>7} |", measures.psnr_db, measures.differing_pixels);
    }
    fmt::print(" {:>7} {:>7}\n", published[v][0], published[v][1]);
  }
}

void print_filters(const Stage& stage) {
  fmt::print("\nFilters, {} particles, nine views\n", stage.cloud.size());
  for (const auto& [name, filter] :
       {std::pair{"nearest", SliceFilter::nearest}, std::pair{"linear", SliceFilter::linear},
        std::pair{"centroid", SliceFilter::centroid}}) {
    const Times t = measure(stage, filter, planes_of_display, false);
    fmt::print("  {:<9} exact/layered {:.2f}, stage 1 / one view {:.2f}\n", name, t.exact / t.layered,
               t.stage_1 / t.one_exact);
  }
}

void print_break_even(const Cloud& universe) {
  fmt::print("\nBreak-even of layered with exact, nine views (limit 10000 particles, thesis 32000)\n");
  for (const std::size_t count : {2000, 5000, 10000, 20000, 33182}) {
    const Times t = measure(Stage(thinned(universe, count), 9, 2, 6), SliceFilter::linear, planes_of_display, false);
    fmt::print("  {:>6} particles: exact/layered {:.2f}\n", count, t.exact / t.layered);
  }
}

void print_many_regions(const Stage& stage) {
  const ToneMap tone = tone_of(stage);
  const Chunks chunks = chunks_of(stage.cloud);
  Canvases canvases(stage.rig);
  const auto seconds_with = [&](const DepthMapping& mapping) {
    Scene scene = stage.scene;
    scene.mapping = mapping;
    const RenderJob job{chunks, scene, stage.rig, stage.statistics, tone};
    const DepthPlanes planes = planes_of(mapping, planes_of_display);
    return median_seconds([&] { render_layered(job, planes, SliceFilter::linear, canvases.views); }, 3);
  };
  const DepthMapping single = stage.scene.mapping;
  const float first = single.points.front().depth;
  const float last = single.points.back().depth;
  const auto at = [&](float share) { return first + share * (last - first); };
  const DepthMapping many{
      {{first, -20}, {at(0.3f), -15}, {at(0.45f), -10}, {at(0.55f), 8}, {at(0.7f), 11}, {last, 15}}};
  std::vector<double> ratios;
  for (int round = 0; round < 9; ++round) {
    const double of_single = seconds_with(single);
    ratios.push_back(seconds_with(many) / of_single);
  }
  std::ranges::sort(ratios);
  fmt::print("\nFive regions / one region, layered: {:.3f} (limit 1.02; {:.3f} to {:.3f} in nine rounds)\n",
             ratios[ratios.size() / 2], ratios.front(), ratios.back());
}

void print_exact(const Stage& stage) {
  const ToneMap tone = tone_of(stage);
  const Chunks chunks = chunks_of(stage.cloud);
  const RenderJob job{chunks, stage.scene, stage.rig, stage.statistics, tone};
  Image<Rgb8> picture(stage.rig.width, stage.rig.height);
  const std::array<ViewPosition, 1> view{central_view};
  const std::array<ImageView<Rgb8>, 1> pictures{picture};
  const auto start = std::chrono::steady_clock::now();
  const double before = processor_seconds();
  for (int i = 0; i < 10; ++i) render_exact(job, view, pictures);
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const double cores = (processor_seconds() - before) / wall;
  const double naive =
      median_seconds([&] { naive_view(stage.cloud, stage.scene, stage.rig, central_view, stage.exposure); }, 1);
  // What must be read of the particles: five columns.
  const double copy = copy_seconds(5 * sizeof(float) * stage.cloud.size());
  fmt::print(
      "\nExact: {:.1f} ms a view, {:.2f} cores (at least 1.8 of 2), {:.1f} x the naive loop (at least 4); {:.1f} "
      "copies of "
      "the particles in memory by one thread, of {:.1f} ms each\n",
      1e2 * wall, cores, naive / (wall / 10), wall / 10 / copy, 1e3 * copy);
}

constexpr std::array<Method, 3> methods{Method::exact, Method::incremental, Method::layered};

/// Processor seconds of the three methods, medians of rounds in which they take turns.
std::array<double, 3> seconds_by_method(const Stage& stage, int rounds) {
  std::array<std::vector<double>, 3> all;
  for (int round = 0; round < rounds; ++round)
    for (std::size_t m = 0; m < methods.size(); ++m) {
      const double before = processor_seconds();
      render(stage.cloud, stage.scene, stage.rig,
             {.method = methods[m], .planes = planes_of_display, .exposure = stage.exposure});
      all[m].push_back(processor_seconds() - before);
    }
  std::array<double, 3> seconds{};
  for (std::size_t m = 0; m < methods.size(); ++m) {
    std::ranges::sort(all[m]);
    seconds[m] = all[m][all[m].size() / 2];
  }
  return seconds;
}

void print_targets(const Cloud& universe, const Stage& nine) {
  const Times t = measure(nine, SliceFilter::linear);
  fmt::print("\nTargets, {} particles, 36 planes, filter linear\n", universe.size());
  fmt::print(
      "  9 views: exact/layered {:.2f} (at least 6; thesis 6.5), stage 1 / one view {:.2f} (at most 1.15; thesis "
      "1.29)\n",
      t.exact / t.layered, t.stage_1 / t.one_exact);
  fmt::print("  9 views: exact/incremental {:.2f} (thesis, on paper, 2.8), {:.0f} ns of a thread a splat and view\n",
             t.exact / t.incremental,
             1e9 * seconds_by_method(nine, 3)[1] / (9. * static_cast<double>(universe.size())));
  const Times many = measure(Stage(universe, 45, 2, 6), SliceFilter::linear, planes_of_display, false);
  fmt::print("  45 views: exact/layered {:.2f} (at least 24)\n", many.exact / many.layered);
  const Times large = measure(Stage(universe, 9, 8, 24), SliceFilter::linear, planes_of_display, false);
  fmt::print(
      "  9 views, splats of 8 to 24 px: exact/layered {:.2f} (at least 5), stage 1 / one view {:.2f} (at most 1.3; "
      "thesis 3.8)\n",
      large.exact / large.layered, large.stage_1 / large.one_exact);
}

void print_choices(const Cloud& universe) {
  constexpr std::array<const char*, 3> names{"exact", "incremental", "layered"};
  fmt::print("\nWhat auto chooses, by processor time (best/auto at least .98, exact/incremental at least .98)\n");
  fmt::print("{:>9} {:>5} {:>8} | {:>8} {:>8} {:>8} | {:>8} | {:>9} auto\n", "particles", "views", "splats", "exact",
             "increm.", "layered", "exact/", "best/auto");
  fmt::print("{:>9} {:>5} {:>8} | {:>8} {:>8} {:>8} | {:>8} |\n", "", "", "px", "ms", "ms", "ms", "increm.");
  double least_auto = 1, least_incremental = 1;
  for (const auto& [smallest, largest] : {std::pair{2.f, 6.f}, std::pair{8.f, 24.f}})
    for (const int views : {2, 9, 45})
      for (const std::size_t count : {2000, 10000, 33182, 132728, 530912}) {
        const Stage stage(thinned(universe, count), views, smallest, largest);
        const auto splats = count * static_cast<std::size_t>(views);
        const std::array<double, 3> seconds = seconds_by_method(stage, splats < 1'000'000 ? 15 : 3);
        const Method chosen =
            render(stage.cloud, stage.scene, stage.rig, {.planes = planes_of_display, .exposure = stage.exposure})
                .method;
        const auto at = static_cast<std::size_t>(std::ranges::find(methods, chosen) - methods.begin());
        const double of_best = *std::ranges::min_element(seconds) / seconds[at];
        least_auto = std::min(least_auto, of_best);
        least_incremental = std::min(least_incremental, seconds[0] / seconds[1]);
        fmt::print("{:>9} {:>5} {:>2.0f} to {:>2.0f} | {:>8.1f} {:>8.1f} {:>8.1f} | {:>8.2f} | {:>9.2f} {}\n", count,
                   views, smallest, largest, 1e3 * seconds[0], 1e3 * seconds[1], 1e3 * seconds[2],
                   seconds[0] / seconds[1], of_best, names[at]);
      }
  fmt::print("  at least: best/auto {:.2f}, exact/incremental {:.2f}\n", least_auto, least_incremental);
}

void run() {
  const Cloud universe = make_synthetic_universe({});
  const Stage nine(universe, 9, 2, 6);
  print_targets(universe, nine);
  print_exact(nine);
  print_choices(universe);
  print_break_even(universe);
  print_many_regions(nine);
  print_filters(nine);
  print_table_5_4(nine);
  print_table_5_2(universe);
  print_figure("Figure 5.10 and table 5.1: nine views, splats of 2 to 6 px", universe, table_5_1, 2, 6);
  print_figure("Figure 5.11 and table 5.3: nine views, splats of 8 to 24 px", universe, table_5_3, 8, 24);
}

}  // namespace
}  // namespace wheatstone::bench

int main(int argc, char** argv) {
  std::optional<tbb::global_control> limit;
  if (argc > 1) limit.emplace(tbb::global_control::max_allowed_parallelism, std::max(std::atoi(argv[1]), 1));
  wheatstone::bench::run();
}
