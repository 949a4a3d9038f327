// What speaks MPI, as a module that is loaded under mpirun.

#include <mpi.h>

#include <algorithm>
#include <cstdlib>

#include "wheatstone/ranks/transport_internal.h"

namespace wheatstone {
namespace {

/// Messages are counted in ints: longer ones go in pieces.
constexpr std::size_t longest_piece = std::size_t{1} << 30;

class MpiTransport : public Transport {
 public:
  MpiTransport() {
    // A rank that waits leaves its processor to the threads that read and draw, unless the user says otherwise.
    ::setenv("OMPI_MCA_mpi_yield_when_idle", "1", 0);
    int level = 0;
    // One thread speaks; the others draw.
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &level);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &count_);
  }
  ~MpiTransport() override { MPI_Finalize(); }
  int rank() const override { return rank_; }
  int count() const override { return count_; }

  void swap_numbers(std::span<const std::uint64_t> to, std::span<std::uint64_t> from) override {
    MPI_Alltoall(to.data(), 1, MPI_UINT64_T, from.data(), 1, MPI_UINT64_T, MPI_COMM_WORLD);
  }

  void swap_bytes(std::span<const std::vector<std::byte>> to, std::span<std::vector<std::byte>> from) override {
    from[rank_] = to[rank_];
    std::vector<MPI_Request> open;
    const auto for_pieces = [](std::size_t size, auto call) {
      for (std::size_t at = 0; at < size; at += longest_piece)
        call(at, static_cast<int>(std::min(longest_piece, size - at)));
    };
    for (int i = 1; i < count_; ++i) {
      const int peer = (rank_ + count_ - i) % count_;
      for_pieces(from[peer].size(), [&](std::size_t at, int size) {
        MPI_Irecv(from[peer].data() + at, size, MPI_BYTE, peer, 0, MPI_COMM_WORLD, &open.emplace_back());
      });
    }
    for (int i = 1; i < count_; ++i) {
      const int peer = (rank_ + i) % count_;
      for_pieces(to[peer].size(), [&](std::size_t at, int size) {
        MPI_Isend(to[peer].data() + at, size, MPI_BYTE, peer, 0, MPI_COMM_WORLD, &open.emplace_back());
      });
    }
    MPI_Waitall(static_cast<int>(open.size()), open.data(), MPI_STATUSES_IGNORE);
  }

  [[noreturn]] void abort(int exit_code) override {
    MPI_Abort(MPI_COMM_WORLD, exit_code);
    std::abort();  // not reached
  }

 private:
  int rank_ = 0, count_ = 1;
};

}  // namespace
}  // namespace wheatstone

extern "C" wheatstone::Transport* wheatstone_start_mpi() { return new wheatstone::MpiTransport(); }
