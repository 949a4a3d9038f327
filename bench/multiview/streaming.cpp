// A snapshot that is not kept in memory: processor time and memory of nine views, against copying the bytes of the file
// twice, as it is read.
//
//   bench_streaming [PARTICLES] [FILE]     50 million in a temporary file (1.2 GB) unless told otherwise: at most 4.5 s

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "stopwatch.h"
#include "wheatstone/app/render_particles.h"
#include "wheatstone/synthetic/synthetic_universe.h"

namespace wheatstone::bench {
namespace {

double largest_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

/// Copies all bytes of a file, and does nothing else.
void copy_through(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY);
  std::vector<char> bytes(1 << 20);
  while (::read(file, bytes.data(), bytes.size()) > 0) {
  }
  ::close(file);
}

void run(std::uint64_t particles, const std::filesystem::path& path) {
  const bool made_here = !std::filesystem::exists(path);
  // Another process, so that the universe's own memory does not count.
  if (made_here && std::system(fmt::format("{} --make {} {}", std::filesystem::read_symlink("/proc/self/exe").string(),
                                           particles, path.string())
                                   .c_str()) != 0)
    std::exit(1);
  copy_through(path);  // into the system's cache
  RenderParticlesOptions options;
  options.stream = true;
  options.views = 9;
  options.rendering.planes = 36;
  // In turn, so that a slower moment of the machine falls on both alike.
  double rendering = std::numeric_limits<double>::max();
  double copying = rendering;
  for (int round = 0; round < 3; ++round) {
    copying = std::min(copying, 2 * least_processor_seconds([&] { copy_through(path); }, 1));
    rendering = std::min(rendering, least_processor_seconds([&] { render_particles(path, options); }, 1));
  }
  fmt::print("{} particles, {:.2f} GB, nine views of 640x360, 36 planes\n", particles,
             static_cast<double>(std::filesystem::file_size(path)) / 1e9);
  fmt::print(
      "  processor time {:.2f} s, {:.0f} ns a particle; copying the bytes of the file twice {:.2f} s: {:.1f} x\n",
      rendering, 1e9 * rendering / static_cast<double>(particles), copying, rendering / copying);
  fmt::print("  largest memory {:.0f} MB (at most 400)\n", largest_memory_mb());
  if (made_here) std::filesystem::remove(path);
}

}  // namespace
}  // namespace wheatstone::bench

int main(int argc, char** argv) {
  if (argc == 4 && std::string(argv[1]) == "--make") {
    wheatstone::write_synthetic_universe(argv[3], {.particles = std::strtoull(argv[2], nullptr, 10)});
    return 0;
  }
  const std::uint64_t particles = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 50'000'000;
  const std::filesystem::path path =
      argc > 2 ? std::filesystem::path(argv[2]) : std::filesystem::temp_directory_path() / "wheatstone_streaming.hdf5";
  wheatstone::bench::run(particles, path);
}
