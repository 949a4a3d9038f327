#include "wheatstone/app/particle_chunks_internal.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <memory>
#include <optional>
#include <semaphore>
#include <span>
#include <thread>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/particles/all_of_column.h"

namespace wheatstone {
namespace {

void add(SelectionCounts& sum, const SelectionCounts& more) {
  sum.unchosen += more.unchosen;
  sum.dropped += more.dropped;
  sum.weightless += more.weightless;
  sum.mended += more.mended;
  sum.extreme += more.extreme;
}

std::size_t bytes_of(const Cloud& cloud) {
  std::size_t numbers = 0;
  for (const std::vector<float>* column : {&cloud.x, &cloud.y, &cloud.z, &cloud.density, &cloud.temperature,
                                           &cloud.smoothing_length, &cloud.mass, &cloud.quantity})
    numbers += column->size();
  return numbers * sizeof(float) + cloud.colour.size() * sizeof(Rgb8);
}

/// The chunks of a file that a rank reads: every N-th of N ranks. The next one is read while the last is worked on.
class ChunksInTurn {
 public:
  ChunksInTurn(CloudSource source, std::size_t chunk, const Ranks& ranks)
      : source_(std::move(source)), chunk_(chunk), others_(ranks.count() - 1), to_pass_(ranks.rank()), thread_([this] {
          read_when_asked();
        }) {
    asked_.release();
  }
  ~ChunksInTurn() {
    ended_ = true;
    asked_.release();
    thread_.join();
  }
  ChunksInTurn(const ChunksInTurn&) = delete;
  ChunksInTurn& operator=(const ChunksInTurn&) = delete;

  struct Chunk {
    Cloud cloud;              ///< nothing at the end
    std::uint64_t first = 0;  ///< number of its first particle in the file
  };
  /// The memory of the chunk before is used again.
  Chunk next(Cloud used) {
    if (at_end_) return {};
    read_.acquire();
    if (error_) std::rethrow_exception(error_);
    Chunk chunk = std::move(chunk_read_);
    at_end_ = chunk.cloud.size() == 0;
    if (at_end_) return chunk;
    if (source_.reuse) source_.reuse(std::move(used));
    asked_.release();
    return chunk;
  }

 private:
  void read_when_asked() {
    for (asked_.acquire(); !ended_; asked_.acquire()) {
      try {
        chunk_read_ = read();
      } catch (...) {
        error_ = std::current_exception();
      }
      read_.release();
    }
  }
  Chunk read() {
    for (; to_pass_ > 0; --to_pass_) at_ += pass();
    to_pass_ = others_;
    Chunk chunk{source_.next(chunk_), at_};
    at_ += chunk.cloud.size();
    return chunk;
  }
  std::size_t pass() { return source_.skip ? source_.skip(chunk_) : source_.next(chunk_).size(); }

