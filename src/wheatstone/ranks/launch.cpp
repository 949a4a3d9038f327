#include "wheatstone/ranks/launch.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <malloc.h>

#include <cstdlib>
#include <filesystem>
#include <memory>

#include "wheatstone/error.h"
#include "wheatstone/ranks/transport_internal.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

int number_in(const char* name) {
  const char* const text = std::getenv(name);
  return text != nullptr ? std::atoi(text) : -1;
}

}  // namespace

std::optional<Launch> mpi_launch() {
  struct Names {
    const char *rank, *count;
  };
  // Of Open MPI, and of MPICH and its relatives.
  for (const Names& names : {Names{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"}, Names{"PMI_RANK", "PMI_SIZE"}}) {
    const Launch launch{number_in(names.rank), number_in(names.count)};
    if (launch.rank >= 0 && launch.count > launch.rank) return launch;
  }
  return std::nullopt;
}

Ranks start_ranks(const Launch& launch) {
  if (launch.count == 1) return {};
  const fs::path module =
      fs::read_symlink("/proc/self/exe").parent_path() / WHEATSTONE_MODULE_FOLDER / "libwheatstone_mpi.so";
  const auto refuse = [&](const std::string& why) {
    throw Error(ErrorKind::cannot_read_write,
                fmt::format("mpirun started {} processes, but this program cannot use MPI: {}", launch.count, why));
  };
  if (!fs::exists(module)) refuse(fmt::format("{} is not installed", module.lexically_normal().string()));
  // Never closed: libraries of MPI have threads and handlers of their own. What they load must find them.
  void* const library = ::dlopen(module.c_str(), RTLD_NOW | RTLD_GLOBAL);
  if (library == nullptr) refuse(::dlerror());
  auto* const start = reinterpret_cast<StartTransport*>(::dlsym(library, start_transport_name));
  if (start == nullptr) refuse(fmt::format("{} is of another version", module.string()));
  // Ranks send each other some megabytes in every round: memory that one round gives back serves the next, instead of
  // going to the system and coming back page by page.
  ::mallopt(M_MMAP_THRESHOLD, 64 << 20);
  ::mallopt(M_TRIM_THRESHOLD, 256 << 20);
  return Ranks(std::shared_ptr<Transport>(start()));
}

}  // namespace wheatstone
