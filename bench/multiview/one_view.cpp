// One view of a snapshot, from the start of a process to the picture's file: processor time on one thread and memory,
// against the exact renderer of multiview/baseline on the same particles, read at once. Each is run in a process of its
// own, in turn, five times; the median counts.
//
//   bench_one_view [PARTICLES]

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "multiview/baseline/exact.h"
#include "wheatstone/app/render_particles.h"
#include "wheatstone/particles/cloud_source.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/synthetic/synthetic_universe.h"

namespace wheatstone::bench {
namespace {

namespace fs = std::filesystem;

/// What a process is told: what to do, with which snapshot, in which size; "make" with how many particles.
struct Task {
  std::string what, snapshot;
  int width = 0, height = 0;
};

void render(const Task& task) {
  RenderParticlesOptions options;
  options.width = task.width;
  options.height = task.height;
  options.views = 1;
  Image<Rgb8> picture(task.width, task.height);
  if (task.what == "baseline") {
    options.appearance.look = Look::thesis;
    const ReadyParticles ready = ready_particles(read_cloud(task.snapshot), task.snapshot, options);
    baseline::render_exact(ready.cloud, scene_of(ready.statistics, options), evenly_spaced(task.width, task.height, 1),
                           central_view, std::numeric_limits<float>::quiet_NaN(), picture);
  } else {
    picture = std::move(render_particles(task.snapshot, options).rendered.views.front());
  }
  write_image(task.snapshot + ".png", picture);
}

struct Cost {
  double seconds = 0, megabytes = 0;
};

Cost cost_of(const Task& task) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::execl("/proc/self/exe", "bench_one_view", task.what.c_str(), task.snapshot.c_str(),
            std::to_string(task.width).c_str(), std::to_string(task.height).c_str(), nullptr);
    ::_exit(127);
  }
  int status = 0;
  rusage usage{};
  if (::wait4(child, &status, 0, &usage) != child || status != 0) std::exit(1);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return {seconds(usage.ru_utime) + seconds(usage.ru_stime), static_cast<double>(usage.ru_maxrss) / 1024};
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

void compare(const std::string& snapshot, int width, int height, const char* memory_limit) {
  std::vector<double> ours, theirs, ratios, memory, memory_before;
  for (int round = 0; round < 5; ++round) {
    const Cost before = cost_of({"baseline", snapshot, width, height}), now = cost_of({"now", snapshot, width, height});
    theirs.push_back(before.seconds);
    ours.push_back(now.seconds);
    ratios.push_back(now.seconds / before.seconds);
    memory_before.push_back(before.megabytes);
    memory.push_back(now.megabytes);
  }
  fmt::print("{:>4}x{:<4} {:.3f} s, baseline {:.3f} s: {:.2f} of it (at most 0.70); {:.0f} MB{}, baseline {:.0f} MB\n",
             width, height, median(ours), median(theirs), median(ratios), median(memory), memory_limit,
             median(memory_before));
}

void run(std::uint64_t particles) {
  const fs::path snapshot = fs::temp_directory_path() / fmt::format("wheatstone_one_view_{}.hdf5", ::getpid());
  // Another process makes it, so that this one's memory is not the others'.
  cost_of({"make", snapshot.string(), static_cast<int>(particles), 0});
  fmt::print("One view of {} particles in a GADGET file, one thread, processor time\n", particles);
  compare(snapshot.string(), 640, 360, " (at most 150)");
  compare(snapshot.string(), 1920, 1080, "");
  fs::remove(snapshot);
  fs::remove(snapshot.string() + ".png");
}

}  // namespace
}  // namespace wheatstone::bench

int main(int argc, char** argv) {
  if (argc < 5) {
    wheatstone::bench::run(argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 2'654'562);
    return 0;
  }
  const wheatstone::bench::Task task{argv[1], argv[2], std::atoi(argv[3]), std::atoi(argv[4])};
  if (task.what == "make") {
    wheatstone::write_synthetic_universe(task.snapshot, {.particles = static_cast<std::uint64_t>(task.width)});
    return 0;
  }
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  wheatstone::bench::render(task);
}