  CloudSource source_;
  std::size_t chunk_;
  int others_, to_pass_;
  std::uint64_t at_ = 0;
  Chunk chunk_read_;
  std::exception_ptr error_;
  bool at_end_ = false;
  std::atomic<bool> ended_ = false;
  std::counting_semaphore<2> asked_{0};
  std::binary_semaphore read_{0};
  std::thread thread_;  // the last, since it uses the others
};

/// The numbers of particles that one rank has read in a round of chunks, and kept.
struct RoundShare {
  std::uint64_t read, kept;
};

std::uint64_t sum_of(std::span<const RoundShare> round, std::uint64_t RoundShare::*what) {
  std::uint64_t sum = 0;
  for (const RoundShare& share : round) sum += share.*what;
  return sum;
}

/// Calls `visit` with every chunk of the file that this rank reads, with what each rank has in this round, and with the
/// number of particles in the file, if it is known. All ranks take part in every round, the last time perhaps with
/// nothing. Gives the counts of all ranks.
template <class Visit>
SelectionCounts for_each_chunk(const std::filesystem::path& file, const RenderParticlesOptions& options,
                               const std::string& step, const Progress& progress, Visit visit) {
  const Ranks& ranks = options.rendering.ranks;
  CloudChoice choice = choice_of(options);
  // A rank that does not read the first particles needs their origin.
  if (!ranks.alone() && !choice.origin) choice.origin = open_cloud(file, choice).next(1000).origin;
  CloudSource source = open_cloud(file, choice);
  const std::optional<std::uint64_t> expected = source.count;
  ChunksInTurn chunks(std::move(source), options.chunk, ranks);
  SelectionCounts counts;
  std::uint64_t done = 0;
  Cloud chunk;
  while (true) {
    ChunksInTurn::Chunk following = chunks.next(std::move(chunk));
    chunk = std::move(following.cloud);
    const std::size_t read = chunk.size();
    put_quantity(chunk, file, options.quantity);
    add(counts, select_particles(chunk, options.selection, following.first));
    check_positions(file, chunk);
    const std::vector<RoundShare> round = ranks.from_all(RoundShare{read, chunk.size()});
    const std::uint64_t read_by_all = sum_of(round, &RoundShare::read);
    if (read_by_all == 0) break;
    done += read_by_all;
    if (sum_of(round, &RoundShare::kept) > 0) visit(chunk, std::span<const RoundShare>(round), expected);
    if (expected) report(progress, step, static_cast<double>(done) / static_cast<double>(*expected));
  }
  SelectionCounts all;
  for (const SelectionCounts& of_rank : ranks.from_all(counts)) add(all, of_rank);
  return all;
}

/// Whether no particle is left out by a choice.
bool chooses_all(const RenderParticlesOptions& options) {
  const Selection& selection = options.selection;
  return std::holds_alternative<std::monostate>(selection.cut) && selection.every <= 1 && !options.choice.where;
}

/// Whether kernels or brightness need a density that the particles do not have.
bool lacks_density(const Cloud& cloud, const RenderParticlesOptions& options) {
  const bool sized = options.appearance.look == Look::mass && !cloud.smoothing_length.empty();
  return cloud.density.empty() && !has_colours_of_file(cloud, options) && !sized;
}

}  // namespace

std::string quantity_name_of(const std::string& quantity) {
  if (quantity == "column-density") return {};
  return quantity.starts_with("mean:") ? quantity.substr(5) : quantity;
}

void put_quantity(Cloud& cloud, const std::filesystem::path& file, const std::string& quantity) {
  const std::string name = quantity_name_of(quantity);
  if (name != "temperature" && name != "density") return;
  cloud.quantity = name == "temperature" ? cloud.temperature : cloud.density;
  if (cloud.quantity.empty() && cloud.size() > 0)
    throw Error(ErrorKind::bad_input, fmt::format("{}: has no {} to show", file.string(), name));
}

bool has_colours_of_file(const Cloud& cloud, const RenderParticlesOptions& options) {
  return !cloud.colour.empty() && options.choice.type_colours.empty();
}

void check_positions(const std::filesystem::path& file, const Cloud& cloud) {
  constexpr float largest = Cloud::farthest_drawn;
  const auto all_near = [](const std::vector<float>& axis) {
    return all_of_column(axis, [](float value) { return std::abs(value) <= largest; });
  };
  if (all_near(cloud.x) && all_near(cloud.y) && all_near(cloud.z)) return;
  for (const std::vector<float>* axis : {&cloud.x, &cloud.y, &cloud.z})
    for (const float value : *axis)
      if (!(std::abs(value) <= largest))
        throw Error(ErrorKind::bad_input,
                    fmt::format("{}: has a particle at {:g}, expected positions of at most {:g}", file.string(),
                                cloud.farthest != 0 ? cloud.farthest : static_cast<double>(value), largest));
}

void refuse_nothing(const std::filesystem::path& file, const RenderParticlesOptions& options,
                    const SelectionCounts& counts) {
  if (counts.weightless > 0)
    throw Error(ErrorKind::bad_input, fmt::format("{}: no particles to draw, {} have no mass or nothing to show",
                                                  file.string(), counts.weightless));
  const bool is_whole = std::holds_alternative<std::monostate>(options.selection.cut);
  const std::string why = counts.dropped > 0     ? fmt::format("{} have no finite position", counts.dropped)
                          : !is_whole            ? "no particle is inside the selected region"
                          : options.choice.where ? "the condition (where) holds for none"
                                                 : "the file has none";
  throw Error(ErrorKind::bad_input, fmt::format("{}: no particles to draw, {}", file.string(), why));
}

SurveyedParticles survey(const std::filesystem::path& file, const RenderParticlesOptions& options,
                         const Progress& progress) {
  const Ranks& ranks = options.rendering.ranks;
  SurveyedParticles surveyed;
  surveyed.all_kept = !options.stream;
  std::uint64_t bytes = 0, kept_so_far = 0;  // of all ranks
  double mass = 0;
  std::shared_ptr<DensityGrid> grid;
  const auto look_at = [&](Cloud& chunk, std::span<const RoundShare> round, std::optional<std::uint64_t> in_file) {
    CloudStatistics& statistics = surveyed.statistics;
    if (kept_so_far == 0) {
      // The empty chunk of a rank without particles in this round does not tell whether a density is lacking.
      const bool lacks = anywhere(chunk.size() > 0 && lacks_density(chunk, options), ranks);
      if (lacks || options.appearance.shine > 0) grid = std::make_shared<DensityGrid>();
      if (lacks) surveyed.density = options.stream ? DensitySource::grid : DensitySource::neighbours;
    }
    if (grid) grid->add(chunk, ranks);
    statistics.mass = 0;
    statistics.add(chunk, kept_so_far + sum_of(round.first(static_cast<std::size_t>(ranks.rank())), &RoundShare::kept));
    kept_so_far += sum_of(round, &RoundShare::kept);
    // Sums depend on their order: chunk by chunk, as one rank would.
    for (const double of_chunk : ranks.from_all(statistics.mass)) mass += of_chunk;
    for (const std::uint64_t of_chunk : ranks.from_all(std::uint64_t{bytes_of(chunk)})) bytes += of_chunk;
    // Fresh memory takes longer to get than the particles to read: of a file that will be too large nothing is kept.
    const double expected_bytes =
        chooses_all(options) && in_file
            ? static_cast<double>(bytes) / static_cast<double>(kept_so_far) * static_cast<double>(*in_file)
            : 0;
    const auto most_bytes = static_cast<double>(options.most_bytes_kept);
    if (surveyed.all_kept && std::max(static_cast<double>(bytes), expected_bytes) > most_bytes) {
      surveyed.all_kept = false;
      surveyed.kept.clear();
    }
    if (surveyed.all_kept) surveyed.kept.push_back(std::move(chunk));
  };
  surveyed.counts = for_each_chunk(file, options, "reading", progress, look_at);
  // Fewer particles than expected may be left, because some have no finite position or no mass.
  if (!surveyed.all_kept && !options.stream && bytes <= options.most_bytes_kept) {
    for_each_chunk(file, options, "reading", progress,
                   [&](Cloud& chunk, const auto&...) { surveyed.kept.push_back(std::move(chunk)); });
    surveyed.all_kept = true;
  }
  surveyed.statistics.share(ranks);
  surveyed.statistics.mass = mass;
  if (surveyed.statistics.count == 0) refuse_nothing(file, options, surveyed.counts);
  surveyed.statistics.framed = framed_region(surveyed.statistics, options.fit);
  if (surveyed.density == DensitySource::neighbours && !surveyed.all_kept) surveyed.density = DensitySource::grid;
  if (grid) {
    grid->share(ranks);
    grid->finish(options.neighbours);
    surveyed.statistics.grid = std::move(grid);
  }
  if (surveyed.density == DensitySource::grid) surveyed.statistics.take_densities_of_grid();
  return surveyed;
}

Chunks chunks_from(const SurveyedParticles& surveyed, const std::filesystem::path& file,
                   const RenderParticlesOptions& options, const Progress& progress) {
  if (surveyed.all_kept)
    return [&surveyed](const std::function<void(const Cloud&)>& visit) {
      for (const Cloud& chunk : surveyed.kept) visit(chunk);
    };
  return [&](const std::function<void(const Cloud&)>& visit) {
    for_each_chunk(file, options, "drawing", progress, [&](Cloud& chunk, const auto&...) {
      if (surveyed.density == DensitySource::grid) surveyed.statistics.grid->put_densities(chunk);
      visit(chunk);
    });
  };
}

}  // namespace wheatstone
