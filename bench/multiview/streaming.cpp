// A snapshot larger than memory: streamed into slices, against reading the same file twice.
//
//   bench_streaming [PARTICLES] [FILE]     100 million in a temporary file (2.4 GB) unless told otherwise

#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>

#include "wheatstone/app/render_particles.h"
#include "wheatstone/synthetic/synthetic_universe.h"

namespace wheatstone::bench {
namespace {

template <class Call>
double seconds_of(Call call) {
  const auto start = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double largest_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

void read_through(const std::filesystem::path& path) {
  const CloudSource source = open_cloud(path);
  while (source.next(1'000'000).size() > 0) {
  }
}

void run(std::uint64_t particles, const std::filesystem::path& path) {
  const bool made_here = !std::filesystem::exists(path);
  // Another process, so that the universe's own memory does not count.
  if (made_here && std::system(fmt::format("{} --make {} {}", std::filesystem::read_symlink("/proc/self/exe").string(),
                                           particles, path.string())
                                   .c_str()) != 0)
    std::exit(1);
  const auto bytes = static_cast<double>(std::filesystem::file_size(path));
  read_through(path);  // into the system's cache, for both alike
  const double reading = seconds_of([&] {
    read_through(path);
    read_through(path);
  });
  RenderParticlesOptions options;
  options.stream = true;
  options.views = 9;
  options.rendering.planes = 36;
  const double streaming = seconds_of([&] { render_particles(path, options); });
  fmt::print("{} particles, {:.2f} GB, nine views of 640x360, 36 planes\n", particles, bytes / 1e9);
  fmt::print("  streamed in {:.2f} s, the file read twice in {:.2f} s: {:.2f} of that speed (at least 0.5)\n",
             streaming, reading, reading / streaming);
  fmt::print("  largest memory {:.0f} MB (at most 1000)\n", largest_memory_mb());
  if (made_here) std::filesystem::remove(path);
}

}  // namespace
}  // namespace wheatstone::bench

int main(int argc, char** argv) {
  if (argc == 4 && std::string(argv[1]) == "--make") {
    wheatstone::write_synthetic_universe(argv[3], {.particles = std::strtoull(argv[2], nullptr, 10)});
    return 0;
  }
  const std::uint64_t particles = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 100'000'000;
  const std::filesystem::path path =
      argc > 2 ? std::filesystem::path(argv[2]) : std::filesystem::temp_directory_path() / "wheatstone_streaming.hdf5";
  wheatstone::bench::run(particles, path);
}
