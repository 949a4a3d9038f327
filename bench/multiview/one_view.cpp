// One view of a snapshot, from the start of a process to the picture's file: processor time on one thread and memory.
// Beside it: the exact renderer on the same particles, which are read at once; a copy of the file's bytes in memory;
// and a column density by yt, where python3-yt is installed. Each is run in a process of its own, in turn, five times;
// the median counts.
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
#include <string>
#include <vector>

#include "stopwatch.h"
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
  if (task.what == "exact") {
    const ReadyParticles ready = ready_particles(read_cloud(task.snapshot), task.snapshot, options);
    const Rig rig = evenly_spaced(task.width, task.height, 1);
    write_image(task.snapshot + ".png",
                wheatstone::render(ready.cloud, scene_of(ready.statistics, options), rig, {.method = Method::exact})
                    .views.front());
    return;
  }
  write_image(task.snapshot + ".png", render_particles(task.snapshot, options).rendered.views.front());
}

struct Cost {
  double seconds = 0, megabytes = 0;
};

Cost cost_of(const Task& task) {
  const pid_t child = ::fork();
  if (child == 0) {
    const std::string width = std::to_string(task.width), height = std::to_string(task.height);
    if (task.what == "yt")
      ::execl("/usr/bin/python3", "python3", WHEATSTONE_ONE_VIEW_BY_YT, task.snapshot.c_str(), width.c_str(),
              height.c_str(), nullptr);
    ::execl("/proc/self/exe", "bench_one_view", task.what.c_str(), task.snapshot.c_str(), width.c_str(), height.c_str(),
            nullptr);
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

bool yt_is_installed() { return std::system("/usr/bin/python3 -c 'import yt' 2> /dev/null") == 0; }

/// Costs of one way, round by round, and their medians.
struct Costs {
  std::vector<double> seconds, megabytes;
  void add(const Cost& cost) {
    seconds.push_back(cost.seconds);
    megabytes.push_back(cost.megabytes);
  }
};

double median_ratio(const Costs& first, const Costs& second) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < std::min(first.seconds.size(), second.seconds.size()); ++i)
    ratios.push_back(first.seconds[i] / second.seconds[i]);
  return median(ratios);
}

void compare(const std::string& snapshot, int width, int height, const char* memory_limit) {
  Costs ours, exact, yt;
  const bool with_yt = yt_is_installed();
  for (int round = 0; round < 5; ++round) {
    exact.add(cost_of({"exact", snapshot, width, height}));
    ours.add(cost_of({"whole", snapshot, width, height}));
    if (with_yt && round == 0) yt.add(cost_of({"yt", snapshot, width, height}));
  }
  const double copy = copy_seconds(fs::file_size(snapshot));
  fmt::print(
      "{:>4}x{:<4} {:.3f} s, {:.2f} of exact of all particles at once (at most 1.1); {:.0f} copies of the file\n",
      width, height, median(ours.seconds), median_ratio(ours, exact), median(ours.seconds) / copy);
  fmt::print("          {:.0f} MB{}, exact {:.0f} MB", median(ours.megabytes), memory_limit, median(exact.megabytes));
  if (with_yt) {
    fmt::print("; {:.2f} of the time of yt, {:.0f} MB\n", median_ratio(ours, yt), median(yt.megabytes));
  } else {
    fmt::print("; yt is not installed\n");
  }
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
